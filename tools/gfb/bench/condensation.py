"""Ten bumps of [Gu2020] as shells: full against condensed, and ways to condense.

The linear strip (table 1, case 1; whole width, first corner line clamped, all corner lines held in v) goes
from its mesh to all displacements by three methods: full; reduced with equal substructures condensed once; reduced
with each of its 30 substructures condensed on its own. Then one of each kind is condensed by
MatSchurComplement with an exact inner solver, as gfb does it, and by MUMPS' own Schur complement. Last, the
speed of the element's stiffness. CPU times of one rank; gfb_bench_condensation, which the build leaves
beside gfb, does the work.
"""

import os
import pathlib
import statistics

from gfb.bench.options import add_first, add_repetitions
from gfb.program import call
from gfb.tool import stop

MESHES = ((12, 3, 50), (48, 12, 50), (24, 6, 100), (24, 6, 200))  # elements of an arc, of a flat, over the width
WAYS = {"full": "full", "congruent": "reduced, equal substructures once", "single": "reduced, each substructure"}
STEPS = {"set_up": "set-up", "factor": "factor", "refactor": "refactor", "solve": "solve",
         "recovery": "recovery"}
ONCE = ("set_up", "factor", "solve", "recovery")  # from the mesh to one answer


def add_options(parser):
    """The command's own options."""
    add_repetitions(parser, "runs of each mesh", 3)
    add_first(parser, "meshes", MESHES, "; the last one needs 5 GB")


def run(options):
    """Measures; returns the table and leaves the picture."""
    program = pathlib.Path(options.gfb).with_name("gfb_bench_condensation")
    if not os.access(program, os.X_OK):
        stop(f"there is no {program}: it is built together with gfb")
    measured = {mesh: [] for mesh in MESHES[:options.meshes]}
    for _ in range(options.repetitions):  # round all meshes, so that a slow minute hits all
        for mesh, runs in measured.items():
            runs.append(measure(program, mesh))
    draw(measured, options.output/"condensation.png")
    return (head(options) + way_table(measured) + complement_table(measured) + kernel_table(measured))


def measure(program, mesh):
    """{name: value} of one run."""
    done = call([program, *mesh])
    if done.status != 0:
        stop(f"{program} {mesh} ended with status {done.status}:\n{done.log}{done.complaint}", 3)
    values = {}
    for line in done.log.splitlines():
        name, value = line.split(",")
        values[name] = float(value)
    return values


def median(runs, name):
    """Of one name over the runs."""
    return statistics.median(one[name] for one in runs)


def once(one, way):
    """From the mesh to one answer [s]."""
    return sum(one[f"{way}.{step}"] for step in ONCE)


def ratio(runs, above, below):
    """Median of the ratios inside each run."""
    return statistics.median(above(one)/below(one) for one in runs)


def label(mesh):
    """A mesh in words."""
    return f"{mesh[0]} + {mesh[1]} x {mesh[2]}"


# --- tables ---

def head(options):
    """What was measured, and with what."""
    said = call([options.gfb, "--version"]).log
    return ("ten bumps of [Gu2020] table 1, case 1, whole width, one rank; median CPU times of "
            f"{options.repetitions} runs of each mesh\n{said.strip()}\n"
            "mesh: elements of an arc + a flat x width\n")


def way_table(measured):
    """Times of the three ways."""
    text = ("\nset-up: numbers, condensation, assembly; factor: analysis and numbers; refactor: numbers of the\n"
            "same pattern; solve: one right side; recovery: displacements of all nodes;\n"
            "once: set-up + factor + solve + recovery; over full: median of the ratios inside a run;\n"
            "difference: largest from the full strip's displacements (rotations), over the largest\n\n"
            f"mesh            method{'':30}unknowns   super-elements   " +
            "".join(f"{words:>9}" for words in STEPS.values()) + "     once   over full   difference\n" +
            f"{'':79}" + f"{'[s]':>9}"*(len(STEPS) + 1) + "\n")
    for mesh, runs in measured.items():
        for way, words in WAYS.items():
            text += (f"{label(mesh):15} {words:35} {runs[0][f'{way}.unknowns']:8.0f}"
                     f"{runs[0][f'{way}.condensed']:17.0f}")
            text += " "*3 + "".join(f"{median(runs, f'{way}.{step}'):9.4f}" for step in STEPS)
            text += f"{statistics.median(once(one, way) for one in runs):9.3f}"
            if way != "full":
                over = ratio(runs, lambda one, way=way: once(one, way), lambda one: once(one, "full"))
                text += f"{over:12.2f}{max(one[f'{way}.difference'] for one in runs):13.1e}"
            text += "\n"
    text += ("\nratios to the full strip              mesh            factor refactor  solve and recovery   "
             "set-up, each substructure / equal ones once\n")
    for mesh, runs in measured.items():
        text += (f"  reduced, equal substructures once   {label(mesh):15} "
                 f"{ratio(runs, *pair('factor')):6.2f}{ratio(runs, *pair('refactor')):9.2f}"
                 f"{ratio(runs, lambda one: answer(one, 'congruent'), lambda one: answer(one, 'full')):20.2f}"
                 f"{ratio(runs, lambda one: one['single.set_up'], lambda one: one['congruent.set_up']):39.2f}\n")
    return text


