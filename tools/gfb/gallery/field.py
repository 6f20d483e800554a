"""Pages of [Gu2020] figs. 12 and 13: pressure and film height of the tilted bearing."""

import numpy
from matplotlib import colors, pyplot

from gfb.gallery.bearing import AS_IT_IS, MICRO, TOP_LEADING, ambient, frictions, mesh_variants
from gfb.gallery.page import Page, input_link
from gfb.gallery.tilt import (HELD, MODELS, N_MM, SYMMETRIC, TILT, answers, antisymmetric, asymmetry, judge, place_of_peak, radians,
                          regions)
from gfb.plot import film as plot_film
from gfb.plot.colours import look_of


def draw_pressures(runs, folder):
    """Fig. 12."""
    page = Page("fig12", f"[Gu2020] fig. 12: pressure of the bearing tilted about y by {radians(TILT)}", folder)
    found, missed = answers(runs)
    tell_shown(page, found, missed, draw_pressure_maps, "Pressure of beams and shells, and its sub-ambient part")
    rows = [[answer.name, words, over_ambient(one, "maximum_pressure"),
             "{:.1f}, {:.1f}".format(*place_of_peak(one)), over_ambient(one, "minimum_pressure"),
             f"{asymmetry(one):.3f}", with_and_without_suction(one, "torque_x"),
             with_and_without_suction(one, "torque_y")]
            for answer, words, one in each(found)]
    page.table(f"Pressures at phi_y = {radians(TILT)}",
               ["answer", "foils", "largest p/p_a", "at theta [deg], z [mm]", "smallest p/p_a",
                "asymmetry of the sub-ambient part", "M_x, without suction [N mm]", "M_y, without suction [N mm]"],
               rows,
               words=2)
    judge(page, found, ["peak", "symmetric", "opposite", "turns"])
    beam, shell = found[0].held["beam"], found[0].held["shell"]
    short = (f"peaks of {over_ambient(beam, 'maximum_pressure')} (beams) and {over_ambient(shell, 'maximum_pressure')} "
             f"p_a (shells); asymmetry of the sub-ambient part {asymmetry(beam):.2f} and {asymmetry(shell):.2f}")
    return close(runs, page, found, short, ["largest p/p_a", "asymmetry"],
                 lambda one: [over_ambient(one, "maximum_pressure"), f"{asymmetry(one):.3f}"], tell_leading)


def tell_leading(page, fixed_trailing, fixed_leading):
    """What the edge at which the top foil is fixed does to the symmetry of the shells' suction."""
    page.say(f"With the top foil fixed at its leading edge the shells' sub-ambient part has the asymmetry {asymmetry(fixed_leading):.2f} in place "
             f"of {asymmetry(fixed_trailing):.2f}; a part below {SYMMETRIC} is judged near-symmetric. So the paper's \"almost symmetric\" "
             f"speaks for {'a trailing edge that is fixed' if asymmetry(fixed_leading) > SYMMETRIC else 'neither edge'}.")


def draw_films(runs, folder):
    """Fig. 13."""
    page = Page("fig13", f"[Gu2020] fig. 13: film height of the bearing tilted about y by {radians(TILT)}", folder)
    found, missed = answers(runs)
    tell_shown(page, found, missed, draw_film_maps, "Film height of beams and shells")
    rows = [[answer.name, words, f"{MICRO*one['minimum_gap']:.2f}", f"{MICRO*one['minimum_gap_midplane']:.2f}",
             f"{along_axis(one):.2f}", *(f"{antisymmetric(one, where):.2f}" for where in regions(one).values()),
             f"{100.0*one['lifted_length']:.1f} %"] for answer, words, one in each(found)]
    page.table(f"Film at phi_y = {radians(TILT)}; antisymmetric part: root mean square of h(z) - h(-z) over that of "
               "the rigid gap (1: the foils even nothing out)",
               ["answer", "foils", "smallest film [um]", "the same at the midplane [um]",
                "largest difference of h_f along z [um]",
                *(f"antisymmetric part, {words}" for words in regions(found[0].held["beam"])),
                "crest length without contact"], rows, words=2)
    judge(page, found, ["thinner", "even"])
    flat = {answer.name: along_axis(answer.held["beam"]) for answer in found}
    page.judge("the 2D foils' deflection does not vary along the axis.",
               {name: one < 1.0e-6 for name, one in flat.items()},
               f"It varies by at most {max(flat.values()):.1e} um.")
    beam, shell = found[0].held["beam"], found[0].held["shell"]
    short = f"smallest films of {MICRO*beam['minimum_gap']:.2f} (beams) and {MICRO*shell['minimum_gap']:.2f} um (shells)"
    behind = "270 to 360 degrees"
    return close(runs, page, found, short, ["smallest film [um]", f"antisymmetric part, {behind}"],
                 lambda one: [f"{MICRO*one['minimum_gap']:.2f}", f"{antisymmetric(one, regions(one)[behind]):.2f}"])


def each(found):
    """Answer, model in words and result at the tilt, one after the other."""
    return [(answer, words, answer.held[model]) for answer in found for model, words in MODELS.items()]


