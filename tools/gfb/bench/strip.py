"""Frictional bump strips: full against reduced order, half against full width.

The same scene is solved with four models: all unknowns or condensed bumps, the full width or half of it. Contact,
load steps, Newton's method and linear solver are the same; times are CPU times of whole processes, from the case
file to the result files, so set-up and condensation are in them. The repetitions go round all models, and a ratio is
the median of the ratios inside the rounds: full order and full width over the model.
"""

import pathlib
import statistics
import tempfile

from gfb.bench.options import add_first, add_repetitions
from gfb.namelist import Groups
from gfb.results import read_history
from gfb.running import run_logged, start_time
from gfb.tables import markdown_table, plain_table
from gfb.tool import stop

# [Gu2020] table 1, load and friction as in inputs/gu2020_strip_case*.nml, but friction on both sides in case 1.
CASE_1: Groups = {
    "scene": {"analysis": "strip"},
    "bump_foil": {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "half_length": 1.778e-3,
                  "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 10, "width": 38.1e-3, "fixed_edge": "leading",
                  "fixed_line": "corner"},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
    "strip_load": {"kind": "crest_pressure", "distribution": "uniform", "pressure": 0.2e6},
}
CASE_2: Groups = {
    "scene": {"analysis": "strip"},
    "bump_foil": {"thickness": 0.127e-3, "youngs_modulus": 207.0e9, "poissons_ratio": 0.3, "half_length": 3.3e-3,
                  "height": 0.9e-3, "pitch": 7.0e-3, "bumps": 4, "width": 18.0e-3, "fixed_edge": "none"},
    "contact": {"friction_top": 0.2, "friction_sleeve": 0.2},
    "strip_load": {"kind": "plates", "maximum_force": 100.0},
}
PAPER, FINE, FINE_ARCS = (12, 3, 50), (24, 6, 100), (48, 12, 50)  # elements of an arc, of a flat, over the width
SCENES = (  # words, groups, mesh, steps up and down
    ("case 1", CASE_1, PAPER, {"steps_up": 10}),
    ("case 2 loop", CASE_2, PAPER, {"steps_up": 50, "steps_down": 50}),
    ("case 1", CASE_1, FINE, {"steps_up": 3}),
    ("case 1", CASE_1, FINE_ARCS, {"steps_up": 3}),
)
MODELS = {"full order, full width": ("none", "no"), "full order, half width": ("none", "yes"),
          "reduced, full width": ("guyan", "no"), "reduced, half width": ("guyan", "yes")}
REFERENCE, LEAST = "full order, full width", "reduced, half width"

# Parts of the time in PETSc's log, which do not overlap. The log has wall times, which other jobs stretch; the
# process' CPU time is shared out as they are.
PARTS = {"factorization": ("MatLUFactorSym", "MatLUFactorNum"), "triangular solves": ("MatSolve",),
         "matrix products": ("MatMult",), "matrix entries": ("SNESJacobianEval",)}
NEWTON = "SNESSolve"


def add_options(parser):
    """The command's own options."""
    add_repetitions(parser, "runs of each model", 3)
    add_first(parser, "scenes", SCENES, "; the later ones need minutes and 1.5 GB")


def run(options):
    """Measures; returns the table and leaves it in Markdown and the picture."""
    scenes = SCENES[:options.scenes]
    measured = [{model: [] for model in MODELS} for _ in scenes]
    with tempfile.TemporaryDirectory() as folder:
        start = start_time(options.gfb)
        for _ in range(options.repetitions):  # round all models, so that a slow minute hits all
            for scene, runs in zip(scenes, measured):
                for model in MODELS:
                    runs[model].append(measure(options.gfb, scene, model, folder))
    draw(scenes, measured, options.output/"strip.png")
    tables = [cost_table(scenes, measured), part_table(scenes, measured)]
    head = (f"bump strips of [Gu2020] table 1 with friction, one rank; medians of {options.repetitions} runs of each "
            f"model\nCPU: the whole process; MPI's start alone ('gfb --version') takes {start:.2f} s\n"
            "mesh: elements of an arc + a flat x width\n")
    (options.output/"strip.md").write_text("\n".join(markdown_table(*table) for table in tables), encoding="utf-8")
    return head + "".join("\n" + plain_table(*table) for table in tables) + least_lines(scenes, measured)


# --- one run ---

def strip_case(scene, model):
    """The case file's groups."""
    _, groups, mesh, steps = scene
    reduction, half_width = MODELS[model]
    return {**groups, "strip_load": {**groups["strip_load"], **steps},
            "model": {"reduction": reduction, "half_width": half_width},
            "mesh": dict(zip(("arc_elements", "flat_elements", "axial_elements"), mesh))}


def measure(gfb, scene, model, folder):
    """What one run costs, and its answers."""
    done, stages = run_logged(gfb, strip_case(scene, model), folder, "strip")
    events = stages["Main Stage"]
    whole = sum(stage.get("summary", (0.0, 0.0))[1] for stage in stages.values())
    if NEWTON not in events:
        stop("PETSc's log has no solve in it: is it built without logging?", 3)
    parts = {name: sum(events[event][1] for event in of) for name, of in PARTS.items()}
    parts["set-up, files, rest"] = whole - sum(parts.values())
    return {"summary": done.summary, "cpu": done.cpu, "answers": read_answers(pathlib.Path(folder)/"strip.h5"),
            "parts": {name: done.cpu*seconds/whole for name, seconds in parts.items()},
            "solves": events["MatSolve"][0]}


