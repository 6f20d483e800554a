"""Stiffness and damping of a foil bearing: what few and many frequencies cost, against factorizations one by one.

The bearing of inputs/gu2020_bearing.nml under 100 N on the default meshes, aligned, all 4 x 4 coefficients with the critical
mass, from 0.1 to 2 times the speed; the whole width is that of a shaft that tilts. Up to three frequencies are solved
one by one, more by a function through samples; six of 30 are checked against runs of three. CPU times and factorizations are
those of a run less those of the equilibrium alone.
"""

import statistics
import sys
import tempfile

import numpy

from gfb.bench.bearing import CASE
from gfb.bench.options import add_first, add_repetitions
from gfb.build import version_of
from gfb.results import open_results
from gfb.running import run_case
from gfb.tables import markdown_table, plain_table
from gfb.tool import MEASURED

DENSITY = {"density": 8200.0}  # of both foils [kg/m^3]
MODELS = {  # foil, half_width, with its mass
    "elastic foundation": ("elastic_foundation", "auto", False),
    "beams": ("beam", "auto", False),
    "beams with mass": ("beam", "auto", True),
    "shells, half width": ("shell", "auto", False),
    "shells with mass": ("shell", "auto", True),
    "shells, whole width": ("shell", "no", False),
}
ENDS = (0.1, 2.0)  # over the speed
NUMBERS = (3, 30, 300)
CHECKED = ((2, 7, 12), (17, 20, 26))  # places among 30
HEAD = """# What frequencies cost

```
tools/bench dynamics --docs --repetitions {repetitions}
```

The bearing of [inputs/gu2020_bearing.nml](../../inputs/gu2020_bearing.nml) under 100 N on the default meshes: all 4 x 4
coefficients at so many frequencies from 0.1 to 2 times the speed, and the critical mass. CPU times and factorizations are those of a run
less those of the equilibrium alone, with files. On half the width one is for translations and one for tilts. *off*: largest
difference of six of the 30 frequencies from factorizations at each, over the largest entry of like coordinates.

{table}
{program}.

"""


def add_options(parser):
    """The command's own options."""
    add_repetitions(parser, "runs of each model", 1)
    add_first(parser, "models", MODELS)
    parser.add_argument("--docs", action="store_true", help="write the table of docs/measured/bench_dynamics.md")


def run(options):
    """Measures; returns the table and leaves it in Markdown."""
    with tempfile.TemporaryDirectory() as folder:
        rows = [measure(options, model, folder) for model in list(MODELS)[:options.models]]
    heads = ["vibrations", "unknowns", "equilibrium, CPU [s]"]
    for number in NUMBERS:
        heads += [f"{number} frequencies, CPU [s]", "factorizations"]
    table = ("CPU times and factorizations beyond the equilibrium's", [*heads, "off", "memory [MB]"], rows)
    (options.output/"dynamics.md").write_text(markdown_table(*table), encoding="utf-8")
    if options.docs:
        write_page(table, options)
    return plain_table(*table)


def write_page(table, options):
    """The table into the page, whose words after it stay."""
    path = MEASURED/"bench_dynamics.md"
    words = path.read_text(encoding="utf-8").partition("<!-- words -->\n")[2]
    head = HEAD.format(repetitions=options.repetitions, table=markdown_table(*table), program=version_of(options.gfb))
    path.write_text(head + "<!-- words -->\n" + words, encoding="utf-8")


def groups_of(model, ratios):
    """The case file's groups; without ratios the equilibrium alone."""
    foil, half_width, mass = MODELS[model]
    groups = {**CASE, "model": {"foil": foil, "half_width": half_width}}
    if foil == "elastic_foundation":
        for name in ("top_foil", "bump_foil", "contact"):
            del groups[name]
        groups["model"] |= {"foundation_stiffness": 4.8e9, "foundation_pressure": "axial_mean"}
    if mass:
        groups |= {name: groups[name] | DENSITY for name in ("top_foil", "bump_foil")}
    if ratios:
        groups |= {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequency_ratios": ratios}}
        if mass:
            groups["foil_damping"] = {"foil_mass": "on"}
    return groups


def measure(options, model, folder):
    """A row of the table; times are medians."""
    print(f"{model} ...", file=sys.stderr, flush=True)
    rounds = []
    for _ in range(options.repetitions):
        rounds.append([run_case(options.gfb, groups_of(model, ()), folder, "static")])
        for number in NUMBERS:
            ratios = tuple(numpy.linspace(*ENDS, number).tolist())
            rounds[-1].append(run_case(options.gfb, groups_of(model, ratios), folder, f"of_{number}"))
    static, *runs = rounds[0]
    row = [model, f"{static['unknowns']:,.0f}", f"{statistics.median(one[0].cpu for one in rounds):.2f}"]
    for i, answer in enumerate(runs, 1):
        row += [f"{statistics.median(one[i].cpu - one[0].cpu for one in rounds):.2f}",
                f"{answer['factorizations'] - static['factorizations']:.0f}"]
    return [*row, f"{difference(options, model, folder):.0e}", f"{runs[1]['peak_memory']/1e6:.0f}"]


def difference(options, model, folder):
    """Largest difference of the checked frequencies from those that are solved one by one."""
    ratios = numpy.linspace(*ENDS, 30)
    many, largest = coefficients(folder, "of_30"), 0.0
    for places in CHECKED:
        run_case(options.gfb, groups_of(model, tuple(ratios[list(places)].tolist())), folder, "direct")
        for one, other in zip(coefficients(folder, "direct"), many[list(places)]):
            for part in (slice(0, 2), slice(2, 4)):
                largest = max(largest, abs(other[part, part] - one[part, part]).max()/abs(one[part, part]).max())
    return largest


def coefficients(folder, name):
    """K + i w C of a run, (frequencies, 4, 4)."""
    with open_results(f"{folder}/{name}.h5") as file:
        dynamics = file["dynamics"]
        return dynamics["stiffness"][:] + 1j*dynamics["frequency"][:][:, None, None]*dynamics["damping"][:]
