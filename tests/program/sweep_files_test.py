#!/usr/bin/env python3
"""Sweeps: a table of all points at the end of the log, the history as comma-separated values, the answer's point."""

import csv
import math
import pathlib
import re
import sys
import tempfile

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import Bearing, Checks, case_groups, solve  # noqa: E402

BEARING = Bearing()
HEAT = {"shaft_conductance": 0.1, "shaft_expansion": 1.2e-5, "sleeve_conductance": 1.0, "top_foil": "given", "top_foil_temperature": 300.0}
HOT = {"running_clearance": ("clearance [um]", 1.0e6, 0.0), "shaft_temperature": ("shaft [C]", 1.0, 273.15),
       "maximum_film_temperature": ("hottest film [C]", 1.0, 273.15)}  # in the log's table: its head, table's number over SI number, and its zero
KEYS = {"parameter": "bearing%clearance", "values": (20.0e-6, 21.0e-6)}


PLAY = {"running_play": ("play [um]", 1.0e6, 0.0)}  # instead of the clearance, of pads with a preload


def sweep(folder, name, swept, options=(), status=0, load=(-20.0, 0.0), heat=None, pads=None):
    """The answer of a small rigid bearing along a sweep."""
    groups = {} if swept is None else {"sweep": swept}
    if pads:
        groups |= {"pads": pads}
    if heat:
        groups |= {"thermal": heat}
    content = case_groups(BEARING, mesh=(48, 8), number=2.0, load=load, groups=groups)
    return solve(folder, name, content, options=options, status=status)


