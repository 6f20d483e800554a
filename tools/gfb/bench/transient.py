"""A turn of the shaft over time on each foil model: CPU time, steps, Newton iterations and factorizations, beside one static solve.

The bearing of inputs/gu2020_bearing.nml, 200 steps a turn, half the width, one rank, under a small and a larger unbalance. CPU
times are those of whole processes: what a run over time takes more than the static solve from which it begins, over its turns (two
minutes).
"""

import pathlib
import tempfile

from gfb.bench.bearing import CASE
from gfb.bench.options import add_first
from gfb.results import open_results
from gfb.running import run_case
from gfb.tables import markdown_table, plain_table

PAGE = pathlib.Path(__file__).resolve().parents[3]/"docs/measured/transient.md"
STEPS = 200  # a turn
MASS = 1.0   # [kg]
SPRINGS = {"foil": "elastic_foundation", "foundation_stiffness": 4.8243e9, "foundation_pressure": "axial_mean"}
MODELS = {  # groups of the model, turns, aim of a turn [s]
    "foundation, 240 x 32": ({"model": SPRINGS, "mesh": {"circumferential_elements": 240, "axial_elements": 32}}, 2, 3.0),
    "beams": ({"model": {"foil": "beam"}}, 2, 2.0),
    "shells": ({"model": {"foil": "shell"}}, 1, 30.0),
}
FOILS = ("top_foil", "bump_foil", "contact")  # which springs do without
UNBALANCES = {"small": 2.0e-7, "larger": 4.0e-6}  # [kg m]
HEAD = """# What a turn over time costs

Written by `tools/bench transient --docs`.

The bearing of [inputs/gu2020_bearing.nml](../../inputs/gu2020_bearing.nml) with a shaft of {mass:g} kg at 30,000 rpm under 100 N, {steps} steps a turn
(`steps_per_turn`), from its equilibrium on; half the width, one rank. *a turn*: CPU time of the run less that of the static solve, over the turns;
*over static*: that over the CPU time of the static solve from a cold start, files and all, in the same round. *orbit*: extent of the
shaft's motion in x in the last turn, over the clearance. Times depend on the machine, counts do not.

{table}
A step is Newton's method for film, foils and shaft together, with the factors of steps before as long as they serve, and with
what the steps since then have taught of the matrix
([method.md](../manual/method.md#finding-a-state)). Where contacts open, close, or go from sticking to slipping and back, the matrix is
factored anew, once or twice each time: that is most of the time with foils. When stiffness and damping coefficients do in
place of all this: [transient.md](../manual/transient.md#when-the-linear-theory-suffices).

Tried and left: earlier factors as preconditioner of GMRES for matrices that are filled later, as strips have it, with new ones when they are cheaper
by counts. On shells a factorization costs as much as 13 solutions with it. A quarter turn with 4 g mm, factorizations and solutions: 117 and
351 as it is; 71 and 1,495 to 1e-3 of the residual, 80 and 2,079 to 1e-2, 60 and 1,584 to 1e-1: CPU time 1.2 to 1.7 times, for every
Newton step behind a contact that has changed pays three or four solutions instead of one until the next factorization. Beams 1.2 to 1.3 times. A cold
start on shells: 15 factorizations instead of 37, 314 solutions instead of 52, 1.2 times the time.
"""


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--turns", metavar="N", type=int, help="of every run; default: two, shells one")
    add_first(parser, "models", MODELS)
    parser.add_argument("--docs", action="store_true", help="write docs/measured/transient.md")


def run(options):
    """Measures; returns the table, and writes the page where that is asked for."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for model in list(MODELS)[:options.models]:
            rows += measure(options, model, folder)
    heads = ["model", "unbalance [g mm]", "orbit", "static [s]", "a turn [s]", "aim [s]", "over static", "steps a turn",
             "Newton iterations a step", "steps a factorization"]
    table = ("CPU time of a turn over time", heads, rows)
    if options.docs:
        PAGE.write_text(HEAD.format(mass=MASS, steps=STEPS, table=markdown_table(*table)), encoding="utf-8")
    return plain_table(*table)


def measure(options, model, folder):
    """The rows of a model."""
    groups, turns, aim = MODELS[model]
    base = {name: keys for name, keys in CASE.items() if groups["model"] is not SPRINGS or name not in FOILS}
    groups, turns = {**base, **groups, "output": {"fields": "none"}}, options.turns or turns
    static = run_case(options.gfb, groups, folder, "static")
    rows = []
    for words, unbalance in UNBALANCES.items():
        print(f"{model}, {words} unbalance ...", flush=True)
        moving = run_case(options.gfb, {
            **groups, "scene": {"analysis": "transient"}, "rotor": {"mass": MASS},
            "transient": {"turns": turns, "steps_per_turn": STEPS}, "unbalance": {"unbalance": unbalance}}, folder, "moving", may_stop=True)
        with open_results(f"{moving.stem}.h5") as file:
            taken = {name: file[f"transient/{name}"][-1] - file[f"transient/{name}"][0]
                     for name in ("turns", "steps", "newton_iterations", "factorizations")}
        cpu = (moving.cpu - static.cpu)/taken["turns"]
        rows.append([model, f"{1.0e6*unbalance:g}", f"{moving['orbit_x']/CASE['bearing']['clearance']:.3f}", f"{static.cpu:.2f}", f"{cpu:.1f}",
                     f"{aim:g}", f"{cpu/static.cpu:.1f}", f"{taken['steps']/taken['turns']:.0f}",
                     f"{taken['newton_iterations']/taken['steps']:.1f}", f"{taken['steps']/max(1.0, taken['factorizations']):.1f}"])
    return rows
