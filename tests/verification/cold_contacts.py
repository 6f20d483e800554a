#!/usr/bin/env python3
"""Foils in contact, from nothing: every load, speed, friction and fixed edge converges, or its fold is named.

With --long at other friction, on shells too, also in many rows, and to the fold by more ways.
"""

import re
import sys
import tempfile

from gfb_run import Checks
from shell_bearing import check_balance, solve

# Along the motion the default mesh of the bearing; contacts by default.
MESH = {"circumferential_elements": 208, "axial_elements": 8, "arc_elements": 8, "flat_elements": 2,
        "align_crests": True}
CONTACT = {"normal_stiffness": None, "stick_length": None}
# N at rpm: from loads that hardly press the foils to such that leave little film.
POINTS = ((10.0, 10000.0), (20.0, 30000.0), (20.0, 45000.0), (40.0, 60000.0), (100.0, 10000.0), (100.0, 60000.0),
          (200.0, 30000.0))
SHELL_POINTS = (("trailing", 20.0, 30000.0), ("leading", 40.0, 60000.0))
ROWS_MESH = {**MESH, "axial_elements": 32}  # four times as many rows as on the mesh where the search begins
FINEST = 20       # factorizations of a mesh that a smaller one's answer leads to, at most
WAYS = (("one step", (60.0, 30.0), 1), ("many steps", (60.0, 50.0, 45.0, 41.0, 30.0), 1),
        ("two ranks", (60.0, 45.0, 30.0), 2))  # to the fold: loads, ranks
SHELL_MESH = {**MESH, "circumferential_elements": 104, "axial_elements": 6}


def find(folder, name, load, speed, edge="trailing", friction=0.1, foil="beam", **options):
    """One bearing, cold; without a status to expect it must converge."""
    return solve(folder, name, model={"foil": foil, "film_scheme": None}, top_foil={"fixed_edge": edge},
                 contact={**CONTACT, "friction_top": friction, "friction_sleeve": friction},
                 operation={"load": (-load, 0.0), "speed_rpm": speed}, **{"mesh": MESH, **options})


def check_points(checks, folder, frictions):
    """Both fixed edges."""
    for edge in ("trailing", "leading"):
        for friction in frictions:
            for load, speed in POINTS:
                words = f"{edge} edge fixed, friction {friction}, {load:.0f} N at {speed:.0f} rpm"
                run = find(folder, "cold", load, speed, edge, friction)
                check_balance(checks, words, run, (-load, 0.0))


def check_shells(checks, folder):
    """Shells at two of the points that are hard."""
    for edge, load, speed in SHELL_POINTS:
        run = find(folder, "shell", load, speed, edge, foil="shell", mesh=SHELL_MESH)
        check_balance(checks, f"shells, {edge} edge fixed, {load:.0f} N at {speed:.0f} rpm", run, (-load, 0.0))


def check_rows(checks, folder):
    """Where the film is so thin that eight rows do not lead to 32, sixteen do; the answer is that of a load that rises."""
    foils = {"foil": "shell", "mesh": ROWS_MESH, "bump_foil": {"fixed_edge": "leading"}, "edge": "leading"}
    run = find(folder, "rows", 200.0, 30000.0, **foils)
    check_balance(checks, "film of 1.4 um on shells and 32 rows", run, (-200.0, 0.0))
    checks.that("it came over 16 rows", re.search("no answer from that of 8 rows .*; half of 32 first", run.log))
    checks.that(f"{run['factorizations_finest']:.0f} factorizations of the finest mesh", run["factorizations_finest"] <= FINEST)
    swept = find(folder, "loads", 200.0, 30000.0, **foils, sweep={"parameter": "load", "values": (100.0, 150.0, 200.0)})
    checks.below("smallest film against a sweep of the load", run["minimum_gap"]/swept["minimum_gap"] - 1.0, 1.0e-9)


def check_fold(checks, folder, ways):
    """Under less and less load the foil leaves its first crest: the branch ends there, whatever the steps."""
    ends = []
    for words, values, ranks in ways:
        run = find(folder, "fold", 60.0, 30000.0, ranks=ranks, status=2,
                   sweep={"parameter": "load", "values": values})
        checks.that(f"{words}: the log names the fold", "the branch of answers ends in a fold" in run.log)
        checks.that(f"{words}: the points before are kept", len(run.history()["load"]) == len(values) - 1)
        told = re.search(r"last state reached: load \((-[0-9.]+),", run.log)
        ends.append(-float(told.group(1)))
    checks.below(f"folds at {ends} N differ by", max(ends)/min(ends) - 1.0, 1.0e-4)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        if "--long" in sys.argv:
            check_points(checks, folder, (0.0, 0.3))
            check_rows(checks, folder)
            check_shells(checks, folder)
            check_fold(checks, folder, WAYS)
        else:
            check_points(checks, folder, (0.1,))
            check_fold(checks, folder, WAYS[:2])
    checks.close()


if __name__ == "__main__":
    main()