def over_ambient(result, name):
    """A pressure over the ambient one, in words."""
    return f"{result[name]/ambient(result):.3f}"


def with_and_without_suction(result, name):
    """A torque, in words [N mm]."""
    return f"{N_MM*result[name]:.2f}, {N_MM*result[f'{name}_without_suction']:.2f}"


def along_axis(result):
    """Largest difference of the deflection along the axis [um]."""
    return MICRO*numpy.ptp(result.film.fields["deflection"], axis=1).max()


def tell_shown(page, found, missed, draw, words):
    """Pictures of the answers."""
    page.say("The shaft is fixed where it floats without tilt under 100 N at 30,000 rpm. Resting: the free leading edge "
             "lies on the bumps; lifted: it stands off them.")
    for number, answer in enumerate(found):
        page.took(list(answer.held.values()))
        page.picture(draw(answer), f"{words}: {answer.name}", f"_{number}" if number else "")
    if missed:
        page.items(missed)


def close(runs, page, found, short, heads, numbers, tell=None):
    """Verdicts, what is open, parameters."""
    page.tell_verdicts()
    page.short = f"{found[0].name}: {short}; {page.count()}."
    page.head("What the paper leaves open, and what it does")
    page.say("At which equilibrium the shaft is fixed; fixed edges, friction and mesh. [Fig. 11b](fig11b.md) has the "
             "torques of more variants. Friction acts as a vector in the tangent plane; along the motion alone "
             "(`friction_direction = 'motion'`) the shells' torques are up to about a fifth smaller there.")
    results = page.variants(f"Resting branch, phi_y = {radians(TILT)}, one thing changed", runs,
                            [(f"gu2020_fig11b_{model}", HELD) for model in MODELS],
                            [AS_IT_IS, ("which edge of the top foil is fixed", TOP_LEADING),
                             *(("how much friction (table 1: 0.1)", one) for one in frictions()), *mesh_variants()],
                            [f"{words}: {head}" for words in MODELS.values() for head in heads], numbers)
    if results and tell:
        shell = list(MODELS).index("shell")
        tell(page, results[shell], results[len(MODELS) + shell])
    page.parameters(found[0].held["shell"], f"{input_link('gu2020_fig11b_beam')}, {input_link('gu2020_fig11b_shell')} "
                                            "(shown), with `values = 2e-4` in `&sweep`.")
    return page


def draw_pressure_maps(answer):
    """p/p_a, and what is below ambient, a row a model."""
    figure, axes = pyplot.subplots(2, 2, figsize=(11.0, 6.0), layout="constrained", sharey=True)
    figure.suptitle(answer.name, fontsize=11)
    top = max(one["maximum_pressure"]/ambient(one) for one in answer.held.values())
    deep = max(1.0 - one["minimum_pressure"]/ambient(one) for one in answer.held.values())
    for (whole, part), (model, words) in zip(axes, MODELS.items()):
        one = answer.held[model]
        over = one.film.fields["pressure"]/ambient(one)
        plot_film.draw_map(figure, whole, one.film, over, 1.0 - deep, top, look_of("pressure", 1.0 - deep, top))
        whole.set_title(f"{words}: p/p_a", fontsize=10)
        plot_film.draw_map(figure, part, one.film, numpy.maximum(1.0 - over, 0.0), 0.0, deep,
                           {"cmap": "magma_r", "norm": colors.Normalize(0.0, deep)})
        part.set_title(f"{words}: sub-ambient part, 1 - p/p_a; asymmetry {asymmetry(one):.2f}", fontsize=10)
    for chart in axes[-1]:
        plot_film.label_theta(chart, one.film)
    for chart in axes[0]:
        plot_film.label_theta(chart, one.film)
        chart.set_xlabel("")
    return figure


def draw_film_maps(answer):
    """Film height as a map and along three lines, a row a model."""
    figure, axes = pyplot.subplots(2, 2, figsize=(11.0, 6.0), layout="constrained")
    figure.suptitle(answer.name, fontsize=11)
    gaps = [MICRO*one.film.fields["gap"] for one in answer.held.values()]
    low, top = min(gap.min() for gap in gaps), max(gap.max() for gap in gaps)
    for (chart, lines), (model, words) in zip(axes, MODELS.items()):
        film = answer.held[model].film
        gap = MICRO*film.fields["gap"]
        plot_film.draw_map(figure, chart, film, gap, low, top, look_of("gap", low, top))
        chart.set_title(f"{words}: film height [um]", fontsize=10)
        for row, style in ((-1, "--"), (film.middle, "-"), (0, ":")):
            lines.plot(film.theta, gap[:, row], style, label=f"z = {1.0e3*film.z[row] + 0.0:.4g} mm")
        lines.set_title(f"{words}: film height [um]", fontsize=10)
        lines.set_ylim(0.0, top)
        lines.grid(alpha=0.3)
        lines.legend(fontsize=8)
        for one in (chart, lines):
            plot_film.label_theta(one, film)
    return figure
