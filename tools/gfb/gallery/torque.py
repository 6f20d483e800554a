"""Pages of [Gu2020] fig. 11: torques against tilt."""

import numpy
from matplotlib import pyplot

from gfb.gallery.bearing import AS_IT_IS, MICRO, TOP_LEADING, ambient, frictions, mesh_variants
from gfb.gallery.page import Page, input_link
from gfb.gallery.tilt import (HELD, MODELS, N_MM, TILT, answers, curve, departure, judge, radians, stiffness, tilts,
                          torque_at)

COLOURS = {"beam": "C0", "shell": "C1"}
# Finer meshes, with which the default's torques are compared.
FINER = [({"mesh.axial_elements": 48}, "48 elements over the width for 32"),
         ({"mesh.circumferential_elements": 416}, "16 elements a pitch for 8"),
         ({"mesh.arc_elements": 24, "mesh.flat_elements": 6}, "bumps of 24 + 6 elements for 12 + 3")]


def draw_about_x(runs, folder):
    """Fig. 11a."""
    page = Page("fig11a", "[Gu2020] fig. 11a: torques of the bearing tilted about x", folder)
    return draw_torques(runs, page, "x", ["linear_x", "stiffer_x"])


def draw_about_y(runs, folder):
    """Fig. 11b."""
    page = Page("fig11b", "[Gu2020] fig. 11b: torques of the bearing tilted about y", folder)
    return draw_torques(runs, page, "y", ["linear_y", "linear_y_of_x", "largest", "stiffer_y", "moves", "opposite", "turns"])


def draw_torques(runs, page, axis, keys):
    """Torques against a tilt, of all answers."""
    found, missed = answers(runs)
    cases = [f"gu2020_{page.name}_{model}" for model in MODELS]
    for answer in found:
        page.took([answer.sweeps[model, axis] for model in MODELS])
    page.say("The shaft is fixed where it floats without tilt under 100 N at 30,000 rpm. Resting: the free leading edge "
             "lies on the bumps; lifted: it stands off them.")
    page.picture(draw_curves(found, axis), f"Torques against the tilt about {axis}")
    for answer in found:
        tell_torques(page, answer, axis)
    tell_slopes(page, found, axis)
    tell_stop(runs, page, axis)
    if missed:
        page.items(missed)
    judge(page, found, keys)
    page.tell_verdicts()
    first = found[0]
    page.short = (f"{first.name}: dM_{axis}/dphi_{axis} is "
                  + ", ".join(f"{stiffness(first.sweeps[model, axis], axis, f'torque_{axis}'):.0f} N m/rad with {words}"
                              for model, words in MODELS.items()) + f"; {page.count()}.")
    tell_open(runs, page, axis)
    page.parameters(first.sweeps["shell", axis], ", ".join(map(input_link, cases))
                    + " (shown). The paper's mesh: 104 x 30 elements, `align_crests = .false.`.")
    return page


def draw_curves(found, axis):
    """A chart an answer."""
    figure, axes = pyplot.subplots(1, len(found), squeeze=False, layout="constrained", sharey=True,
                                   figsize=(1.0 + 4.2*len(found), 4.4))
    for chart, answer in zip(axes[0], found):
        for model, words in MODELS.items():
            result = answer.sweeps[model, axis]
            for name, style in (("torque_x", "o--"), ("torque_y", "s-"), ("torque_x_without_suction", ":")):
                tilt, torque = curve(result, axis, name)
                chart.plot(1.0e4*tilt, N_MM*torque, style, color=COLOURS[model], markersize=3.5,
                           label=f"{words}: M_{name[7]}{' without suction' if 'without' in name else ''}")
        chart.set_title(answer.name, fontsize=10)
        chart.axhline(0.0, color="0.4", linewidth=0.8)
        chart.grid(alpha=0.3)
        chart.set_xlabel(f"phi_{axis} [1e-4 rad]")
    axes[0, 0].set_ylabel("torque on the shaft [N mm]")
    axes[0, 0].legend(fontsize=7)
    return figure


def tell_torques(page, answer, axis):
    """Table of an answer's sweeps."""
    rows = []
    for tilt in tilts(answer.sweeps["beam", axis], axis):
        row = [f"{1.0e4*tilt:.2f}"]
        for model in MODELS:
            one = answer.sweeps[model, axis]
            at = numpy.flatnonzero(numpy.isclose(one.history[f"tilt_{axis}"], tilt))
            if len(at) == 0:
                row += [""]*5
                continue
            point = {name: values[at[0]] for name, values in one.history.items()}
            row += [f"{N_MM*point[name] + 0.0:.2f}" for name in ("torque_x", "torque_y", "torque_x_without_suction")]
            row += [f"{MICRO*point['minimum_gap']:.2f}", f"{point['maximum_pressure']/ambient(one):.3f}"]
        rows.append([cell.replace("-0.00", "0.00") for cell in row])
    page.table(f"{answer.name.capitalize()}; first five columns: beams (2D), last five: shells (3D); torques in N mm "
               "(M_x*: without suction), films in um, pressures over p_a",
               [f"phi_{axis} [1e-4 rad]", *["M_x", "M_y", "M_x*", "smallest film", "largest pressure"]*2], rows,
               words=0)


