#!/usr/bin/env python3
"""Strips on frictional contacts: independent numbers, an exact bump, mesh convergence."""

import math
import tempfile

import h5py
import numpy

from gfb_run import Checks
from strips import FOIL, MICROMETRE, REFERENCE, crests, solve

PAIR = {"thickness": 0.127e-3, "youngs_modulus": 207.0e9, "poissons_ratio": 0.3, "half_length": 3.3e-3,
        "height": 0.9e-3, "pitch": 7.0e-3, "bumps": 4, "width": 18.0e-3, "fixed_edge": "none"}
FORCE = 25.0  # N a bump
SMALL = {"arc_elements": 8, "flat_elements": 2, "axial_elements": 20}
COARSE = {"arc_elements": 4, "flat_elements": 2, "axial_elements": 10}
AS_REFERENCE = {"normal_stiffness": 1.0e11, "stick_length": 2.0e-9}


def pressed(folder, name, top=0.0, sleeve=0.0, **groups):
    """Case 1: pressure on the crests of a strip that rests on the sleeve."""
    groups["contact"] = {"friction_top": top, "friction_sleeve": sleeve, **groups.get("contact", {})}
    groups.setdefault("strip_load", {"pressure": 0.2e6})
    return solve(folder, name, **groups)


def squeezed(folder, name, friction=0.2, steps=50, down=None, **groups):
    """Case 2: a strip between two plates, forced unless a load is given."""
    foil = {**PAIR, **groups.pop("bump_foil", {})}
    load = groups.pop("strip_load", None) or {"maximum_force": FORCE*foil["bumps"]}
    load |= {"kind": "plates", "steps_up": steps, "steps_down": steps if down is None else down}
    contact = {"friction_top": friction, "friction_sleeve": friction, **groups.pop("contact", {})}
    return solve(folder, name, bump_foil=foil, strip_load=load, contact=contact, **groups)


