"""What the pages of bearings share: branches, numbers of an answer, what the paper leaves open."""

import math

import numpy

from gfb.bench.bearing_mesh import largest_sag

MICRO = 1.0e6
PAPER_MESH = {"mesh.circumferential_elements": 104, "mesh.axial_elements": 30, "mesh.align_crests": False}
# Of the tilted bearing's lifted branch, which takes many steps to find on shells.
COARSER_MESH = {**PAPER_MESH, "mesh.axial_elements": 16, "mesh.arc_elements": 6, "mesh.flat_elements": 2}
TOP_LEADING = {"top_foil.fixed_edge": "leading"}
# Starts on the branch whose free leading edge stands off the bumps, next to the paper's position; and the least lift
# that counts as one [m].
LIFTED = {"beam": {"operation.leading_edge_lift": 2.9e-5},
          "shell": {"operation.leading_edge_lift": 2.08e-5, "operation.leading_edge_lift_edge": 4.22e-5}}
LEAST_LIFT = 5.0e-6
FRICTIONS = (0.0, 0.05, 0.1, 0.2, 0.5)
PITCHES = 26
UNCOMPARED = "Measured data are printed as curves only: nothing to compare numbers with."


def lifted_start(runs):
    """Whether the program can be asked for the lifted branch."""
    return ("operation", "leading_edge_lift") in runs.keys


def lifted(runs, model, case, changes=None):
    """The case on its lifted branch, or None, and words on what stands in the way.

    A sweep that stops on its way counts with the points it reached.
    """
    if not lifted_start(runs):
        return None, "this version of gfb cannot be asked for lifted branches"
    result = runs.run(case, {**(changes or {}), **LIFTED[model]}, may_stop=True)
    lift = result.history.get("leading_edge_lift", [])
    words = "" if result.converged else f"stopped after {len(lift)} points: {result.reason}"
    if len(lift) > 0 and lift[0] <= LEAST_LIFT:
        words = "started there, the free edge came to rest on the bumps"
    return (result if len(lift) > 0 and lift[0] > LEAST_LIFT else None), words


def frictions(values=FRICTIONS):
    """Changes of both friction coefficients."""
    return [{"contact.friction_top": one, "contact.friction_sleeve": one} for one in values]


def clearance(result):
    return float(result.used["bearing", "clearance"][0])


def ambient(result):
    return float(result.used["gas", "ambient_pressure"][0])


def position(result):
    """e/C of the last point."""
    return numpy.array([result["eccentricity_x"], result["eccentricity_y"]])/clearance(result)


def position_words(values):
    return f"({values[0]:.4f}, {values[1]:.4f})"


def sag(result):
    """Largest sag at the midplane [m]; the strip is fixed at its trailing edge."""
    return largest_sag(f"{result.stem}.film.vtkhdf")


def gaps(result):
    """Smallest film at the midplane and at the edges, in words [um]."""
    return f"{MICRO*result['minimum_gap_midplane']:.2f}, {MICRO*result['minimum_gap_edge']:.2f}"


def pressures(result):
    """Largest and smallest pressure over the ambient one, in words."""
    return f"{result['maximum_pressure']/ambient(result):.3f}, {result['minimum_pressure']/ambient(result):.3f}"


def lifts(result, edge):
    """Lift of an edge at the midplane and at the ends of the bearing, in words [um]."""
    # + 0.0 turns -0.0 into 0.0
    names = (f"{edge}_edge_lift", f"{edge}_edge_lift_edge")
    return ", ".join(f"{round(MICRO*result[name], 1) + 0.0:.1f}" for name in names)


def answer_rows(results):
    """Rows of a table: what the answers are, a column a result."""
    rows = [["e/C", *(position_words(position(one)) for one in results)],
            ["attitude angle [deg]", *(f"{one['attitude_angle']:.1f}" for one in results)],
            ["smallest film, midplane and edges [um]", *(gaps(one) for one in results)],
            ["angle of the thinnest film at the midplane [deg]", *(f"{thinnest(one):.1f}" for one in results)],
            ["largest and smallest pressure over p_a", *(pressures(one) for one in results)],
            ["largest deflection at the midplane, sag in it [um]",
             *(f"{MICRO*midplane(one, 'deflection').max():.1f}, {MICRO*sag(one):.1f}" for one in results)],
            ["largest displacement towards the shaft, midplane and edges [um]",
             *(f"{-MICRO*midplane(one, 'deflection').min():.1f}, "
               f"{-MICRO*one.film.fields['deflection'][:, -1].min():.1f}" for one in results)],
            ["lift of the leading edge, midplane and edges [um]", *(lifts(one, "leading") for one in results)],
            ["lift of the trailing edge, midplane and edges [um]", *(lifts(one, "trailing") for one in results)],
            ["crest length without contact", *(f"{100.0*one['lifted_length']:.1f} %" for one in results)],
            ["friction torque [N mm]", *(f"{1.0e3*one['friction_torque']:.2f}" for one in results)]]
    if any("stability" in one.summary for one in results):
        rows.append(["modes of the foils that grow with a fixed shaft (0: stable)",
                     *map(stability_words, results)])
    return rows


def stability_words(result):
    value = result.summary.get("stability")
    return "" if value is None else f"{value:.0f}" if isinstance(value, float) else value


def midplane(result, name):
    """A field along the midplane."""
    return result.film.fields[name][:, result.film.middle]


def thinnest(result):
    """Angle of the thinnest film at the midplane [deg]."""
    return result.film.theta[int(numpy.argmin(midplane(result, "gap")))]


AS_IT_IS: tuple[str, dict[str, float]] = ("the file as it is", {})


def open_variants():
    """What the paper leaves open of a bearing's foils, and what to change for it."""
    pitch = float(f"{2.0*math.pi*19.05e-3/PITCHES:.9g}")
    return [
        ("which edge of the top foil is fixed", TOP_LEADING),
        ("which edge of the strip is fixed", {"bump_foil.fixed_edge": "leading"}),
        ("both", {**TOP_LEADING, "bump_foil.fixed_edge": "leading"}),
        ("the strip's first line", {"bump_foil.fixed_line": "corner"}),
        ("", {"bump_foil.fixed_line": "flat"}),
        ("pitch: 26 of 4.572 mm are 0.82 mm short of the pad", {"bump_foil.pitch": pitch})]


def friction_variants(values=FRICTIONS):
    """Friction and contact."""
    return [
        ("friction (table 1: 0.1) on which side", {"contact.friction_top": 0.0}),
        ("", {"contact.friction_sleeve": 0.0}),
        *(("how much friction", one) for one in frictions(values)),
        ("its law and regularisation", {"contact.friction_law": "coulomb"}),
        ("", {"contact.stick_length": 1.0e-8}),
        ("friction as a vector or along the motion", {"contact.friction_direction": "motion"}),
        ("contact stiffness", {"contact.normal_stiffness": 5.0e10}),
        ("", {"contact.normal_stiffness": 1.0e12})]


def mesh_variants():
    """Other meshes."""
    return [
        ("mesh: the paper's, crests inside elements", PAPER_MESH),
        ("mesh: as many elements, crests on nodes", {**PAPER_MESH, "mesh.align_crests": True}),
        ("mesh: elements a pitch, 4 and 16 for 8", {"mesh.circumferential_elements": 4*PITCHES}),
        ("", {"mesh.circumferential_elements": 16*PITCHES}),
        ("mesh: elements over the width", {"mesh.axial_elements": 16}),
        ("mesh: bumps of twice the elements", {"mesh.arc_elements": 24, "mesh.flat_elements": 6})]
