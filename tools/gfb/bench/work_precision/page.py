"""Page, tables and pictures of tools/bench work-precision."""

import os
import textwrap

from gfb.bench.work_precision import errors
from gfb.tables import markdown_table, plain_table

WIDE = 120  # letters of a line
SHOWN = (0.1, 0.01, 0.001)  # targets of the table
# By hand, from the tables below it: to be read again where these are made anew.
RULES = """## What to use when

- The simpler models stay off by a fixed amount, however fine their mesh (*what models converge to*, below): a rigid sleeve by a
  third of the position and the smallest film, an elastic foundation by as much and by a sixth of the largest pressure.
  Planar beams have the position within 2 %, film and pressure within 11 to 16 % while the shaft is aligned; the restoring torque
  of a tilted shaft is 75 % too large. Tilted shafts want shells.
- For shells 8 elements over the half width and 24 + 6 a bump are within 10 % of all that is read, 16 over the half width within
  3 % or better. Biquadratic film elements are as good as bilinear ones on four times the elements around.
- Half the width instead of the whole, condensed bumps instead of all unknowns, monolithic instead of partitioned change
  nothing and cost less: they are the defaults.
- Other friction laws, fewer elements a bump and foils without friction gain no time worth having and change the answer.

The cheapest entry that is surely within a target, and nowhere off by more than {elsewhere} % (else it meets
the target by accident):

"""
MARKS = ("o", "s", "^", "D", "v", "P", "X", "*", "<", ">", "h", "d", "p", "8", "H")
COSTS = {"cpu": ("CPU time [s]", lambda one: one.cpu),
         "factorizations": ("factorizations", lambda one: max(1.0, one.count("factorizations"))),
         "memory": ("peak memory [MB]", lambda one: one.count("peak_memory")/1.0e6)}


def write(measured, store, options, folder):
    """Leaves the page and the pictures; returns the tables as plain text."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for name, scene in measured.items():
        facts = errors.known(scene, store)
        found[name] = (scene, facts, errors.judge(scene, store, facts))
        draw(*found[name], folder/f"work_precision_{name}.png")
    tables, pieces = [], [page_head(measured, store, options), conclusions(found)]
    for name, (scene, facts, judged) in found.items():
        several = scene_tables(scene, facts, judged)
        tables += several
        pieces.append(scene_section(name, scene, facts, judged, several))
    (folder/"work_precision.md").write_text("\n".join(pieces), encoding="utf-8")
    return f"page and pictures are in {folder}\n" + "".join("\n" + plain_table(*table) for table in tables)


def page_head(measured, store, options):
    """What was measured and how."""
    rows = [store.row(groups) for scene in measured.values()
            for groups in [*(entry.groups for entry in scene.entries), *(groups for _, groups in scene.reference)]]
    spent, most = sum(sum(row["cpu"]) for row in rows), max(row["summary"]["peak_memory"] for row in rows)
    quick = "\n**These are the figures of `--quick`: small meshes, which say little.**\n" if options.quick else ""
    return f"""# Speed against error

```
tools/bench work-precision --docs     # --reuse resumes it where it was stopped
tools/bench work-precision --quick    # a minute of processor time, small meshes
```
{quick}
Five scenes, each solved with every model that applies on meshes from coarse to fine. The tables
are written by the tool from the figures of one machine: {os.cpu_count()} cores, shared with other jobs. All runs together
took {spent/60.0:.0f} minutes of CPU time, the largest {most/1e9:.1f} GB.

- **Error**: of what an engineer reads, relative, against a **reference** finer than all that is compared with it: the
  whole model (shells with friction; the rigid film on biquadratic elements). So an error has two parts. The **model's**
  stays however fine the mesh is: it is what a family of entries (such as beams) still is off by on its finest mesh.
  The **discretisation's** is the rest.
- **The reference's own uncertainty** follows from its two coarser neighbours by the rule of [accuracy.md](../manual/accuracy.md).
  An error below it is written as `< ` that uncertainty: the reference cannot judge it. An entry meets a target only if
  its error and that uncertainty do together.
- **By luck** (`*`): an error that is small only because those of model and mesh cancel. A finer mesh of the same model
  is off by more than {errors.LUCK:g} times as much. Such an entry meets no target and is not on the front; hollow in the
  pictures.
