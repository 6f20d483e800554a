"""Measures gfb: time, work and error, in one run on one machine. `tools/bench COMMAND --help` says what.

Times depend on the machine and on what else runs there; compare only numbers of one run.
"""

import argparse
import pathlib

from gfb.bench import (accuracy, assembly, bearing, bearing_mesh, bearings, condensation, dynamics, faults, film, linear_solvers, measured,
                       population, profile, scaling, strip, thermal, thrust, transient, work_precision)
from gfb.program import find_gfb
from gfb.tool import draw_into_files, stop

COMMANDS = {"film": film, "accuracy": accuracy, "assembly": assembly, "condensation": condensation, "dynamics": dynamics, "faults": faults,
            "strip": strip, "bearing": bearing, "bearing-mesh": bearing_mesh, "bearings": bearings, "linear-solvers": linear_solvers,
            "measured": measured, "population": population, "profile": profile, "scaling": scaling, "thermal": thermal, "thrust": thrust,
            "transient": transient, "work-precision": work_precision}


def main():
    parser = argparse.ArgumentParser(prog="tools/bench", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, module in COMMANDS.items():
        one = commands.add_parser(name, help=module.__doc__.splitlines()[0], description=module.__doc__,
                                  formatter_class=argparse.RawDescriptionHelpFormatter)
        one.add_argument("--gfb", metavar="PROGRAM", help="the program; default: build/release/gfb")
        one.add_argument("--output", metavar="DIR", default="results/bench", type=pathlib.Path,
                         help="folder of table and picture; default: %(default)s")
        module.add_options(one)
    options = parser.parse_args()
    if getattr(options, "repetitions", 1) < 1:
        stop("--repetitions: at least 1")
    draw_into_files()  # not after minutes of computing
    options.gfb = find_gfb(options.gfb)
    try:
        options.output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        stop(f"--output {options.output}: {error.strerror}", 3)
    table = COMMANDS[options.command].run(options)
    print(table, end="")
    (options.output/f"{options.command}.txt").write_text(table, encoding="utf-8")
    print(f"\nresults are in {options.output}")
    return 0
