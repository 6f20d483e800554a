"""Rigid film of the [Gu2020] bearing: time against error, and where the time goes.

Eccentricity ratio 0.9 along x, 30,000 rpm, slit. First each mesh of a sequence is solved from nothing,
over half and over the whole width; the error is that of the force W = |(F_x, F_y)| against Richardson's
extrapolation from the two finest meshes, the reference among them. Then a 416 x 120 film is solved under
PETSc's trace, which tells the time of each part.
"""

import collections
import math
import pathlib
import re
import statistics
import tempfile

from gfb_tools import run_case, stop, time_command

MESHES = ((26, 8), (52, 16), (104, 32), (208, 64), (416, 128))
REFERENCE = (832, 256)
PROFILED = (416, 120)
ORDER = 2.0  # of the force with bilinear elements
WIDTHS = {"half": "yes", "whole": "no"}
CLEARANCE = 31.8e-6
CASE = {
    "scene": {"analysis": "fixed_position"},
    "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": CLEARANCE},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
    "operation": {"speed_rpm": 30000.0, "eccentricity": (0.9*CLEARANCE, 0.0)},
    "model": {"foil": "rigid"},
    "output": {"fields": "none"},
}

# PETSc's events of each part.
RESIDUAL, JACOBIAN = "SNESFunctionEval", "SNESJacobianEval"
SYMBOLIC, NUMERIC, TRIANGULAR = "MatLUFactorSym", "MatLUFactorNum", "MatSolve"
SOLVE = "SNESSolve"
TRACE_LINE = re.compile(r"\[\d+\]\s+(\S+) Event (begin|end): (\S+)")


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--repetitions", metavar="N", type=int, default=7,
                        help="runs of each case; default: %(default)s")


def run(options):
    """Measures; returns the table and leaves the picture."""
    if options.repetitions < 1:
        stop("--repetitions: at least 1")
    with tempfile.TemporaryDirectory() as folder:
        start = min(time_command([options.gfb, "--version"])[1] for _ in range(options.repetitions))
        meshes = measure_meshes(options, folder)
        profiles = {width: [profile(options.gfb, folder, width) for _ in range(options.repetitions)]
                    for width in WIDTHS}
    draw(meshes, options.output/"film.png")
    return mesh_table(meshes, start, options.repetitions) + profile_table(profiles)


# --- time against error ---

def film_case(mesh, width):
    """The case on a mesh given as elements around and over the whole width."""
    groups = {group: dict(keys) for group, keys in CASE.items()}
    groups["model"]["half_width"] = WIDTHS[width]
    groups["mesh"] = {"circumferential_elements": mesh[0], "axial_elements": mesh[1]}
    return groups


def measure_meshes(options, folder):
    """{(width, mesh): runs}; the repetitions go round all cases, so that a slow minute hits all."""
    cases = [(width, mesh) for width in WIDTHS for mesh in MESHES]
    runs = {case: [] for case in [("half", REFERENCE), *cases]}
    runs["half", REFERENCE].append(run_case(options.gfb, film_case(REFERENCE, "half"), folder, "film"))
    for _ in range(options.repetitions):
        for width, mesh in cases:
            runs[width, mesh].append(run_case(options.gfb, film_case(mesh, width), folder, "film"))
    return runs


def force(runs):
    """W of a case [N]."""
    return math.hypot(runs[0].summary["force_x"], runs[0].summary["force_y"])


def extrapolated_force(meshes):
    """Richardson's value from the reference and the mesh before it [N]."""
    fine, coarse = force(meshes["half", REFERENCE]), force(meshes["half", MESHES[-1]])
    ratio = (REFERENCE[0]/MESHES[-1][0])**ORDER
    return fine + (fine - coarse)/(ratio - 1.0)


def force_errors(meshes):
    """{case: relative error of W}."""
    exact = extrapolated_force(meshes)
    return {case: abs(force(runs)/exact - 1.0) for case, runs in meshes.items()}


def smallest_and_median(values, form):
    """Both, as text."""
    return f"{format(min(values), form)} {format(statistics.median(values), form)}"


def mesh_table(meshes, start, repetitions):
    """Work, time and error of each mesh."""
    errors = force_errors(meshes)
    text = (f"rigid film, [Gu2020] bearing, eccentricity ratio 0.9, 30,000 rpm, one rank, {repetitions} runs of "
            "each (reference: 1)\n"
            "time: smallest and median; solve: start to answer; CPU: the whole process, files and MPI's start "
            f"too,\n      which alone ('gfb --version') takes {start:.3f} s\n"
            f"error of W against Richardson's value {extrapolated_force(meshes):.6f} N from {MESHES[-1][0]} x "
            f"{MESHES[-1][1]} and {REFERENCE[0]} x {REFERENCE[1]}\n\n"
            "width  mesh        unknowns  Newton factor-   solve [s]     CPU [s]        error     order\n"
            "                             steps izations\n")
    for width in WIDTHS:
        before = None
        for mesh in (*MESHES, REFERENCE):
            if (width, mesh) not in meshes:
                continue
            runs = meshes[width, mesh]
            summary, error = runs[0].summary, errors[width, mesh]
            order = "" if before is None else f"{math.log2(before/error):6.2f}"
            before = error
            text += (f"{width:5}  {mesh[0]:4} x {mesh[1]:<4} {summary['unknowns']:8.0f} "
                     f"{summary['newton_iterations']:6.0f} {summary['factorizations']:8.0f}    "
                     f"{smallest_and_median([one.summary['wall_time'] for one in runs], '6.3f')} "
                     f"{smallest_and_median([one.cpu for one in runs], '6.3f')}  {error:9.2e} {order}".rstrip() + "\n")
    return text + "(the order of the two meshes behind Richardson's value is 2 by construction)\n"