def read_answers(path):
    """{name: values of all load steps}, the deflections and the works."""
    import numpy

    history = read_history(path)
    lines = [name for name in history if name.startswith("crest_deflection_") or name == "plate_travel"]
    answers = {"deflections": numpy.stack([history[name] for name in lines])}
    return answers | {name: history[name] for name in ("external_work", "friction_work", "strain_energy")}


# --- figures of several runs ---

def cpu(runs):
    """Median CPU time [s]."""
    return statistics.median(one["cpu"] for one in runs)


def gain(measured, model):
    """The reference's CPU time over the model's, median of the rounds."""
    return statistics.median(above["cpu"]/below["cpu"] for above, below in zip(measured[REFERENCE], measured[model]))


def number(runs, name):
    """A count of the summary; the same in every run."""
    return runs[0]["summary"][name]


def memory(runs):
    """Peak memory [MB], median."""
    return statistics.median(one["summary"]["peak_memory"] for one in runs)/1.0e6


def difference(measured, model):
    """Largest from the reference, over the largest value of its kind, in all load steps."""
    return max(abs(one - other).max()/abs(other).max()
               for name, other in measured[REFERENCE][0]["answers"].items()
               for one in [measured[model][0]["answers"][name]])


def scene_words(scene):
    """A scene as a table names it."""
    words, _, mesh, steps = scene
    return f"{words}, {mesh[0]} + {mesh[1]} x {mesh[2]}, {' + '.join(str(count) for count in steps.values())} steps"


# --- tables ---

def cost_table(scenes, measured):
    """Title, heads and rows of the costs."""
    rows = []
    for scene, of_scene in zip(scenes, measured):
        for model, runs in of_scene.items():
            rows.append([scene_words(scene) if model == REFERENCE else "", model, f"{number(runs, 'unknowns'):,.0f}",
                         f"{cpu(runs):.2f}", f"{gain(of_scene, model):.1f}",
                         f"{number(runs, 'newton_iterations'):.0f}", f"{number(runs, 'factorizations'):.0f}",
                         f"{runs[0]['solves']:.0f}", f"{memory(runs):.0f}",
                         "" if model == REFERENCE else f"{difference(of_scene, model):.0e}"])
    heads = ["scene", "model", "unknowns", "CPU [s]", "ratio", "Newton iterations", "factorizations",
             "triangular solves", "memory [MB]", "difference"]
    return ("ratio: CPU time of full order and full width over the model's; difference: largest from that model in\n"
            "deflections, works and energies of all load steps, over the largest", heads, rows)


def part_table(scenes, measured):
    """Title, heads and rows of where the CPU time goes."""
    names = list(measured[0][REFERENCE][0]["parts"])
    rows = []
    for scene, of_scene in zip(scenes, measured):
        for model, runs in of_scene.items():
            rows.append([scene_words(scene) if model == REFERENCE else "", model] +
                        [f"{statistics.median(one['parts'][name] for one in runs):.2f}" for name in names])
    return ("where the CPU time goes [s]: shared out as the wall times of PETSc's log are",
            ["scene", "model", *names], rows)


def least_lines(scenes, measured):
    """What the cheapest model needs, a scene a line."""
    text = f"\n{LEAST}, factorizations a load step:"
    for scene, of_scene in zip(scenes, measured):
        steps = sum(scene[3].values())
        text += f"\n  {scene_words(scene)}: {number(of_scene[LEAST], 'factorizations')/steps:.2f}"
    return text + "\n"


# --- picture ---

def draw(scenes, measured, path):
    """Parts of the time of each model over the reference's; ratios on top."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(10.5, 4.6), layout="constrained")
    place, places, words = 0.0, [], []
    for scene, of_scene in zip(scenes, measured):
        whole = cpu(of_scene[REFERENCE])
        first = place
        for model, runs in of_scene.items():
            bottom = 0.0
            for colour, name in enumerate(runs[0]["parts"]):
                height = statistics.median(one["parts"][name] for one in runs)/whole
                axes.bar(place, height, bottom=bottom, color=f"C{colour}", width=0.8,
                         label=name if place == 0.0 else None)
                bottom += height
            said = f"{cpu(runs):.3g} s"
            if model != REFERENCE:
                said += f"\n1 / {gain(of_scene, model):.1f}"
            axes.annotate(said, (place, bottom), xytext=(0, 2), textcoords="offset points", ha="center", fontsize=8)
            places.append(place)
            words.append(model.replace(", ", "\n"))
            place += 1.0
        title = scene_words(scene).split(", ", 1)
        axes.annotate(f"{title[0]}\n{title[1]}", ((first + place - 1.0)/2.0, -0.21),
                      xycoords=("data", "axes fraction"), ha="center", fontsize=9)
        place += 0.6
    axes.set_xticks(places, words, fontsize=7)
    axes.set(ylabel="CPU time over that of full order and full width",
             title="strips with friction: CPU time of the process and its parts; ratio")
    axes.margins(x=0.01, y=0.28)  # room for the legend
    axes.grid(axis="y", alpha=0.3)
    axes.legend(fontsize=8, loc="upper center", ncols=6)
    figure.savefig(path, dpi=90)
