#!/usr/bin/env python3
"""Foils in contact, from nothing: every load, speed, friction and fixed edge comes home, or its fold is named.

With --long at every friction, on shells too, and to the fold by more ways.
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
WAYS = (("one step", (60.0, 30.0), 1), ("many steps", (60.0, 50.0, 45.0, 41.0, 30.0), 1),
        ("two ranks", (60.0, 45.0, 30.0), 2))  # to the fold: loads, ranks
SHELL_MESH = {**MESH, "circumferential_elements": 104, "axial_elements": 6}


def find(folder, name, load, speed, edge="trailing", friction=0.1, foil="beam", **options):
    """One bearing, cold; without a status to expect it must come home."""
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
            check_points(checks, folder, (0.0, 0.1, 0.3))
            check_shells(checks, folder)
            check_fold(checks, folder, WAYS)
        else:
            check_points(checks, folder, (0.1,))
            check_fold(checks, folder, WAYS[:2])
    checks.close()


if __name__ == "__main__":
    main()
