"""Pages of [Gu2020] section 4.2: film, pressure and deflection under a load, smallest films against the load."""

import numpy
from matplotlib import pyplot

from gfb.gallery.bearing import (AS_IT_IS, MICRO, PAPER_MESH, TOP_LEADING, UNCOMPARED, ambient, answer_rows, clearance,
                             friction_variants, frictions, gaps, lifted, lifts, mesh_variants, midplane, position,
                             position_words, pressures, sag)
from gfb.gallery.page import Page, input_link
from gfb.plot import film as plot_film

# Criteria of the judgements.
SAG = 1.0e-6        # a noteworthy one [m]
OFF = 1.0e-6        # way towards the shaft of a top foil that has left the bumps [m]
SUCTION = 0.995     # of the ambient pressure: below it there is sub-ambient pressure
WAVE = 0.05         # fall of the film thickness towards the weld, over its largest value before
BEGIN, END = 90.0, 270.0  # the beginning and the end of the film [deg]
MILD = (0.0, 0.05, 0.1, 0.2, 0.3)  # friction; beyond it a cold start takes long under this load
# Fig. 10's numbers are of one load, where something is varied [N].
ONE_LOAD = {"sweep.values": 100.0}


def draw_fig9(runs, folder):
    """Fig. 9."""
    case = "gu2020_bearing_fig9"
    page = Page("fig9", "[Gu2020] fig. 9: film thickness, pressure and deflection under 134.1 N at 30,000 rpm", folder)
    shown = {"resting": runs.run(case), "top foil fixed at the leading edge": runs.run(case, TOP_LEADING),
             "resting, paper's mesh": runs.run(case, PAPER_MESH)}
    one, missed = lifted(runs, "shell", case, PAPER_MESH)
    if one is not None:
        shown["lifted, paper's mesh"] = one
    base = page.took(list(shown.values()))[0]
    page.picture(base.draw_film(), "Pressure, film thickness and deflection")
    page.say("The case file: both foils fixed at the trailing edge. Upper right: fig. 9b along midplane and edges, "
             "middle right: fig. 9a, lower row: fig. 9c, with the deflection positive towards the sleeve.")
    page.picture(draw_midplanes(shown), "Film thickness along the midplane", "_midplane")
    page.table("Answers of the case file and of some with one thing changed", ["", *shown],
               answer_rows(list(shown.values())))
    if missed:
        page.say(f"The lifted branch on the paper's mesh: {missed}.")
    judge_fig9(page, shown)
    page.tell_verdicts()
    page.short = (f"smallest film {gaps(base)} um at midplane and edges, largest pressure "
                  f"{base['maximum_pressure']/ambient(base):.2f} p_a, sags of {MICRO*sag(base):.1f} um; "
                  f"{page.count()}.")
    page.head("What the paper leaves open, and what it does")
    page.variants("The case file with one thing changed", runs, [(case, {})],
                  [AS_IT_IS, *friction_variants(MILD), *mesh_variants()],
                  ["e/C", "smallest film, midplane and edges [um]", "largest, smallest p/p_a", "sag [um]"],
                  lambda one: [position_words(position(one)), gaps(one), pressures(one), f"{MICRO*sag(one):.2f}"])
    page.say("What else is open (fixed edges, the strip's first line, pitch) is varied under 100 N on "
             "[the page of positions](positions.md).")
    page.parameters(base, f"{input_link(case)}.")
    return page


def judge_fig9(page, shown):
    """The text's statements on fig. 9, of every answer shown."""
    def each(words):
        return "; ".join(f"{name}: {words(one)}" for name, one in shown.items()) + "."

    page.judge("the predicted film agrees with the measured one where it is thin, and varies like it elsewhere.", None,
               UNCOMPARED)
    page.judge("there are noteworthy sags between neighbouring bumps where the film is thin.",
               {name: sag(one) > SAG for name, one in shown.items()},
               f"Largest sag [um]: {each(lambda one: f'{MICRO*sag(one):.1f}')} (Criterion: {MICRO*SAG:.0f} um.)")
    for words, place in (("beginning", lambda theta: theta < BEGIN), ("end", lambda theta: theta > END)):
        page.judge(f"at the {words} of the film sub-ambient pressure separates the top foil from the bumps and bends "
                   "it towards the shaft.", {name: leaves(one, place) for name, one in shown.items()},
                   "Smallest p/p_a there and largest displacement towards the shaft [um]: "
                   + each(lambda one, there=place: "{:.3f}, {:.1f}".format(*suction(one, there)))
                   + f" (Criterion: pressure below {SUCTION} p_a, displacement above {MICRO*OFF:.0f} um.)")
    page.judge("the weld restrains the top foil, so that a wave of pressure and film stands near the welded edge.",
               {name: wave(one) > WAVE for name, one in shown.items() if welded_behind(one)},
               f"Fall of the film thickness towards the trailing edge, over its largest value behind {END:.0f} "
               "degrees: "
               + each(lambda one: f"{100.0*wave(one):.0f} %")
               + f" (Criterion: {100.0*WAVE:.0f} % where that edge is the welded one.)")