def tell_slopes(page, found, axis):
    """Table of stiffnesses and of how straight the curves are."""
    rows = []
    for answer in found:
        for model, words in MODELS.items():
            one = answer.sweeps[model, axis]
            cells = []
            for name in ("torque_x", "torque_y"):
                cells += [f"{stiffness(one, axis, name):.1f}", f"{torque_at(one, axis, name)/TILT:.1f}",
                          f"{100.0*departure(one, axis, name):.1f} %"]
            given = [f"{one.history[key][0]:.1f}" for key in (f"angular_stiffness_{name}{axis}" for name in "xy")
                     if key in one.history]
            rows.append([answer.name, words, *cells, ", ".join(given)])
    heads = [head for name in "xy" for head in (f"dM_{name}/dphi_{axis} at zero", "secant", "departure")]
    page.table(f"Angular stiffness [N m/rad]: slope at zero tilt, secant at {radians(TILT)}, and the curve's largest "
               "departure from a straight line through zero, over its largest torque",
               ["answer", "foils", *heads, "gfb's own slopes, M_x and M_y"], rows, words=2)


def tell_stop(runs, page, axis):
    """How far the beams can be tilted."""
    case = f"gu2020_{page.name}_beam"
    far = runs.run(case, {"sweep.values": [0.0, 2.0e-4, 3.0e-4, 4.0e-4, 5.0e-4, 6.0e-4]}, may_stop=True)
    reached = tilts(far, axis)[-1]
    page.say(f"Tilted further, the resting beams on the default mesh reach {radians(reached)} in steps of 1e-4"
             + (", the largest asked for." if far.converged else f"; then: {far.reason}."))


def tell_open(runs, page, axis):
    """What the paper does not say, and what it does to the torques."""
    page.head("What the paper leaves open, and what it does")
    page.say("At which equilibrium the shaft is fixed; up to which tilt; and what is varied here, on the resting "
             f"branch, under phi_{axis} = {radians(TILT)}. Torques in N mm:")
    variants = [AS_IT_IS, ("which edge of the top foil is fixed", TOP_LEADING),
                ("which edge of the strip is fixed", {"bump_foil.fixed_edge": "leading"}),
                ("the strip's first line", {"bump_foil.fixed_line": "corner"}),
                *(("how much friction (table 1: 0.1)", one) for one in frictions()),
                ("friction as a vector or along the motion", {"contact.friction_direction": "motion"}),
                ("its law", {"contact.friction_law": "coulomb"}),
                ("contact stiffness", {"contact.normal_stiffness": 5.0e10}), *mesh_variants(),
                ("mesh: elements over the width", FINER[0][0])]
    names = ("torque_x", "torque_y", "torque_x_without_suction")
    results = page.variants("The case files with one thing changed (M_x*: without suction)", runs,
                            [(f"gu2020_{page.name}_{model}", HELD) for model in MODELS], variants,
                            ["beams: M_x", "M_y", "M_x*", "shells: M_x", "M_y", "M_x*"],
                            lambda one: [f"{N_MM*one[name]:.2f}" for name in names])
    if results:
        tell_direction(page, variants, results)
        tell_mesh(page, variants, results, axis)


def tell_direction(page, variants, results):
    """What friction along the motion alone does to the shells' torques."""
    shell = list(MODELS).index("shell")
    at = next(i for i, (_, change) in enumerate(variants) if change.get("contact.friction_direction") == "motion")
    vector, motion = results[shell], results[len(MODELS)*at + shell]
    if motion.converged:
        changes = " and ".join(f"M_{name} by {100.0*(motion[f'torque_{name}']/vector[f'torque_{name}'] - 1.0):+.1f} %" for name in "xy")
        page.say("Friction acts as a vector in the tangent plane. Along the motion alone (`friction_direction = 'motion'`) it changes the "
                 f"shells' {changes}: nothing rubs along z then, and the strip swings sideways. Beams cannot, and keep theirs.")


def tell_mesh(page, variants, results, axis):
    """How far the torques are from not changing with the mesh."""
    lines = []
    for k, words in enumerate(MODELS.values()):
        base = results[k]
        for i, (_, change) in enumerate(variants):
            one = results[len(MODELS)*i + k]
            what = next((what for finer, what in FINER if change == finer), None)
            if what and one.converged:
                changes = ", ".join(f"M_{name} by {100.0*(one[f'torque_{name}']/base[f'torque_{name}'] - 1.0):+.1f} %"
                                    for name in "xy")
                lines.append(f"{words}, {what}: {changes}.")
    page.say(f"How far the mesh is from converged, under the tilt about {axis}:")
    page.items(lines)
