"""Rigid film of the [Gu2020] bearing: time against error, and where the time goes.

Eccentricity ratio 0.9 along x, 30,000 rpm, slit. First each mesh of a sequence is solved from nothing,
over half and over the whole width, with bilinear elements and with biquadratic ones on as many nodes; the
error is that of the force W = |(F_x, F_y)| against a biquadratic mesh finer than all of them. The cheapest
mesh of each order is named for errors of 1e-2 to 1e-5. Then a 416 x 120 film of bilinear elements is solved
under PETSc's trace, which shows the time of each part.
"""

import collections
import math
import pathlib
import re
import statistics
import tempfile

from gfb.bench.options import add_repetitions
from gfb.namelist import Groups
from gfb.running import run_case, start_time
from gfb.tool import stop

BILINEAR, BIQUADRATIC = 1, 2
ORDERS = {BILINEAR: "bilinear", BIQUADRATIC: "biquadratic"}
# Intervals between nodes, around and over the width.
COMMON = ((26, 8), (52, 16), (104, 32), (208, 64), (416, 128))
NODES = {"half": (*COMMON, (832, 256)), "whole": COMMON}
REFERENCE = (BIQUADRATIC, "half", (416, 128))  # elements
BEFORE = (BIQUADRATIC, "half", (208, 64))      # what the reference's own error is judged by
TARGETS = (1.0e-2, 3.0e-3, 1.0e-3, 3.0e-4, 1.0e-4, 1.0e-5)
PROFILED = (416, 120)
WIDTHS = {"half": "yes", "whole": "no"}
CLEARANCE = 31.8e-6
CASE: Groups = {
    "scene": {"analysis": "fixed_position"},
    "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": CLEARANCE},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
    "operation": {"speed_rpm": 30000.0, "eccentricity": (0.9*CLEARANCE, 0.0)},
    "model": {"foil": "rigid"},
    "output": {"fields": "none"},
}

# PETSc's events of each part.
RESIDUAL, JACOBIAN = "SNESFunctionEval", "SNESJacobianEval"
FACTORIZATION, TRIANGULAR = "PCSetUp", "PCApply"  # by KLU, which has no events of its own, or MUMPS
SOLVE = "SNESSolve"
TRACE_LINE = re.compile(r"\[\d+\]\s+(\S+) Event (begin|end): (\S+)")


def add_options(parser):
    """The command's own options."""
    add_repetitions(parser, "runs of each case", 7)


def run(options):
    """Measures; returns the table and leaves the picture."""
    with tempfile.TemporaryDirectory() as folder:
        start = start_time(options.gfb, options.repetitions)
        meshes = measure_meshes(options, folder)
        profiles = {width: [profile(options.gfb, folder, width) for _ in range(options.repetitions)]
                    for width in WIDTHS}
    draw(meshes, start, options.output/"film.png")
    return mesh_table(meshes, start, options.repetitions) + profile_table(profiles)


# --- time against error ---

def film_case(mesh, width, order=BILINEAR):
    """The case on a mesh given as elements around and over the whole width."""
    groups = {group: dict(keys) for group, keys in CASE.items()}
    groups["model"] |= {"half_width": WIDTHS[width], "film_order": order}
    groups["mesh"] = {"circumferential_elements": mesh[0], "axial_elements": mesh[1]}
    return groups


def measure_meshes(options, folder):
    """{(order, width, mesh): runs}; the repetitions go round all cases, so that a slow minute hits all."""
    runs = {(order, width, mesh): [] for order in ORDERS for width in WIDTHS for mesh in meshes_of(order, width)}
    for turn in range(options.repetitions):
        for case, done in runs.items():
            if case == REFERENCE and turn > 0:
                continue
            order, width, mesh = case
            done.append(run_case(options.gfb, film_case(mesh, width, order), folder, "film"))
    return runs