def welded_behind(result):
    """Whether the top foil is fixed at the trailing edge."""
    return result.used["top_foil", "fixed_edge"][0] == "'trailing'"


def suction(result, place):
    """Smallest pressure over the ambient one, and largest displacement towards the shaft [um], where `place` says."""
    there = place(result.film.theta)
    return (result.film.fields["pressure"][there].min()/ambient(result),
            -MICRO*result.film.fields["deflection"][there].min())


def leaves(result, place):
    """Whether the top foil leaves the bumps under suction there."""
    pressure, way = suction(result, place)
    return pressure < SUCTION and way > MICRO*OFF


def wave(result):
    """How far the film thickness falls again along the end of the midplane, over its largest value before."""
    gap = midplane(result, "gap")[result.film.theta > END]
    largest = numpy.maximum.accumulate(gap)
    return ((largest - gap)/largest).max()


def draw_midplanes(shown):
    """Film thickness along the midplane of several answers."""
    figure, chart = pyplot.subplots(figsize=(10.0, 4.0), layout="constrained")
    for (name, one), style in zip(shown.items(), ("-", "--", ":", "-.")):
        chart.plot(one.film.theta, MICRO*midplane(one, "gap"), style, label=name)
    chart.set(ylabel="film thickness at the midplane [um]", ylim=(0.0, None))
    chart.grid(alpha=0.3)
    chart.legend(fontsize=8)
    plot_film.label_theta(chart, shown["resting"].film)
    return figure


# --- smallest films against the load ---