def table_of(answer):
    """Names, units and rows of a table of comma-separated values."""
    with open(f"{answer.stem}.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    heads = [re.fullmatch(r"(\w+) \[(.+)\]", head) for head in rows[0]]
    return [head[1] for head in heads], [head[2] for head in heads], [[float(word or "nan") for word in row] for row in rows[1:]]


def check_table(checks, answer, points, group="history", first="converged"):
    """The same columns, units and digits as in a group of the HDF5 file."""
    names, units, rows = table_of(answer)
    with h5py.File(f"{answer.stem}.h5") as file:
        history = {name: data for name, data in file[group].items() if data.ndim == 1}
        points = points or len(history[first])
        checks.that(f"{answer.stem.name}: the columns of {group}", set(names) == set(history))
        checks.that(f"{answer.stem.name}: units", all(history[name].attrs["unit"] == unit for name, unit in zip(names, units)))
        checks.that(f"{answer.stem.name}: {points} rows", len(rows) == points == len(history[first]))
        for name, column in zip(names, zip(*rows)):
            same = all(one == other or math.isnan(one) and math.isnan(other) for one, other in zip(column, history[name][...]))
            checks.that(f"{answer.stem.name}: {name} to the last digit", same)


def check_motions(checks, folder):
    """A shaft over time, and orbits: with --csv the table has a row a stored time, or an orbit."""
    springs = {"model": {"foil": "elastic_foundation", "foundation_stiffness": 4.8e9}, "rotor": {"mass": 0.3}, "unbalance": {"unbalance": 1.0e-6}}
    for analysis, group, first, groups in (
            ("transient", "transient", "time", {"transient": {"turns": 0.5, "steps_per_turn": 60}}),
            ("periodic", "periodic", "period", {"periodic": {"steps_per_turn": 40, "start_turns": 1}})):
        content = case_groups(BEARING, mesh=(24, 4), number=2.0, load=(-20.0, 0.0), groups=springs | groups)
        content["scene"] = content.get("scene", {}) | {"analysis": analysis}
        answer = solve(folder, analysis, content, options=("--csv",))
        check_table(checks, answer, 0, group, first)
        checks.that(f"{analysis}: a first column, and rows", first in table_of(answer)[0] and len(table_of(answer)[2]) >= (20 if first == "time" else 1))


def check_decimal_commas(checks, folder):
    """The same tables, with semicolons between columns and commas in numbers."""
    content = case_groups(BEARING, mesh=(24, 4), number=2.0, load=(-20.0, 0.0), groups={
        "model": {"foil": "elastic_foundation", "foundation_stiffness": 4.8e9}, "dynamics": {"frequency_ratios": (0.5, 1.0)}})
    content["scene"] = content.get("scene", {}) | {"analysis": "linear_dynamics"}
    tables = []
    for name, options in (("point", ("--csv",)), ("comma", ("--csv", "--decimal-comma"))):
        stem = solve(folder, name, content, options=options).stem
        tables.append([pathlib.Path(f"{stem}.{ending}").read_text(encoding="utf-8") for ending in ("csv", "coefficients.csv")])
    for (plain, other), fixed in zip(zip(*tables), (("wall_time", "peak_memory"), ())):
        rows = [[line.split(mark) for line in text.splitlines()] for text, mark in ((plain, ","), (other, ";"))]
        kept = [i for i, head in enumerate(rows[0][0]) if head.partition(" [")[0] not in fixed]
        checks.that(f"decimal commas: {len(rows[0])} lines", len(rows[0]) > 1 and "." not in other and "," in other)
        checks.that("decimal commas: the same", [[row[i] for i in kept] for row in rows[0]] == [[row[i].replace(",", ".") for i in kept] for row in rows[1]])


def check_heat(checks, folder):
    """With heat the log's table has the running clearance, or the play that a preload leaves of it, and temperatures, to the digits of
    the history."""
    three = {"count": 3, "arc": 2.0, "preload": 0.5}
    for pads, columns in ((None, HOT), (three, PLAY | {name: HOT[name] for name in HOT if name != "running_clearance"})):
        hot = sweep(folder, "hot", {"parameter": "load", "values": (20.0, 30.0)}, heat=HEAT, pads=pads)
        head, *rows = re.search(r"^points of the sweep\n-+\n(.*?)\n\n", hot.log, re.M | re.S)[1].splitlines()
        heads, rows = re.split(r"  +", head.strip()), [line.split() for line in rows]
        checks.that("clearance or play", ("clearance [um]" in heads) == (pads is None))
        for name, (column, scale, zero) in columns.items():
            told = [float(row[heads.index(column)]) for row in rows] if column in heads else []
            checks.that(f"{column}: at both points", len(told) == 2)
            checks.that(f"{column}: {name}", all(abs(one/(scale*(number - zero)) - 1.0) < 1.0e-4 for one, number in zip(told, hot.history()[name])))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        loads = sweep(folder, "loads", {"parameter": "load", "values": (20.0, 30.0, 40.0)})
        check_table(checks, loads, 3)
        checks.that("the log has a line a point", re.search(r"^points of the sweep\n-+\n +load \[N\] .*film \[um\].*\n +20 .*\n +30 .*\n +40 ",
                                                            loads.log, re.M))
        head = re.search(r"^ +load \[N\] .*$", loads.log, re.M)[0]  # the load is along x or y: its other component is rounding
        checks.that("no force that is rounding alone", ("force_x" in head) != ("force_y" in head))
        checks.that("the answer names its point", "point            3 of 3: load = 40 N\n" in loads.log)
        keys = sweep(folder, "keys", KEYS)
        check_table(checks, keys, 2)
        checks.that("keys: the answer's point", "point            2 of 2: bearing%clearance = 2.1e-5 m\n" in keys.log)
        none = sweep(folder, "none", {"parameter": "load", "values": (1.0e9, 2.0e9)}, status=2, load=(-1.0e9, 0.0))
        check_table(checks, none, 0)
        checks.that("no point: said", "no point of the sweep has an answer" in none.log)
        checks.that("no point: its columns", table_of(none)[0][:2] == ["load", "converged"])
        some = sweep(folder, "some", {"parameter": "load", "values": (20.0, 30.0, 1.0e9)}, status=2)
        check_table(checks, some, 2)
        checks.that("two points: said", "the last with an answer is 2 of 3: load = 30 N" in some.log)
        single = sweep(folder, "single", None)
        checks.that("no sweep: no table", not (folder/"single.csv").exists() and "point  " not in single.log)
        check_table(checks, sweep(folder, "single", None, options=("--csv",)), 1)
        check_heat(checks, folder)
        check_motions(checks, folder)
        check_decimal_commas(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
