"""Page of the equilibrium positions of [Gu2020] section 4.3, beside the branches that gfb finds."""

import numpy
from matplotlib import pyplot

from gfb.gallery.bearing import (AS_IT_IS, MICRO, TOP_LEADING, clearance, friction_variants, gaps, lifted, lifted_start,
                             mesh_variants, open_variants, position, position_words)
from gfb.gallery.page import Page, input_link

OTHER_EDGE = "top foil fixed at the leading edge"
PAPER = {"beam": (0.9447, 0.2174), "shell": (0.9416, 0.2159)}
# Another program's positions: on the paper's mesh, and (beams) with the mesh refined until nothing changes. Its keys
# are those of inputs/gu2020_position_*.nml.
INDEPENDENT = {
    ("beam", "paper's"): {"resting": (0.9182, 0.2711), "middle": (0.9320, 0.2377), "lifted": (0.9435, 0.2181),
                          OTHER_EDGE: (0.9248, 0.2666)},
    ("shell", "paper's"): {"resting": (0.9108, 0.2622), "lifted, corners more": (0.9319, 0.2181),
                           OTHER_EDGE: (0.9174, 0.2578)},
    ("beam", "default"): {"resting": (0.9553, 0.2799), "lifted": (0.9791, 0.2269)},
}
MESH = "paper's"
MODELS = {"beam": "beams (2D)", "shell": "shells (3D)"}
NEAR = 0.003    # of C: a position that agrees
MATCH = 0.005   # of C: an independent position that is the same branch's
CLOSE = 0.02    # of C: models that match closely
BRANCHES = "--branches"
# Here the search for all branches takes an hour: gfb is asked for the resting one, and for one lifted as said.
UNSEARCHED = {("shell", "default"), ("shell", "paper's")}


def draw(runs, folder):
    """Positions of both models on both meshes."""
    page = Page("positions", "[Gu2020] section 4.3: where the aligned shaft floats under 100 N at 30,000 rpm", folder)
    rows, points, missed = [], [], []
    for model in MODELS:
        for mesh in scenes(model):
            found, words = branches(runs, page, model, mesh)
            missed += [f"{MODELS[model]}, {mesh} mesh: {words}."] if words else []
            for branch, point in found:
                points.append((model, mesh, branch, point))
                rows.append(point_row(model, mesh, branch, point))
    page.picture(draw_positions(points), "Positions e/C: the paper's, gfb's branches, independent ones")
    page.table("Equilibria under 100 N; distance: of e/C from the paper's position of that model; independent: another "
               "program's position within 0.005 C, for beams on the default mesh that of a converged mesh",
               ["foils", "mesh", "branch", "e/C", "distance, x and y", "distance", "film, midplane and edges [um]",
                "lift of the leading edge, midplane and edges [um]", "stability", "independent",
                "gfb less independent"],
               rows, words=3)
    page.say("`stability`: negative eigenvalues of the foils' stiffness, shaft fixed, 0: stable; in brackets the stiffness, "
             "over p_a/C, of the mode nearest to a change (within 0.01 it is nearly neutral). "
             + ("" if any("stability" in point for *_, point in points) else
                "This version of gfb does not compute it. ")
             + ("" if lifted_start(runs) or BRANCHES in runs.options else
                "This version cannot be asked for lifted branches. ")
             + "The independent program's lifted branches on the paper's mesh stand "
             + " and ".join(f"{numpy.hypot(*(numpy.array(PAPER[model]) - INDEPENDENT[model, MESH][branch])):.4f} C "
                            f"({MODELS[model]}: {branch}, {position_words(INDEPENDENT[model, MESH][branch])})"
                            for model, branch in (("beam", "lifted"), ("shell", "lifted, corners more")))
             + " from the paper's positions. It counts negative eigenvalues as `stability` does: 0 on resting branches, 2 "
               "and 3 on the beams' middle and lifted ones. [branches.md](../../manual/branches.md) says how branches are found.")
    if missed:
        page.items(missed)
    judge(page, points)
    page.tell_verdicts()
    tell_open(runs, page)
    page.parameters(runs.run("gu2020_position_shell"), f"{input_link('gu2020_position_beam')}, "
                    f"{input_link('gu2020_position_shell')} (shown), on the paper's mesh; the default mesh is that of "
                    f"{input_link('gu2020_bearing')}, for beams with `foil = 'beam'`.")
    return page