def draw_fig10(runs, folder):
    """Fig. 10."""
    case = "gu2020_bearing_fig10"
    page = Page("fig10", "[Gu2020] fig. 10: smallest film thickness against load at 45,000 rpm, C = 21 um", folder)
    names = {"top foil fixed at the leading edge": case, "top foil fixed at the trailing edge": f"{case}_trailing"}
    sweeps = {name: runs.run(one) for name, one in names.items()}
    page.took(list(sweeps.values()))
    page.picture(draw_loads(sweeps), "Smallest film thickness at midplane and edges against load")
    tell_loads(page, sweeps)
    first = sweeps["top foil fixed at the leading edge"].history
    page.judge("prediction and measurement match quite well overall, with C = 21 um taken from elsewhere to come "
               "nearer.",
               None, UNCOMPARED)
    for words, one in sweeps.items():
        load, middle, edge = (one.history[name] for name in ("load", "minimum_gap_midplane", "minimum_gap_edge"))
        order = numpy.argsort(load)
        page.judge(f"the smallest film falls with the load, at the midplane and at the edge ({words}).",
                   bool((numpy.diff(middle[order]) < 0.0).all() and (numpy.diff(edge[order]) < 0.0).all()),
                   f"From {MICRO*middle[order][0]:.1f} and {MICRO*edge[order][0]:.1f} um at {load.min():.0f} N to "
                   f"{MICRO*middle[order][-1]:.1f} and {MICRO*edge[order][-1]:.1f} um at {load.max():.0f} N.")
    page.tell_verdicts()
    apart = largest_apart(*(one.history for one in sweeps.values()))
    heaviest = int(numpy.argmax(first["load"]))
    page.short = (f"{MICRO*first['minimum_gap_midplane'][heaviest]:.2f} and "
                  f"{MICRO*first['minimum_gap_edge'][heaviest]:.2f} um at midplane and edges under "
                  f"{first['load'][heaviest]:.0f} N; which edge of the top foil is fixed moves them by "
                  f"{MICRO*apart:.2f} um at most; measured data are curves only.")
    page.items([
        "At every load the film at the edges is thinner than at the midplane "
        f"(by {MICRO*(first['minimum_gap_midplane'] - first['minimum_gap_edge']).max():.2f} um at most)."
        if (first["minimum_gap_edge"] < first["minimum_gap_midplane"]).all() else
        "The film at the edges is not thinner than at the midplane at every load.",
        "Friction acts in every point as if it were loaded from rest.",
        "With the top foil fixed at the trailing edge the branch ends in a fold below the smallest load here; "
        "[bearing_shells.md](../bearing_shells.md#where-a-branch-ends) shows it, and other branches."])
    page.head("What the paper leaves open, and what it does")
    page.say("Which loads were computed, which edge is fixed, and where along the edge the film was measured. Varied "
             "under 100 N:")
    variants = [AS_IT_IS,
                ("clearance (the paper takes 21 um here, 31.8 um elsewhere)", {"bearing.clearance": 31.8e-6}),
                ("which edge of the strip is fixed", {"bump_foil.fixed_edge": "leading"}),
                *(("friction (table 1: 0.1)", one) for one in frictions(MILD)),
                ("contact stiffness", {"contact.normal_stiffness": 5.0e10}),
                *(one for one in mesh_variants() if one[1].get("mesh.axial_elements") != 16),
                ("mesh: elements over the width, 32 for 16", {"mesh.axial_elements": 32})]
    page.variants("Top foil fixed at the leading edge, 100 N, one thing changed", runs, [(case, ONE_LOAD)], variants,
                  ["e/C", "smallest film, midplane and edges [um]",
                   "lift of the trailing edge, midplane and edges [um]"],
                  lambda one: [position_words(position(one)), gaps(one), lifts(one, "trailing")])
    page.parameters(sweeps["top foil fixed at the leading edge"],
                    ", ".join(map(input_link, names.values()))
                    + ", which differ in the top foil's fixed edge and the loads.")
    return page


def largest_apart(one, other):
    """Largest difference of the smallest films at loads of both sweeps [m]."""
    common = sorted(set(one["load"]) & set(other["load"]))
    return max(abs(one[name][list(one["load"]).index(load)] - other[name][list(other["load"]).index(load)])
               for load in common for name in ("minimum_gap_midplane", "minimum_gap_edge"))


def draw_loads(sweeps):
    """Smallest films of both sweeps."""
    figure, chart = pyplot.subplots(figsize=(7.5, 4.6), layout="constrained")
    for (name, one), style in zip(sweeps.items(), ("o-", "s--")):
        for column, words, colour in (("minimum_gap_midplane", "midplane", "C0"), ("minimum_gap_edge", "edges", "C1")):
            chart.plot(one.history["load"], MICRO*one.history[column], style, color=colour, markersize=4,
                       markerfacecolor="none", label=f"{words}, {name}")
    chart.set(xlabel="load [N]", ylabel="smallest film thickness [um]", ylim=(0.0, None), xlim=(0.0, None))
    chart.grid(alpha=0.3)
    chart.legend(fontsize=8)
    return figure


def tell_loads(page, sweeps):
    """A row a load, both sweeps side by side."""
    rows = []
    for load in sorted({load for one in sweeps.values() for load in one.history["load"]}, reverse=True):
        row = [f"{load:.0f}"]
        for one, edge in zip(sweeps.values(), ("trailing", "leading")):
            at = numpy.flatnonzero(one.history["load"] == load)
            if len(at) == 0:
                row += [""]*4
                continue
            point = {column: values[at[0]] for column, values in one.history.items()}
            e = numpy.array([point["eccentricity_x"], point["eccentricity_y"]])/clearance(one)
            row += [f"{MICRO*point['minimum_gap_midplane']:.2f}", f"{MICRO*point['minimum_gap_edge']:.2f}",
                    position_words(e), lifts(point, edge)]
        rows.append(row)
    page.table("Films and lifts of the free edge (at midplane and edges) in um; first four columns: top foil fixed at "
               "the leading edge, last four: at the trailing edge",
               ["load [N]", *["midplane", "edges", "e/C", "lift"]*2], rows,
               words=0)