def pair(step):
    """The congruent strip's step and the full one's."""
    return lambda one: one[f"congruent.{step}"], lambda one: one[f"full.{step}"]


def answer(one, way):
    """One more right side, to the last displacement [s]."""
    return one[f"{way}.solve"] + one[f"{way}.recovery"]


def complement_table(measured):
    """The two ways to form the complement."""
    text = ("\none substructure of each kind condensed, its stiffness at hand; difference over the largest entry\n\n"
            "mesh            kinds  largest complement   MatSchurComplement [s]   MUMPS' own [s]   ratio   "
            "difference\n")
    for mesh, runs in measured.items():
        size = 5*runs[0]["complement.largest"]
        over = ratio(runs, lambda one: one["complement.matrix"], lambda one: one["complement.mumps"])
        text += (f"{label(mesh):15} {runs[0]['complement.kinds']:5.0f} {size:9.0f} unknowns"
                 f"{median(runs, 'complement.matrix'):25.4f}{median(runs, 'complement.mumps'):17.4f}"
                 f"{over:8.2f}{max(one['complement.difference'] for one in runs):13.1e}\n")
    return text


def kernel_table(measured):
    """Speed of the element."""
    values = [one["kernel.elements_per_second"] for runs in measured.values() for one in runs]
    return (f"\nelement stiffness (MITC4, 20 x 20): {statistics.median(values):,.0f} elements a second "
            f"({min(values):,.0f} to {max(values):,.0f} in {len(values)} runs)\n")


# --- picture ---

def draw(measured, path):
    """Times of each way and mesh, step upon step; times of both complements."""
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.0, 4.4), layout="constrained", width_ratios=(3, 2))
    place, places, words = 0.0, [], []
    for mesh, runs in measured.items():
        whole = statistics.median(once(one, "full") for one in runs)
        for way in WAYS:
            bottom, seconds = 0.0, statistics.median(once(one, way) for one in runs)
            for colour, step in zip(("C0", "C1", "C2", "C3"), ONCE):
                height = median(runs, f"{way}.{step}")/whole
                left.bar(place, height, bottom=bottom, color=colour, width=0.8,
                         label=STEPS[step] if place == 0.0 else None)
                bottom += height
            left.annotate(f"{seconds:.2g} s" if seconds < 10.0 else f"{seconds:.0f} s", (place, bottom),
                          xytext=(0, 2), textcoords="offset points", ha="center", fontsize=8)
            places.append(place)
            words.append({"full": "full", "congruent": "equal\nonce", "single": "each\nsubstructure"}[way])
            place += 1.0
        left.annotate(label(mesh), (place - 2.0, -0.17), xycoords=("data", "axes fraction"), ha="center", fontsize=9)
        place += 0.6
    left.set_xticks(places, words, fontsize=8)
    left.set(ylabel="CPU time over that of the full strip", title="from the mesh to all displacements, one load")
    left.margins(y=0.08)
    left.legend(fontsize=8, loc="upper left")
    left.grid(axis="y", alpha=0.3)
    for shift, colour, name, what in ((-0.2, "C0", "complement.matrix", "MatSchurComplement, exact inner solver"),
                                      (0.2, "C1", "complement.mumps", "MUMPS' own Schur complement")):
        heights = [median(runs, name) for runs in measured.values()]
        charted = right.bar([number + shift for number in range(len(heights))], heights, width=0.4, color=colour,
                            label=what)
        right.bar_label(charted, fmt="%.2g", fontsize=8)
    right.set_xticks(range(len(measured)), [f"{label(mesh)}\n{5*runs[0]['complement.largest']:.0f} retained"
                                            for mesh, runs in measured.items()], fontsize=8)
    right.set(yscale="log", ylabel="CPU time, three kinds [s]", title="one substructure of each kind condensed")
    right.margins(y=0.2)
    right.grid(axis="y", alpha=0.3)
    right.legend(fontsize=8, loc="upper left")
    figure.savefig(path, dpi=90)
