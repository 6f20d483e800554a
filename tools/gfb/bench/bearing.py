"""A foil bearing with friction: monolithic against partitioned, reduced against full order, half against full width,
shells against beams; other bearings with the same model: three pads, three strips side by side; derivatives by ten keys.

The bearing of inputs/gu2020_bearing.nml is solved from a cold start at the first load, then at the other loads of a
sweep, each point from its neighbour. Film, contacts and tolerances are the same in all models, the mesh is the
default one. Times are CPU times of whole processes, from the case file to the result files; the repetitions go
round all models, and a ratio is the median of the ratios inside the rounds: the model over the default one.
"""

import statistics
import sys
import tempfile

from gfb.bench.options import add_repetitions
from gfb.namelist import Groups
from gfb.results import read_history
from gfb.running import run_logged, start_time
from gfb.tables import markdown_table, plain_table
from gfb.tool import stop

CASE: Groups = {  # inputs/gu2020_bearing.nml
    "scene": {"analysis": "equilibrium"},
    "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
    "operation": {"speed_rpm": 30000.0, "load": (-100.0, 0.0)},
    "top_foil": {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing"},
    "bump_foil": {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "half_length": 1.778e-3,
                  "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 26, "fixed_edge": "trailing",
                  "fixed_line": "half_flat"},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
}
STEP = 5.0  # of the sweep [N]
DEFAULT = "shells, reduced, half width"
MODELS = {  # foil, reduction (beams have none), half_width, coupling
    DEFAULT: ("shell", "guyan", "yes", "monolithic"),
    "  partitioned": ("shell", "guyan", "yes", "partitioned"),
    "  full order": ("shell", "none", "yes", "monolithic"),
    "  full width": ("shell", "guyan", "no", "monolithic"),
    "  full order, full width": ("shell", "none", "no", "monolithic"),
    "beams": ("beam", None, "yes", "monolithic"),
    "  beams, partitioned": ("beam", None, "yes", "partitioned"),
}
OTHERS = {  # other bearings, with the default model: what is changed in the case; None takes a key away
    # under loads below the fold of its branch at 88 N
    "three pads, preload 0.3": {"operation": {"load": (-30.0, 0.0)}, "pads": {"count": 3, "arc": 2.0, "preload": 0.3,
                                "preload_offset": 0.5}, "bump_foil": {"bumps": 8, "pitch": None}},
    "three strips side by side": {"bump_foil": {"strips": 3, "cut_width": 0.5e-3}},
}
KEYS = ("top_foil%thickness", "bump_foil%thickness", "bump_foil%height", "bump_foil%half_length", "bearing%clearance",
        "contact%friction_top", "contact%friction_sleeve", "operation%load", "operation%speed_rpm", "gas%viscosity")
DERIVED = {"sensitivity": {"quantity": ("minimum_gap", "friction_torque"), "parameters": KEYS}}
WITH_DERIVATIVES = (DEFAULT, "beams", *OTHERS)
COLD_ONLY = "  full order, full width"  # no sweep: it would take as long as all others

# PETSc's log has wall times, which other jobs stretch; the process' CPU time is shared out as they are. An event's
# time has that of the events inside it: gfb's film and foil lie inside assembly, contact inside foil, and are taken
# off. What the partitioned loops add to a matrix lies outside assembly. Stages do not overlap. Cold start and sweep
# are two runs, the sweep's CPU time is what it has more: so a busy minute does not move time from one to the other.
COLD, SWEEP, SET_UP, OUTPUT = "Main Stage", "sweep", "set-up", "output"
BUILDING = (SET_UP, "condensation", "stiffness")
ASSEMBLY, FILM, FOIL, CONTACT = "gfb assembly", "gfb film", "gfb foil", "gfb contact"
SIDES = ("MatCreateSubMats", "MatMatMultSym", "MatMatMultNum", "MatAXPY")
FACTORIZATION, TRIANGULAR = ("PCSetUp",), ("PCApply",)  # by MUMPS or KLU, which has no events of its own
ASSEMBLED = ("film", "foil", "contact", "matrix")
AIMS = {"cold": 25, "point": 5}  # factorizations


def add_options(parser):
    """The command's own options."""
    add_repetitions(parser, "runs of each model", 1)
    parser.add_argument("--points", metavar="N", type=int, default=20, help="of the sweep; default: %(default)s")
    parser.add_argument("--models", metavar="N", type=int, default=len(MODELS) + len(OTHERS),
                        choices=range(1, len(MODELS) + len(OTHERS) + 1), help="only the first N of the models and other bearings")


def run(options):
    """Measures; returns the table and leaves it in Markdown and the picture."""
    if options.points < 2:
        stop("--points: at least 2")
    measured = {model: [] for model in [*MODELS, *OTHERS][:options.models]}
    with tempfile.TemporaryDirectory() as folder:
        start = start_time(options.gfb)
        for _ in range(options.repetitions):  # round all models, so that a slow minute hits all
            for model, runs in measured.items():
                print(f"{model.strip()} ...", file=sys.stderr, flush=True)
                runs.append(measure(options.gfb, model, options.points, folder))
    draw(measured, options.output/"bearing.png")
    tables = [cold_table(measured), sweep_table(measured), derivative_table(measured), part_table(measured)]
    (options.output/"bearing.md").write_text("\n".join(markdown_table(*table) for table in tables), encoding="utf-8")
    head = (f"bearing of [Gu2020] section 4.2, 100 N cold (three pads: 30 N), then {options.points - 1} points {STEP:g} N "
            f"apart; 30,000 rpm, one rank\nmedians of {options.repetitions} runs of each model; CPU: the whole "
            f"process; MPI's start alone ('gfb --version') takes {start:.2f} s\n")
    return head + "".join("\n" + plain_table(*table) for table in tables) + notes(measured)


# --- one run ---

def bearing_case(model, points):
    """The case file's groups."""
    foil, reduction, half_width, coupling = MODELS.get(model, MODELS[DEFAULT])
    changes = OTHERS.get(model, {})
    groups = {name: {**CASE.get(name, {}), **changes.get(name, {})} for name in {**CASE, **changes}}
    first = -groups["operation"]["load"][0]
    return {**{name: {key: value for key, value in keys.items() if value is not None} for name, keys in groups.items()},
            "model": {"foil": foil, **({"reduction": reduction} if reduction else {}), "half_width": half_width,
                      "coupling": coupling},
            "sweep": {"parameter": "load", "values": [first + STEP*point for point in range(points)]}}


def measure(gfb, model, points, folder):
    """What the cold start costs, what the sweep costs beyond it, and the answers."""
    cold, stages = run_model(gfb, model, 1, folder)
    first = {**solver_parts(stages, COLD), SET_UP: sum(time_in(stages, stage, ("summary",)) for stage in BUILDING),
             OUTPUT: time_in(stages, OUTPUT, ("summary",))}
    share = cold.cpu/sum(time_in(stages, stage, ("summary",)) for stage in stages)
    found = {"summary": cold.summary, "cpu": {"cold": cold.cpu, "sweep": 0.0}, "sweep": {},
             "cold": {name: share*value for name, value in first.items()}, "solves": calls(stages, COLD, TRIANGULAR),
             "factorization": share*time_in(stages, COLD, FACTORIZATION)/max(1.0, calls(stages, COLD, FACTORIZATION))}
    if cold.converged and model in WITH_DERIVATIVES:
        found["cpu"]["derivatives"] = run_model(gfb, model, 1, folder, DERIVED)[0].cpu - cold.cpu
    done = cold
    if cold.converged and model != COLD_ONLY:
        done, stages = run_model(gfb, model, points, folder)
        later = solver_parts(stages, SWEEP)
        found["cpu"]["sweep"] = done.cpu - cold.cpu
        share = found["cpu"]["sweep"]/max(1.0e-9, sum(later.values()))
        found["sweep"] = {name: share*value for name, value in later.items()}
    history = read_history(f"{done.stem}.h5")
    return {**found, "converged": done.converged, "history": history, "points": len(history["load"])}


def run_model(gfb, model, points, folder, more=()):
    """A run, perhaps with more groups in its case file, and PETSc's log of it."""
    done, stages = run_logged(gfb, bearing_case(model, points) | dict(more), folder, "bearing", may_stop=True)
    if ASSEMBLY not in stages.get(COLD, {}):
        stop("PETSc's log has no assembly in it: is it built without logging?", 3)
    return done, stages


def time_in(stages, stage, events):
    """Seconds of some events in a stage."""
    return sum(stages.get(stage, {}).get(event, (0.0, 0.0))[1] for event in events)


def calls(stages, stage, events):
    """How often some events came in a stage."""
    return sum(stages.get(stage, {}).get(event, (0.0, 0.0))[0] for event in events)


def solver_parts(stages, stage):
    """Seconds of a stage in parts that do not overlap."""
    assembly, film, foil, contact = (time_in(stages, stage, (event,)) for event in (ASSEMBLY, FILM, FOIL, CONTACT))
    parts = {"film": film, "foil": foil - contact, "contact": contact,
             "matrix": assembly - film - foil + time_in(stages, stage, SIDES),
             "factorization": time_in(stages, stage, FACTORIZATION),
             "triangular solves": time_in(stages, stage, TRIANGULAR)}
    return {**parts, "rest": time_in(stages, stage, ("summary",)) - sum(parts.values())}


# --- figures of several runs ---

def median_of(runs, value):
    """Median over the runs."""
    return statistics.median(value(one) for one in runs)


def ratio(measured, model, cost):
    """A cost of the model over the default model's, median of the rounds."""
    return statistics.median(cost(one)/cost(base) for one, base in zip(measured[model], measured[DEFAULT]))


def cold_cpu(one):
    """CPU time of the run without a sweep [s]."""
    return one["cpu"]["cold"]


def unknown_cpu(one):
    """The same an unknown [s]."""
    return cold_cpu(one)/one["summary"]["unknowns"]


def point_cpu(one):
    """CPU time of a point of the sweep [s]."""
    return one["cpu"]["sweep"]/max(1, one["points"] - 1)


def spent(one, name):
    """A count of each point; the first is the cold start's."""
    import numpy

    return numpy.diff(one["history"][name], prepend=0.0)


def difference(measured, model):
    """Largest of the position from the default model's, over the clearance, at the points both have."""
    one, base = measured[model][0]["history"], measured[DEFAULT][0]["history"]
    points = min(len(one["load"]), len(base["load"]))
    return max((abs(one[name][:points] - base[name][:points]).max() for name in ("eccentricity_x", "eccentricity_y")),
               default=0.0)/CASE["bearing"]["clearance"]


# --- tables ---

def cold_table(measured):
    """Title, heads and rows of the cold start."""
    rows = []
    for model, runs in measured.items():
        first, history = runs[0], runs[0]["history"]
        found = first["points"] > 0
        rows.append([model.strip(), "" if found else "no answer", f"{first['summary']['unknowns']:,.0f}",
                     f"{median_of(runs, cold_cpu):.2f}", f"{ratio(measured, model, cold_cpu):.2f}",
                     f"{ratio(measured, model, unknown_cpu):.2f}",
                     f"{(history['newton_iterations'][0] if found else first['summary']['newton_iterations']):.0f}",
                     f"{(history['factorizations'][0] if found else first['summary']['factorizations']):.0f}",
                     f"{first['solves']:.0f}", f"{1e3*median_of(runs, lambda one: one['factorization']):.0f}",
                     f"{median_of(runs, lambda one: one['summary']['peak_memory'])/1e6:.0f}",
                     f"{history['minimum_gap'][0]*1e6:.3f}" if found else "",
                     "" if model in (DEFAULT, *OTHERS) or not found else f"{difference(measured, model):.0e}"])
    heads = ["cold start", "", "unknowns", "CPU [s]", "ratio", "ratio an unknown", "Newton iterations", "factorizations",
             "triangular solves", "one factorization [ms]", "memory [MB]", "minimum gap [um]", "difference"]
    return ("CPU: of a run without a sweep; ratio: over the default model's; ratio an unknown: the same of the CPU time\n"
            "over unknowns; difference: largest from that model in the shaft's position at all points, over C",
            heads, rows)


def sweep_table(measured):
    """Title, heads and rows of the sweep's other points."""
    rows = []
    for model, runs in measured.items():
        first = runs[0]
        iterations, factors = spent(first, "newton_iterations")[1:], spent(first, "factorizations")[1:]
        if len(factors) == 0:
            rows.append([model.strip(), "not measured" if model == COLD_ONLY else "no answer"] + [""]*7)
            continue
        rows.append([model.strip(), "" if first["converged"] else "ends early", f"{len(factors)}",
                     f"{median_of(runs, point_cpu):.2f}", f"{ratio(measured, model, point_cpu):.2f}",
                     f"{iterations.mean():.1f}", f"{factors.mean():.1f}", f"{statistics.median(factors):g}",
                     f"{factors.max():.0f}"])
    heads = ["a point of the sweep", "", "points", "CPU [s]", "ratio", "Newton iterations, mean",
             "factorizations, mean", "median", "most"]
    return ("counts of a point of the sweep after the first", heads, rows)


def derivative_table(measured):
    """Title, heads and rows of derivatives by ten keys at the cold start's answer."""
    rows = []
    for model, runs in measured.items():
        if "derivatives" not in runs[0]["cpu"]:
            continue
        share = statistics.median(one["cpu"]["derivatives"]/one["cpu"]["cold"] for one in runs)
        rows.append([model.strip(), f"{len(KEYS)}", f"{median_of(runs, cold_cpu):.2f}",
                     f"{median_of(runs, lambda one: one['cpu']['derivatives']):.2f}", f"{100.0*share:.0f} %"])
    return ("what &sensitivity adds to the CPU time of the cold start; share: median of the rounds",
            ["derivatives", "keys", "cold start [s]", "derivatives [s]", "share"], rows)


def part_table(measured):
    """Title, heads and rows of where the CPU time goes."""
    rows, names = [], list(measured[DEFAULT][0]["cold"])
    for model, runs in measured.items():
        for what in ("cold", "sweep"):
            parts = {name: median_of(runs, lambda one, name=name: one[what].get(name, 0.0)) for name in names}
            whole = sum(parts.values())
            if whole <= 0.0:
                continue
            assembly = sum(parts[name] for name in ASSEMBLED)/whole
            rows.append([model.strip() if what == "cold" else "", "cold" if what == "cold" else "other points",
                         *(f"{parts[name]:.2f}" for name in names), f"{100.0*assembly:.0f} %"])
    heads = ["model", "", *names, "assembly"]
    return ("CPU time [s]; assembly: share of film, foil, contact and matrix", heads, rows)


def notes(measured):
    """The default model against its aims."""
    one = measured[DEFAULT][0]
    if one["points"] == 0:
        return "\nthe default model found no answer\n"
    factors = spent(one, "factorizations")
    within = sum(count <= AIMS["point"] for count in factors[1:])
    others = "".join(f"; {model}: {spent(measured[model][0], 'factorizations')[0]:.0f}" for model in OTHERS
                     if model in measured and measured[model][0]["points"] > 0)
    return (f"\n{DEFAULT}: {factors[0]:.0f} factorizations cold (aim: {AIMS['cold']}{others}); {within} of {len(factors) - 1} "
            f"points within {AIMS['point']} factorizations\n  of each point: "
            + " ".join(f"{count:.0f}" for count in factors[1:]) + "\n")


# --- picture ---

def draw(measured, path):
    """Parts of the CPU time of each model, for the cold start and a point of the sweep."""
    from matplotlib import pyplot

    names = list(measured[DEFAULT][0]["cold"])
    figure, panels = pyplot.subplots(1, 2, figsize=(11.0, 4.8), layout="constrained", sharey=True)
    words = [model.strip() for model in measured]
    for axes, what, title in zip(panels, ("cold", "sweep"), ("cold start and files", "a point of the sweep")):
        for place, runs in enumerate(measured.values()):
            left, points = 0.0, 1 if what == "cold" else max(1, runs[0]["points"] - 1)
            for colour, name in enumerate(names):
                width = median_of(runs, lambda one, name=name: one[what].get(name, 0.0))/points
                axes.barh(place, width, left=left, color=f"C{colour}", height=0.75, label=name if place == 0 else None)
                left += width
            factors = spent(runs[0], "factorizations")
            count = factors[:1] if what == "cold" else factors[1:]
            said = f" {left:.3g} s, {count.mean():.3g} factorizations" if len(count) else " not measured"
            axes.annotate(said, (left, place), va="center", fontsize=7.5)
        axes.set(xlabel="CPU time [s]", title=title)
        axes.autoscale(enable=True, axis="x")
        axes.set_xlim(0.0, 1.5*max(bar.get_x() + bar.get_width() for bar in axes.patches))
        axes.grid(axis="x", alpha=0.3)
    panels[0].set_yticks(range(len(words)), words, fontsize=8)
    panels[0].invert_yaxis()
    panels[1].legend(fontsize=8, loc="lower right")
    figure.savefig(path, dpi=90)