def scenes(model):
    """{mesh: case and changes}."""
    return {"paper's": (f"gu2020_position_{model}", {}), "default": ("gu2020_bearing", {"model.foil": model})}


def branches(runs, page, model, mesh):
    """[(name, values of its point)] of all branches found, and words on those that are missed."""
    case, changes = scenes(model)[mesh]
    found, missed = [], ""
    if BRANCHES in runs.options and (model, mesh) not in UNSEARCHED:
        result = page.took([runs.run(case, changes, options=(BRANCHES,))])[0]
        found = [(name_of(point), point) for point in points_of(result)]
    else:
        found = [("resting", points_of(page.took([runs.run(case, {**changes, **judged(runs)})])[0])[-1])]
        missed = "only the branches above were looked for; [branches.md](../../manual/branches.md) has others"
        if mesh == MESH:
            raised, words = lifted(runs, model, case, {**changes, **judged(runs)})
            if raised is not None and raised.converged:
                found.append((name_of(points_of(raised)[-1]), points_of(page.took([raised])[0])[-1]))
            else:
                missed = f"{words}; {missed}"
    other = page.took([runs.run(case, {**changes, **TOP_LEADING})])[0]
    return [*found, (OTHER_EDGE, points_of(other)[-1])], missed


def judged(runs):
    """Asks for the stability of an answer, where the program knows of it."""
    return {"solver.stability": True} if ("solver", "stability") in runs.keys else {}


def points_of(result):
    """Rows of the history, each {name: value}; positions over C."""
    return [{"e": numpy.array([result.history["eccentricity_x"][i],
                               result.history["eccentricity_y"][i]])/clearance(result),
             **{name: values[i] for name, values in result.history.items()}}
            for i in range(len(result.history["eccentricity_x"]))]


def name_of(point):
    """A branch, by how its free leading edge lies."""
    middle, edge = (MICRO*point[name] for name in ("leading_edge_lift", "leading_edge_lift_edge"))
    if max(middle, edge) < 1.0:
        return "resting"
    if middle < 1.0:
        return f"corners lifted {edge:.0f} um"
    return f"lifted {middle:.0f} um" + ("" if abs(edge - middle) < 0.5 else f", corners {edge:.0f} um")


def distance(model, point):
    """From the paper's position, over C."""
    return point["e"] - numpy.array(PAPER[model])


def point_row(model, mesh, branch, point):
    """A row of the table."""
    off = distance(model, point)
    known = [numpy.array(one) for name, one in INDEPENDENT.get((model, mesh), {}).items()
             if (name == OTHER_EDGE) == (branch == OTHER_EDGE) and numpy.hypot(*(point["e"] - one)) < MATCH]
    known = min(known, key=lambda one: numpy.hypot(*(point["e"] - one)), default=None)
    stability = point.get("stability")
    return [MODELS[model], mesh, branch, position_words(point["e"]), f"({off[0]:+.4f}, {off[1]:+.4f})",
            f"{numpy.hypot(*off):.4f}",
            f"{MICRO*point['minimum_gap_midplane']:.2f}, {MICRO*point['minimum_gap_edge']:.2f}",
            f"{abs_small(MICRO*point['leading_edge_lift'])}, {abs_small(MICRO*point['leading_edge_lift_edge'])}",
            "" if stability is None else f"{stability:.0f} ({point['stability_margin']:.3f})",
            "" if known is None else position_words(known),
            "" if known is None else "({:+.4f}, {:+.4f})".format(*(point["e"] - known))]