def contact_lines(answer, surface):
    """Fields of a surface's contacts by step, line and row of nodes, and z of the rows; the lines that are held
    touch nothing and are left out."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        group = {name: data[...] for name, data in file[f"contact/{surface}"].items()}
    line = group["line"]
    lines = [numpy.flatnonzero(line == number) for number in numpy.unique(line[line > 0])]
    found = {name: numpy.stack([group[name][:, nodes] for nodes in lines], axis=1)
             for name in ("normal_force", "friction_x", "friction_z", "slip_x", "slip_z", "state")}
    return found, group["position_z"][lines[0]]


def line_sums(values, z):
    """Sums over all lines and the whole width of a quantity per length of contact line, step by step."""
    weight = numpy.full(len(z), z[1] - z[0])
    weight[[0, -1]] *= 0.5
    return (values*weight).sum(axis=(1, 2))*(2.0 if z[0] >= 0.0 else 1.0)


def excess(found, wanted):
    """What each crest is off, over the larger of 1 % and 0.02 um; 1 is allowed."""
    return numpy.abs(found - wanted)/numpy.maximum(0.01*numpy.abs(wanted), 0.02*MICROMETRE)


def check_case_1(checks, folder):
    """Ten bumps against the independent solution.

    The reference rubs along the shaft's motion alone. There every bump must agree. With friction as a vector, the
    program's default, crests and corners beside the clamped edge slip as much along the axis as along the motion or
    more, and what rubs along the one is missing along the other: the three bumps there are only bounded.
    The answers with friction as a vector, on the paper's mesh, by their words.
    """
    met = {}
    uniform = REFERENCE["case1"]["crest_deflection_um"]
    ramp = REFERENCE["case1"]["increasing_decreasing_peak_0.4MPa_um"]
    ramp_load = {"pressure": 0.4e6, "distribution": "increasing_decreasing"}
    cases = (("uniform, friction 0", uniform["friction 0"], {}, {}),
             ("uniform, 0.1 at the sleeve", uniform["friction_sleeve 0.1, crest free to slide"], {"sleeve": 0.1}, {}),
             ("uniform, 0.1 at both", uniform["friction 0.1 at sleeve and at the crest (immobile top plate)"],
              {"sleeve": 0.1, "top": 0.1}, {}),
             ("increasing-decreasing, friction 0", ramp["friction 0"], {}, {"strip_load": ramp_load}),
             ("increasing-decreasing, 0.1 at the sleeve", ramp["friction_sleeve 0.1"], {"sleeve": 0.1},
              {"strip_load": ramp_load}))
    for words, wanted, friction, groups in cases:
        wanted = numpy.array(wanted)*MICROMETRE
        planar = pressed(folder, "planar", contact={**AS_REFERENCE, "friction_direction": "motion"}, **friction,
                         **groups)
        checks.within(f"{words}: every bump, over what is allowed", excess(crests(planar), wanted).max(), 0.0, 1.0)
        met[words] = vector = pressed(folder, "vector", **friction, **groups)
        first = 3 if friction else 0
        checks.within(f"{words}, the program's defaults: bumps {first + 1} to 10, over what is allowed",
                      excess(crests(vector), wanted)[first:].max(), 0.0, 1.0)
        checks.within(f"{words}, the program's defaults: largest difference [um]",
                      numpy.abs(crests(vector) - wanted).max()/MICROMETRE, 0.0, 0.04)
    return met


def check_case_2(checks, folder):
    """Hysteresis loops between plates against the independent solution."""
    reference = REFERENCE["case2"]
    cases = (("four bumps, free", "four_bumps_both_ends_free", {}, 0.2),
             ("four bumps, clamped", "four_bumps_flat_edge_clamped", {"fixed_edge": "leading", "fixed_line": "flat"},
              0.2),
             ("six bumps, free, friction 0.1", "six_bumps_both_ends_free_friction_0.1", {"bumps": 6}, 0.1))
    for words, name, foil, friction in cases:
        loop = squeezed(folder, "loop", friction=friction, steps=20, bump_foil=foil)
        for quantity, wanted, unit in (("maximum_deflection", "w_max_um", 1.0e-6),
                                       ("loading_stiffness", "K_load_N_per_mm", 1.0e3),
                                       ("dissipated_energy", "E_diss_mJ", 1.0e-3)):
            checks.below(f"{words}: {quantity}", loop[quantity]/(reference[name][wanted]*unit) - 1.0, 2.0e-2)


def check_exact_bump(checks, folder):
    """One bump on sliding feet against the exact curved beam.

    The exact bump is in plane strain, so the force per length of crest in the middle of the width is what
    compares. At a free edge the shell curls up from the plate and unloads there; the edge's ripples reach the
    middle of a narrow bump, so the width is doubled. The crest line rubs too: it keeps the bump in its place and
    does no work, as the crest does not slide.
    """
    for words, foil, name in (("case 1's bump", FOIL, "case 1 width 38.1 mm"),
                              ("case 2's bump", PAIR, "case 2 width 18 mm")):
        exact = REFERENCE["single_bump_exact"]["values_N_per_m"][name]
        for key in ("mu 0", next(key for key in exact if key.startswith("load mu"))):
            width = 2.0*foil["width"]
            bump = squeezed(folder, "bump", friction=float(key.split()[-1]), steps=4, down=0,
                            bump_foil={**foil, "bumps": 1, "width": width, "fixed_edge": "none"},
                            strip_load={"maximum_force": 2.0*FORCE},
                            mesh={"arc_elements": 24, "flat_elements": 4, "axial_elements": 100})
            top, z = contact_lines(bump, "top")
            force = top["normal_force"][-1, 0]
            middle = force[numpy.argmin(numpy.abs(z))]*foil["width"]/bump["maximum_deflection"]/exact[key] - 1.0
            mean = bump["loading_stiffness"]/2.0/exact[key] - 1.0
            print(f"       {words}, {key}, {1e3*width:.1f} mm wide: free edge carries "
                  f"{force[-1]/force.max():.1f} of the largest")
            checks.below(f"{words}, {key}: the middle of a wide bump", middle, 2.0e-2)
            checks.below(f"{words}, {key}: the mean of a wide bump", mean, 2.0e-2)


def check_forces_along_the_axis(checks, folder):
    """Contact forces per length, along a line.

    Without Poisson's ratio every slice across the axis is the same planar bump: forces are even to the ends, where a node stands for
    half an element. With it the free edges curl, and forces alternate from node to node where elements are too long for that: between
    nodes that are held at one height a linear element bends by turning its ends against each other. Means of neighbours stay right.
    """

    def forces(ratio, elements):
        """Of two bumps between plates, on the crests: step 1, by line and row of nodes; the plate's force over the width."""
        strip = squeezed(folder, "even", friction=0.0, steps=1, down=0, strip_load={"maximum_displacement": 5.0*MICROMETRE},
                         bump_foil={"bumps": 2, "poissons_ratio": ratio}, mesh={"arc_elements": 12, "flat_elements": 3, "axial_elements": elements})
        return contact_lines(strip, "top")[0]["normal_force"][-1], strip["maximum_force"]/PAIR["width"]

    even, whole = forces(0.0, 8)
    checks.below("without Poisson's ratio: forces per length are even along a line", numpy.ptp(even, axis=1).max()/even.mean(), 1.0e-8)
    checks.below("and add up to the plate's over the width", even[:, 0].sum()/whole - 1.0, 1.0e-8)
    coarse, fine = (forces(0.3, elements)[0] for elements in (8, 80))
    middle = fine[:, fine.shape[1]//2][:, None]
    inner = slice(fine.shape[1]//4, -(fine.shape[1]//4))
    checks.below("elements a tenth as long: forces inside are even", (numpy.abs(fine[:, inner]/middle - 1.0)).max(), 1.0e-2)
    checks.within("elements of 2.25 mm: forces alternate by", 0.25*numpy.abs(numpy.diff(coarse, 2, axis=1)/middle)[:, 1:-1].max(), 0.15, 0.3)
    means = 0.25*(coarse[:, :-2] + 2.0*coarse[:, 1:-1] + coarse[:, 2:])
    checks.below("their means of neighbours are those forces", numpy.abs(means/middle - 1.0)[:, 1:-1].max(), 1.0e-2)


def check_convergence(checks, folder, met):
    """Second order along the arc, with and without friction; the paper's mesh is stiff."""
    for words, friction in (("friction 0", {}), ("0.1 at both", {"top": 0.1, "sleeve": 0.1})):
        found = [crests(pressed(folder, "size", **friction, mesh={"arc_elements": 8*k, "flat_elements": 2*k,
                                                                  "axial_elements": 10})) for k in (1, 2, 4)]
        order = numpy.log2((found[1] - found[0])/(found[2] - found[1]))
        checks.within(f"{words}: lowest order of the crests", order.min(), 1.85, 2.15)
        checks.within(f"{words}: highest order of the crests", order.max(), 1.85, 2.15)
    found = [squeezed(folder, "size", steps=4, mesh={"arc_elements": 8*k, "flat_elements": 2*k, "axial_elements": 10})
             ["dissipated_energy"] for k in (1, 2, 4)]
    checks.within("order of a loop's energy", math.log2((found[1] - found[0])/(found[2] - found[1])), 1.85, 2.15)
    for words, friction in (("friction 0", {}), ("0.1 at the sleeve", {"sleeve": 0.1})):
        twice = pressed(folder, "size", **friction,
                        mesh={"arc_elements": 24, "flat_elements": 6, "axial_elements": 50})
        found = [crests(answer)[4] for answer in (met[f"uniform, {words}"], twice)]
        finest = found[1] + (found[1] - found[0])/3.0  # second order
        checks.within(f"{words}: the paper's mesh is stiff at bump 5 by [%]", 100.0*(1.0 - found[0]/finest), 1.5, 2.1)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        met = check_case_1(checks, folder)
        check_case_2(checks, folder)
        check_forces_along_the_axis(checks, folder)
        check_exact_bump(checks, folder)
        check_convergence(checks, folder, met)
    checks.close()


if __name__ == "__main__":
    main()