def meshes_of(order, width):
    """Elements around and over the whole width."""
    return [(around//order, along//order) for around, along in NODES[width]]


def force(runs):
    """W of a case [N]."""
    return math.hypot(runs[0].summary["force_x"], runs[0].summary["force_y"])


def force_errors(meshes):
    """{case: relative error of W}."""
    exact = force(meshes[REFERENCE])
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
            f"error of W against {force(meshes[REFERENCE]):.6f} N from {REFERENCE[2][0]} x {REFERENCE[2][1]} biquadratic "
            f"elements; {BEFORE[2][0]} x {BEFORE[2][1]} differ by {errors[BEFORE]:.1e}\n\n"
            "elements     width  mesh        unknowns  Newton factor-   solve [s]     CPU [s]        error     order\n"
            "                                          steps izations\n")
    for order, name in ORDERS.items():
        for width in WIDTHS:
            before = None
            for case, runs in sorted(meshes.items()):
                if case[:2] != (order, width) or case == REFERENCE:
                    continue
                summary, error = runs[0].summary, errors[case]
                rate = "" if before is None else f"{math.log2(before/error):6.2f}"
                before = error
                text += (f"{name:11}  {width:5}  {case[2][0]:4} x {case[2][1]:<4} {summary['unknowns']:8.0f} "
                         f"{summary['newton_iterations']:6.0f} {summary['factorizations']:8.0f}    "
                         f"{smallest_and_median([one.summary['wall_time'] for one in runs], '6.3f')} "
                         f"{smallest_and_median([one.cpu for one in runs], '6.3f')}  {error:9.2e} {rate}".rstrip() + "\n")
    return text + target_table(meshes, errors, start)


def cost(runs, start):
    """Smallest CPU time of a case, less that of the program's start alone [s]."""
    return max(min(one.cpu for one in runs) - start, 1.0e-3)


def target_table(meshes, errors, start):
    """The cheapest mesh of each order that reaches an error."""
    text = ("\nthe cheapest mesh for an error of W: elements, smallest CPU time less the start's [s]\n"
            "width  error       " + "".join(f"{name:28}" for name in ORDERS.values()) + "ratio\n")
    for width in WIDTHS:
        for target in TARGETS:
            found = [cheapest(meshes, errors, start, (order, width), target) for order in ORDERS]
            words = "".join(f"{'none of these' if one is None else f'{one[1][0]:4} x {one[1][1]:<4} {one[0]:8.3f}':28}"
                            for one in found)
            ratio = "" if None in found else f"{found[0][0]/found[1][0]:5.1f}"
            text += f"{width:5}  {target:7.0e}     {words}{ratio}".rstrip() + "\n"
    return text


def cheapest(meshes, errors, start, kind, target):
    """Cost and mesh; None where no mesh is fine enough."""
    good = [(cost(runs, start), case[2]) for case, runs in meshes.items()
            if case[:2] == kind and case != REFERENCE and errors[case] <= target]
    return min(good, default=None)


def draw(meshes, start, path):
    """Error against CPU time."""
    from matplotlib import pyplot

    errors = force_errors(meshes)
    figure, axes = pyplot.subplots(figsize=(6.4, 4.4), layout="constrained")
    for order, name in ORDERS.items():
        for width, style in zip(WIDTHS, ("o-", "s--")):
            cases = [(order, width, mesh) for mesh in meshes_of(order, width) if (order, width, mesh) != REFERENCE]
            times = [cost(meshes[case], start) for case in cases]
            axes.loglog(times, [errors[case] for case in cases], style, color=f"C{order - 1}", markersize=4,
                        label=f"{name} elements, {width} width")
            if width == "whole":
                for case, moment in zip(cases, times):
                    axes.annotate(f"{case[2][0]} x {case[2][1]}", (moment, errors[case]), xytext=(5, 4),
                                  textcoords="offset points", fontsize=7)
    axes.set(xlabel="CPU time less the program's start [s]", ylabel="relative error of the film force W",
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
    if not solves or not any(name == FACTORIZATION for name, _, _ in events):
        stop("PETSc's trace has no solve in it: is it built without logging?", 3)

    def spans(name, first=0.0):
        return [end - begin for event, begin, end in events if event == name and begin >= first]

    parts = {"residuals": sum(spans(RESIDUAL)), "Jacobians": sum(spans(JACOBIAN)),
             "factorizations": sum(spans(FACTORIZATION)), "triangular solves": sum(spans(TRIANGULAR)),
             "set-up of all meshes": min(begin for begin, _ in solves)}
    whole = done.summary["wall_time"]
    parts["rest"] = whole - sum(parts.values())
    finest = max(begin for begin, _ in solves)
    factorization = statistics.mean(spans(FACTORIZATION, finest))
    residual = statistics.mean(spans(RESIDUAL, finest))
    # Where the factors are kept the Jacobian's callback does nothing; those calls are no evaluations.
    jacobian = statistics.mean(sorted(spans(JACOBIAN, finest))[-len(spans(FACTORIZATION, finest)):])
    assembly = parts["residuals"] + parts["Jacobians"]
    ratios = {
        "whole solve / one factorization (finest mesh)": whole/factorization,
        "all assembly / all factorizations": assembly/parts["factorizations"],
        "one residual + one Jacobian / one factorization": (residual + jacobian)/factorization,
    }
    finest_parts = {"one residual": residual, "one Jacobian": jacobian, "one factorization": factorization}
    return {"whole": whole, "parts": parts, "finest": finest_parts, "ratios": ratios}


AIMS = {"whole solve / one factorization (finest mesh)": "aim: at most 8", "all assembly / all factorizations": "aim: below 1"}


def profile_table(profiles):
    """Parts and ratios, smallest and median."""
    text = (f"\nwhere the time goes: {PROFILED[0]} x {PROFILED[1]} bilinear elements, coarse meshes of its start included; "
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
