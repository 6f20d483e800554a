"""Stiffness and damping of a foil bearing: what a frequency costs, against one factorization of the static bearing.

The bearing of inputs/gu2020_bearing.nml under 100 N on the default meshes, aligned, all 4 x 4 coefficients; the whole
width is that of a shaft that tilts. A frequency's CPU time is what a run of more frequencies takes longer than one of
two, over their number; so the equilibrium and the search for the critical mass are not in it. The static
factorization, numbers only, is the mean of a few other loads', for a cold start has coarser meshes.
"""

import statistics
import sys
import tempfile

from gfb.bench.bearing import CASE, FACTORIZATION, SWEEP, calls, time_in
from gfb.run import run_case, run_logged
from gfb.tables import markdown_table, plain_table
from gfb.tool import stop

MODELS = {  # foil, half_width, frequencies beyond two
    "elastic foundation": ("elastic_foundation", "auto", 28),
    "beams": ("beam", "auto", 28),
    "shells, half width": ("shell", "auto", 8),
    "shells, whole width": ("shell", "no", 3),
}
TWO = (0.25, 0.5)  # over the speed
LOADS = (100.0, 110.0, 120.0)  # [N]
MANY = 30
AIMS = {"beams": 5.0, "shells, half width": 60.0}  # CPU time of so many frequencies [s]
MOST_FACTORIZATIONS = 6.0  # static ones a frequency, shells on half the width


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--repetitions", metavar="N", type=int, default=1,
                        help="runs of each model; default: %(default)s")
    parser.add_argument("--models", metavar="N", type=int, default=len(MODELS), choices=range(1, len(MODELS) + 1),
                        help="only the first N of the models")


def run(options):
    """Measures; returns the table and leaves it in Markdown."""
    if options.repetitions < 1:
        stop("--repetitions: at least 1")
    measured = {model: [] for model in list(MODELS)[:options.models]}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.repetitions):
            for model, runs in measured.items():
                print(f"{model} ...", file=sys.stderr, flush=True)
                runs.append(measure(options.gfb, model, folder))
    table = cost_table(measured)
    (options.output/"dynamics.md").write_text(markdown_table(*table), encoding="utf-8")
    return plain_table(*table) + notes(measured)


def groups_of(model, ratios):
    """The case file's groups; without ratios the equilibrium alone."""
    foil, half_width, _ = MODELS[model]
    groups = {**CASE, "model": {"foil": foil, "half_width": half_width}}
    if foil == "elastic_foundation":
        for name in ("top_foil", "bump_foil", "contact"):
            del groups[name]
        groups["model"] |= {"foundation_stiffness": 4.8e9, "foundation_pressure": "axial_mean"}
    if ratios:
        groups |= {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequency_ratios": ratios}}
    return groups


def measure(gfb, model, folder):
    """CPU time of a frequency and of a static factorization [s], memory [B], unknowns."""
    static = run_case(gfb, groups_of(model, ()), folder, "static")
    loads = {"sweep": {"parameter": "load", "values": LOADS}}
    swept, stages = run_logged(gfb, groups_of(model, ()) | loads, folder, "loads")
    share = swept.cpu/sum(time_in(stages, stage, ("summary",)) for stage in stages)
    factorization = share*time_in(stages, SWEEP, FACTORIZATION)/max(1.0, calls(stages, SWEEP, FACTORIZATION))
    more = MODELS[model][2]
    few = run_case(gfb, groups_of(model, TWO), folder, "few")
    many = run_case(gfb, groups_of(model, TWO + tuple(0.6 + 0.05*i for i in range(more))), folder, "many")
    return {"frequency": (many.cpu - few.cpu)/more, "factorization": factorization, "run": few.cpu,
            "static": static.cpu, "unknowns": static["unknowns"], "memory": many["peak_memory"],
            "static memory": static["peak_memory"]}


def median_of(runs, name):
    """Median over the runs."""
    return statistics.median(one[name] for one in runs)


def ratio(runs):
    """Static factorizations a frequency, median of the rounds."""
    return statistics.median(one["frequency"]/one["factorization"] for one in runs)


def cost_table(measured):
    """Title, heads and rows."""
    rows = [[model, f"{runs[0]['unknowns']:,.0f}", f"{median_of(runs, 'static'):.2f}",
             f"{1e3*median_of(runs, 'factorization'):.1f}", f"{median_of(runs, 'frequency'):.3f}", f"{ratio(runs):.1f}",
             f"{MANY*median_of(runs, 'frequency'):.1f}", f"{median_of(runs, 'static memory')/1e6:.0f}",
             f"{median_of(runs, 'memory')/1e6:.0f}"] for model, runs in measured.items()]
    heads = ["vibrations", "unknowns", "equilibrium, CPU [s]", "one factorization [ms]", "a frequency, CPU [s]",
             "factorizations", f"{MANY} frequencies, CPU [s]", "memory of the equilibrium [MB]", "with vibrations [MB]"]
    return ("CPU times; factorizations: a frequency over one of the static bearing", heads, rows)


def notes(measured):
    """The models against their aims."""
    lines = [f"{model}: {MANY*median_of(measured[model], 'frequency'):.1f} s for {MANY} frequencies (aim: {aim:g} s)\n"
             for model, aim in AIMS.items() if model in measured]
    if "shells, half width" in measured:
        lines.append(f"shells, half width: {ratio(measured['shells, half width']):.1f} static factorizations a frequency "
                     f"(aim: {MOST_FACTORIZATIONS:g})\n")
    return "\n" + "".join(lines)