def draw(meshes, path):
    """Error against time."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    errors = force_errors(meshes)
    figure, axes = pyplot.subplots(figsize=(6.4, 4.4), layout="constrained")
    for width, colour in zip(WIDTHS, ("C0", "C1")):
        error = [errors[width, mesh] for mesh in MESHES]
        for style, words, times in (
                ("o-", "CPU time of the process", [min(one.cpu for one in meshes[width, mesh]) for mesh in MESHES]),
                ("s--", "wall time, start to answer",
                 [min(one.summary["wall_time"] for one in meshes[width, mesh]) for mesh in MESHES])):
            axes.loglog(times, error, style, color=colour, markersize=4, label=f"{width} width, {words}")
    for mesh in MESHES:
        axes.annotate(f"{mesh[0]} x {mesh[1]}",
                      (min(one.cpu for one in meshes["whole", mesh]), errors["whole", mesh]),
                      xytext=(5, 4), textcoords="offset points", fontsize=8)
    axes.set(xlabel="time [s]", ylabel="relative error of the film force W",
             title="rigid film, eccentricity ratio 0.9, smallest of several runs")
    axes.margins(x=0.2)
    axes.grid(which="both", alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(path, dpi=120)


# --- where the time goes ---

def read_trace(path):
    """PETSc's trace as (event, begin, end) in the order of their ends [s]."""
    begun, events = collections.defaultdict(list), []
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        found = TRACE_LINE.search(line)
        if found is None:
            continue
        moment, kind, name = float(found[1]), found[2], found[3]
        if kind == "begin":
            begun[name].append(moment)
        elif begun[name]:
            events.append((name, begun[name].pop(), moment))
    return events


def profile(gfb, folder, width):
    """Seconds of each part of one run, and of single operations on the finest mesh."""
    stem = pathlib.Path(folder)/"trace"
    done = run_case(gfb, film_case(PROFILED, width), folder, "profile", petsc=("-log_trace", str(stem)))
    events = read_trace(f"{stem}.0")
    solves = [(begin, end) for name, begin, end in events if name == SOLVE]
    if not solves or not any(name == NUMERIC for name, _, _ in events):
        stop("PETSc's trace has no solve in it: is it built without logging?", 3)

    def spans(name, first=0.0):
        return [end - begin for event, begin, end in events if event == name and begin >= first]

    parts = {"residuals": sum(spans(RESIDUAL)), "Jacobians": sum(spans(JACOBIAN)),
             "symbolic factorizations": sum(spans(SYMBOLIC)), "numeric factorizations": sum(spans(NUMERIC)),
             "triangular solves": sum(spans(TRIANGULAR)),
             "set-up of all meshes": min(begin for begin, _ in solves)}
    whole = done.summary["wall_time"]
    parts["rest"] = whole - sum(parts.values())
    finest = max(begin for begin, _ in solves)
    symbolic, numeric = spans(SYMBOLIC, finest)[0], statistics.mean(spans(NUMERIC, finest))
    residual = statistics.mean(spans(RESIDUAL, finest))
    # Where the factors are kept the Jacobian's callback does nothing; those calls are no evaluations.
    jacobian = statistics.mean(sorted(spans(JACOBIAN, finest))[-len(spans(NUMERIC, finest)):])
    assembly = parts["residuals"] + parts["Jacobians"]
    ratios = {
        "whole solve / one numeric factorization (finest mesh)": whole/numeric,
        "whole solve / one symbolic + numeric factorization": whole/(symbolic + numeric),
        "all assembly / all numeric factorizations": assembly/parts["numeric factorizations"],
        "all assembly / all symbolic + numeric factorizations":
            assembly/(parts["symbolic factorizations"] + parts["numeric factorizations"]),
        "one residual + one Jacobian / one numeric factorization": (residual + jacobian)/numeric,
    }
    finest_parts = {"one residual": residual, "one Jacobian": jacobian,
                    "one symbolic factorization": symbolic, "one numeric factorization": numeric}
    return {"whole": whole, "parts": parts, "finest": finest_parts, "ratios": ratios}


AIMS = {"whole solve / one symbolic + numeric factorization": "aim: at most 8",
        "all assembly / all symbolic + numeric factorizations": "aim: below 1",
        "whole solve / one numeric factorization (finest mesh)": "aim: at most 8, the stricter reading",
        "all assembly / all numeric factorizations": "aim: below 1, the stricter reading"}


def profile_table(profiles):
    """Parts and ratios, smallest and median."""
    text = (f"\nwhere the time goes: {PROFILED[0]} x {PROFILED[1]} film, coarse meshes of its start included; "
            "ratios within one run\n")
    for width, runs in profiles.items():
        text += f"\n{width} width [ms]{'':39}smallest   median\n"
        rows = [("whole solve, start to answer", [one["whole"] for one in runs])]
        rows += [(f"  {name}", [one["parts"][name] for one in runs]) for name in runs[0]["parts"]]
        rows += [(f"{name}, finest mesh", [one["finest"][name] for one in runs]) for name in runs[0]["finest"]]
        for name, values in rows:
            text += f"  {name:50}{1e3*min(values):9.2f}{1e3*statistics.median(values):9.2f}\n"
        text += "  ratio\n"
        for name in runs[0]["ratios"]:
            values = [one["ratios"][name] for one in runs]
            text += f"  {name:59}{min(values):6.2f}{statistics.median(values):8.2f}   {AIMS.get(name, '')}".rstrip() + "\n"
    return text
