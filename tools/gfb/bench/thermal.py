"""A bearing with heat against the same one without: rigid, elastic foundation, beams and shells, from the case file to the files.

The bearing and the walls of inputs/thermal_bearing.nml under 60 N at 30,000 rpm on the default meshes: an answer without
&thermal, at ambient temperature, then one with it. The repetitions go round all models; a ratio is the median of the ratios
inside the rounds. The start of MPI is taken off both times, as 'gfb --version' takes it.
"""

import re
import statistics
import sys
import tempfile

from gfb.bench.bearing import CASE
from gfb.bench.options import add_first, add_repetitions
from gfb.build import version_of
from gfb.running import run_file, start_time, write_case
from gfb.tables import markdown_table, plain_table
from gfb.tool import MEASURED, stop

AMBIENT = 293.15  # [K]
HEAT = {"ambient_temperature": AMBIENT, "shaft_conductance": 0.3, "sleeve_conductance": 1.0, "bump_conductance": 190.0,
        "shaft_expansion": 1.2e-5, "sleeve_expansion": 1.2e-5, "shaft_density": 7850.0, "shaft_youngs_modulus": 2.1e11,
        "shaft_poissons_ratio": 0.3}
MODELS = {  # foil, and the most that heat may cost over the time without
    "rigid": ("rigid", 2.5), "elastic foundation": ("elastic_foundation", 2.5), "beams": ("beam", 1.5), "shells": ("shell", 1.5)}
ITERATIONS, FACTORIZATIONS = 6, 2  # aims: after the isothermal answer; more of them on the finest mesh
HEAD = """# What heat costs

```
tools/bench thermal --docs --repetitions {repetitions}
```

The bearing and the walls of [inputs/thermal_bearing.nml](../../inputs/thermal_bearing.nml), 60 N at 30,000 rpm, on the default
meshes, on one rank; *without* is the same case without `&thermal`, at ambient temperature. Times are CPU times of whole runs less the
start of MPI, medians of the rounds; *ratio* is the median of the ratios inside the rounds, which other work on the machine moves
least. *Iterations* are Newton's after the isothermal answer that a run with heat begins with, on all meshes from there on; of them
*on the finest* those of the finest mesh, to which the aim is held. *Factors* are factorizations of the finest mesh. Aims: {iterations}
iterations, {factorizations} factorizations more, 2.5 times the time for rigid and foundation, 1.5 times for beams and shells.

{table}
{missed}
{program}.

"""


def add_options(parser):
    """The command's own options."""
    add_repetitions(parser, "rounds of all models", 3)
    add_first(parser, "models", MODELS)
    parser.add_argument("--docs", action="store_true", help="write the table of docs/measured/bench_thermal.md")


def run(options):
    """Measures; returns the table and leaves it in Markdown."""
    models = list(MODELS)[:options.models]
    rounds = {model: [] for model in models}
    with tempfile.TemporaryDirectory() as folder:
        start = start_time(options.gfb)
        for _ in range(options.repetitions):
            for model in models:
                print(f"{model} ...", file=sys.stderr, flush=True)
                rounds[model].append(measure(options.gfb, model, folder))
    table = table_of(rounds, start)
    missed = "".join(f"- {words}\n" for words in missed_aims(rounds, start))
    (options.output/"thermal.md").write_text(markdown_table(*table) + missed, encoding="utf-8")
    if options.docs:
        write_page(options, table, missed)
    return plain_table(*table) + missed


def write_page(options, table, missed):
    """The table into the page, whose words after it stay."""
    path = MEASURED/"bench_thermal.md"
    words = path.read_text(encoding="utf-8").partition("<!-- words -->\n")[2] if path.exists() else ""
    head = HEAD.format(repetitions=options.repetitions, table=markdown_table(*table), program=version_of(options.gfb),
                       iterations=ITERATIONS, factorizations=FACTORIZATIONS,
                       missed=f"Missed:\n\n{missed}" if missed else "All aims are met.\n")
    path.write_text(head + "<!-- words -->\n" + words, encoding="utf-8")


def groups_of(model, heated):
    """The case file's groups."""
    foil, _ = MODELS[model]
    groups = {**CASE, "operation": {"speed_rpm": 30000.0, "load": (-60.0, 0.0)}, "model": {"foil": foil},
              "gas": {"viscosity_law": "sutherland", "temperature": AMBIENT, "ambient_pressure": 1.0135e5}}
    if foil == "elastic_foundation":
        groups["model"] = groups["model"] | {"foundation_pressure": "axial_mean"}
    if foil in ("rigid", "elastic_foundation"):
        del groups["contact"]
    if heated:
        groups["thermal"] = HEAT
    return groups


def measure(gfb, model, folder):
    """Both answers, the one without heat first."""
    found = []
    for heated in (False, True):
        path = write_case(folder, "heated" if heated else "cold", groups_of(model, heated))
        answer = run_file(gfb, path, folder, options=("--verbose",))
        if answer.status != 0:
            stop(f"{model}: gfb ended with status {answer.status}:\n{answer.log}{answer.complaint}", 3)
        found.append(answer)
    return found


def iterations_of_heat(log):
    """Newton's iterations between the line that heat begins and the answer, of a log with all of them: all, and on the last mesh."""
    begun = log.rpartition("\nheat\n")[2].partition("\nanswer\n")[0]
    meshes = re.split(r"^film \d+ x \d+$", begun, flags=re.MULTILINE)
    counts = [len(re.findall(r"^ +[1-9]\d* +[-+.\dE]+ +[-+.\dE]+ +[.\d]+ +\w+ *$", part, re.MULTILINE)) for part in meshes]
    return sum(counts), counts[-1]


def ratio(rounds, start):
    """Time with heat over the time without."""
    return statistics.median((heated.cpu - start)/(cold.cpu - start) for cold, heated in rounds)


def more_on_finest(rounds):
    """Factorizations of the finest mesh that heat adds."""
    cold, heated = rounds[0]
    return heated["factorizations_finest"] - cold["factorizations_finest"]


def table_of(measured, start):
    """Title, heads and rows."""
    rows = []
    for model, rounds in measured.items():
        cold, heated = rounds[0]
        times = [statistics.median(one[i].cpu - start for one in rounds) for i in (0, 1)]
        rows.append([model, *(f"{answer['unknowns']:,.0f}" for answer in (cold, heated)), *(f"{time:.2f}" for time in times),
                     f"{ratio(rounds, start):.2f}", *map(str, iterations_of_heat(heated.log)),
                     *(f"{answer['factorizations_finest']:.0f}" for answer in (cold, heated)),
                     f"{heated['shaft_temperature'] - AMBIENT:.1f}"])
    heads = ["bearing", "unknowns, without", "with heat", "CPU, without [s]", "with heat [s]", "ratio", "iterations", "on the finest",
             "factors, without", "with heat", "shaft warmer by [K]"]
    return "CPU times beyond the start of MPI", heads, rows


def missed_aims(measured, start):
    """A sentence for every aim that is missed."""
    for model, rounds in measured.items():
        aim = MODELS[model][1]
        if ratio(rounds, start) > aim:
            yield f"{model}: {ratio(rounds, start):.2f} times the time without heat; the aim is {aim:g}"
        finest = iterations_of_heat(rounds[0][1].log)[1]
        if finest > ITERATIONS:
            yield f"{model}: {finest} iterations with heat on the finest mesh; the aim is {ITERATIONS}"
        if more_on_finest(rounds) > FACTORIZATIONS:
            yield f"{model}: {more_on_finest(rounds):.0f} factorizations more on the finest mesh; the aim is {FACTORIZATIONS}"