def abs_small(value):
    """A length in words, without a sign at zero."""
    return f"{round(value, 1) + 0.0:.1f}"


def judge(page, points):
    """The paper's positions and its remark on them."""
    nearest = {}
    for model, words in MODELS.items():
        branch, point, mesh = min(((branch, point, mesh) for one, mesh, branch, point in points if one == model),
                                  key=lambda one: numpy.hypot(*distance(model, one[1])))
        off = numpy.hypot(*distance(model, point))
        nearest[model] = off
        resting = next(one for m, mesh_of, name, one in points if (m, mesh_of, name) == (model, "paper's", "resting"))
        page.judge(f"with {words} the shaft stands at e/C = {position_words(PAPER[model])}.", off < NEAR,
                   f"The nearest branch ({branch}, {mesh} mesh) is {off:.4f} away, at {position_words(point['e'])}; "
                   f"the resting one on the paper's mesh {numpy.hypot(*distance(model, resting)):.4f} (criterion: "
                   f"{NEAR}).")
    e = {model: next(one["e"] for m, mesh, name, one in points if (m, mesh, name) == (model, "paper's", "resting"))
         for model in MODELS}
    apart = numpy.hypot(*(e["beam"] - e["shell"]))
    paper = numpy.hypot(*(numpy.array(PAPER["beam"]) - PAPER["shell"]))
    page.judge("the two models match closely.", apart < CLOSE,
               f"Resting on the paper's mesh they are {apart:.4f} C apart, the paper's {paper:.4f} (criterion: "
               f"{CLOSE}; gfb's is {apart/paper:.1f} times the paper's).")
    page.short = ("nearest branches to the paper's positions: "
                  + ", ".join(f"{words} {nearest[model]:.4f} C away" for model, words in MODELS.items())
                  + f"; {page.count()}.")


def tell_open(runs, page):
    """What the paper does not say, and what it does to both models."""
    page.head("What the paper leaves open, and what it does")
    page.say("Which equilibrium is meant: several exist, and a resting and a lifted leading edge differ most in e_y. "
             "No mesh is given for the 2D foils. The resting branch on the default mesh, with one thing changed:")
    page.variants("100 N at 30,000 rpm; films at the midplane and at the edges", runs,
                  [("gu2020_bearing", {"model.foil": model}) for model in MODELS],
                  [AS_IT_IS, *open_variants(), *friction_variants(), *mesh_variants()],
                  ["beams: e/C", "films [um]", "shells: e/C", "films [um]"],
                  lambda one: [position_words(position(one)), gaps(one)])
    page.say("[bearing_mesh.md](../bearing_mesh.md) has more meshes, with orders and errors.")


def draw_positions(points):
    """e/C of everything."""
    figure, chart = pyplot.subplots(figsize=(8.0, 5.4), layout="constrained")
    marks = {"resting": "o", OTHER_EDGE: "^"}
    for model, colour in zip(MODELS, ("C0", "C1")):
        chart.plot(*PAPER[model], "*", color=colour, markersize=15, markeredgecolor="k",
                   label=f"[Gu2020], {MODELS[model]}")
        for (one, mesh), known in INDEPENDENT.items():
            if one == model and mesh == "paper's":
                chart.plot(*zip(*known.values()), "+", color=colour, markersize=13,
                           label=f"independent, {MODELS[model]}, paper's mesh")
    for model, mesh, branch, point in points:
        colour = "C0" if model == "beam" else "C1"
        chart.plot(*point["e"], marks.get(branch, "s"), color=colour, markersize=7,
                   markerfacecolor=colour if mesh == "default" else "none",
                   label=f"{MODELS[model]}, {mesh} mesh: {branch}")
    chart.set(xlabel="e_x/C", ylabel="e_y/C")
    chart.grid(alpha=0.3)
    chart.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    chart.margins(0.12)
    return figure