- **CPU**: user and system time of the whole process on one rank, from the case file to the result files, the smallest
  of up to {max(len(row["cpu"]) for row in rows)} runs (one, where it takes long); MPI's start is 0.1 s of it. Newton iterations and
  factorizations are exact counts, those on the coarse meshes of a cold start included. **Memory**: the most that the
  process held.
- **Front**: no other entry is both cheaper and better (in the quantity of the picture's left panels).
"""


# --- tables ---

def percent(value):
    """A relative number in per cent, with two digits."""
    hundred = 100.0*value
    digits = 0 if hundred >= 9.95 else 1 if hundred >= 0.995 else 2 if hundred >= 0.0995 else 3
    return f"{hundred:.{digits}f}" if hundred >= 0.000995 or hundred == 0.0 else f"{hundred:.0e}"


def error_words(one, facts, i):
    """An error in per cent, or what the reference can judge."""
    words = f"< {percent(facts[i].doubt)}" if one.errors[i] < facts[i].doubt else percent(one.errors[i])
    return words + "*"*(i in one.luck)


def scene_tables(scene, facts, judged):
    """The scene's tables: title, heads, rows."""
    return [entry_table(scene, facts, judged), limit_table(scene, facts, judged), pair_table(scene, judged)]


def entry_table(scene, facts, judged):
    """Cost and errors of each entry."""
    heads = ["model", "mesh", "unknowns", "Newton iterations", "factorizations", "CPU [s]", "memory [MB]",
             *(f"{one.words} [%]" for one in scene.quantities), "front"]
    best = errors.front(judged, facts, 0, COSTS["cpu"][1])
    rows, before = [], None
    for one in judged:
        cells = [one.entry.family if one.entry.family != before else "", one.entry.mesh,
                 *(f"{one.count(name):,.0f}" for name in ("unknowns", "newton_iterations", "factorizations")),
                 f"{one.cpu:.2f}", f"{one.count('peak_memory')/1e6:,.0f}"]
        before = one.entry.family
        told = [one.state] + [""]*(len(facts) - 1) if one.state else \
            [error_words(one, facts, i) for i in range(len(facts))]
        rows.append([*cells, *told, "yes" if one in best else ""])
    return (scene.words, heads, rows)


def limit_table(scene, facts, judged):
    """What families converge to."""
    heads = ["model", "finest mesh", "CPU [s]", *(f"{one.words} [%]" for one in scene.quantities),
             "changed on its last refinement by [%]"]
    rows = [[one.entry.family, one.entry.mesh, f"{one.cpu:.2f}",
             *(error_words(one, facts, i) for i in range(len(facts))), ", ".join(percent(value) for value in last)]
            for one, last in errors.limits(facts, judged)]
    return (f"{scene.words}: what models converge to", heads, rows)


def pair_table(scene, judged):
    """What one simplification costs and gains on one mesh."""
    heads = ["simplification", "mesh", "CPU [s]", "times cheaper", "times less memory",
             *(f"{one.words} [%]" for one in scene.quantities)]
    rows = [[words, cheap.entry.mesh, f"{dear.cpu:.2f} to {cheap.cpu:.2f}", f"{dear.cpu/cheap.cpu:.2f}",
             f"{dear.count('peak_memory')/cheap.count('peak_memory'):.2f}",
             *(percent(value) for value in changes)]
            for words, dear, cheap, changes in errors.pairs(scene, judged)]
    return (f"{scene.words}: one simplification at a time", heads, rows)


# --- sections ---

def filled(words):
    """A paragraph in lines."""
    return textwrap.fill(words, WIDE, break_long_words=False, break_on_hyphens=False)


def conclusions(found):
    """What to use when, and what meets which target."""
    return RULES.format(elsewhere=percent(errors.ELSEWHERE)) + markdown_table(
        "", ["scene", "quantity", *(f"to {100.0*one:g} %" for one in SHOWN)],
        [row for several in found.values() for row in target_rows(*several)])


def target_rows(scene, facts, judged):
    """Rows of the table of targets: each quantity, then all of them."""
    rows = []
    for i, one in enumerate([*facts, None]):
        places = range(len(facts)) if one is None else [i]
        doubt = max(facts[at].doubt for at in places)
        cells = []
        for target in SHOWN:
            best = errors.cheapest(judged, facts, places, target)
            cells.append(f"{best.entry.words}: {best.cpu:.2f} s" if best else
                         "the reference cannot judge it" if doubt >= target else "none of these")
        rows.append([scene.words if i == 0 else "", one.quantity.words if one else "all of them", *cells])
    return rows


def scene_section(name, scene, facts, judged, tables):
    """A scene: picture, reference, tables."""
    entries, finest, each = tables
    missing = [f"{one.entry.words}: {one.state}" for one in judged if one.state]
    pieces = [f"## {scene.words[0].upper()}{scene.words[1:]}\n", filled(scene.said) + "\n",
              f"![Errors against CPU time, factorizations, memory](work_precision_{name}.png)\n",
              reference_words(scene, facts), markdown_table(*entries)]
    if missing:
        pieces.append(filled("Not compared: " + "; ".join(missing) + ".") + "\n")
    if finest[2]:
        pieces += ["Each kind on its finest mesh: its error, and by how much the last refinement changed it. Where that\n"
                   "is much less than the error, the error is the model's.\n", markdown_table(*finest)]
    if each[2]:
        pieces += ["One simplification at a time, on one mesh: what is gained, and by how much the answer changes.\n",
                   markdown_table(*each)]
    return "\n".join(pieces)


def reference_words(scene, facts):
    """The reference and how well it is known."""
    orders = ["no order" if one.order is None or one.order < errors.LOWEST_ORDER else f"order {one.order:.1f}"
              for one in facts]
    doubts = "; ".join(f"{one.quantity.words} {percent(one.doubt)} % ({order})" for one, order in zip(facts, orders))
    coarse, middle, fine = (mesh for mesh, _ in scene.reference)
    return filled(f"Reference: {scene.whole}, {fine} (its neighbours: {middle} and {coarse}). Its uncertainty: "
                       f"{doubts}.") + "\n"


# --- pictures ---

def draw(scene, facts, judged, path):
    """Errors of two quantities against CPU time, and of the first against factorizations and memory."""
    from matplotlib import pyplot

    figure, panels = pyplot.subplot_mosaic("ab;cd;ll", figsize=(11.0, 9.6), layout="constrained",
                                           gridspec_kw={"height_ratios": (1.0, 1.0, 0.26)})
    families = list(dict.fromkeys(one.entry.family for one in errors.compared(judged)))
    for place, i, cost in (("a", 0, "cpu"), ("b", 1, "cpu"), ("c", 0, "factorizations"), ("d", 0, "memory")):
        draw_panel(panels[place], facts, judged, families, i, cost)
        panels[place].set_title(scene.quantities[i].words, fontsize=10)
    panels["l"].axis("off")
    panels["l"].legend(*panels["a"].get_legend_handles_labels(), fontsize=8, loc="center", ncols=4)
    figure.suptitle(scene.words)
    figure.savefig(path, dpi=90)
    pyplot.close(figure)


def draw_panel(axes, facts, judged, families, i, cost):
    """One panel."""
    from matplotlib.ticker import FuncFormatter, LogLocator

    words, cost_of = COSTS[cost]
    for number, family in enumerate(families):
        colour, mark = f"C{number % 10}", MARKS[number % len(MARKS)]
        points = sorted((cost_of(one), errors.sure(one, facts[i], i), i in one.luck) for one in errors.compared(judged)
                        if one.entry.family == family)
        costs, heights, lucky = zip(*points)
        axes.plot(costs, heights, linestyle="-" if cost == "cpu" else "none", linewidth=0.7, color=colour, marker=mark,
                  markersize=5, label=family)
        axes.plot([one for one, luck in zip(costs, lucky) if luck], [one for one, luck in zip(heights, lucky) if luck],
                  linestyle="none", color=colour, marker=mark, markersize=5, markerfacecolor="white")
    best = [(cost_of(one), errors.sure(one, facts[i], i)) for one in errors.front(judged, facts, i, cost_of)]
    axes.step(*zip(*best), where="post", color="black", linewidth=1.6, alpha=0.6, label="front")
    axes.set(xscale="log", yscale="log", xlabel=words, ylabel="relative error")
    axes.xaxis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
    axes.xaxis.set_major_formatter(FuncFormatter(plain_number))
    axes.xaxis.set_minor_formatter(FuncFormatter(plain_number))
    axes.margins(0.08)
    low = axes.get_ylim()[0]
    if facts[i].doubt > low:
        axes.axhspan(low, facts[i].doubt, color="0.85", label="below what the reference can judge")
        axes.set_ylim(bottom=low)
    axes.grid(which="both", alpha=0.25)


def plain_number(value, _):
    """A tick without powers of ten."""
    return f"{value:g}"
