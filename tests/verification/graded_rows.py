#!/usr/bin/env python3
"""Rows that are finer towards the edges of the width: the references of the rigid film, and shells, whose edges have the
thinnest film: less error on as many rows, the same limit, the same answer on half the width and on two ranks."""

import json
import math
import pathlib
import tempfile

from biquadratic import BEARING
from gfb_run import Checks, largest_difference, observed_order, run, solve
from pads import of_pads

ROWS = json.loads((pathlib.Path(__file__).parent/"reference"/"film_rigid.json").read_text(encoding="utf-8"))["rows"]
HELD = [row for row in ROWS if row["mode"] == "ey=0"]
ONE_PAD = {"count": 1, "arc": 2.0, "preload": 0.0, "first_leading_edge": 2.2}
THIN = (2.9e-5, 0.0)  # the film is thinnest on the pad, a tenth of the clearance


def film_error(folder, row, mesh, refinement, order=1):
    """Relative error of the film's force."""
    groups = {"mesh": {"edge_refinement": refinement}, "model": {"film_order": order}}
    answer = run(folder, "film", BEARING, mesh=mesh, groups=groups, number=row["Lam"],
                 eccentricity=(row["eps"]*BEARING.clearance, 0.0))
    return math.hypot(*answer.force)/BEARING.force_unit/row["W"] - 1.0


def check_film(checks, folder):
    """The table's forces; many elements around, so that rows decide."""
    row = max(HELD, key=lambda one: one["eps"]*one["Lam"])
    words = f"Lambda {row['Lam']:g}, eps {row['eps']:g}"
    errors = [film_error(folder, row, mesh, 4.0) for mesh in ((104, 8), (208, 16), (416, 32))]
    checks.that(f"{words}: order {observed_order(*errors[1:]):.2f} (at least 1.8)", observed_order(*errors[1:]) > 1.8)
    checks.below(f"{words}: biquadratic", film_error(folder, row, (104, 16), 4.0, 2), 1.0e-3)
    even = film_error(folder, row, (416, 8), 1.0)
    checks.below(f"{words}: error over that of equal rows", film_error(folder, row, (416, 8), 4.0)/even, 0.8)


def on_shells(folder, rows, refinement, ranks=1, **model):
    """A pad of shells near the shaft."""
    groups = of_pads("shell", ONE_PAD, THIN)
    groups["mesh"] |= {"axial_elements": rows, "edge_refinement": refinement}
    groups["model"] |= model
    return solve(folder, "shell", groups, ranks)


def check_shells(checks, folder):
    """Against 64 equal rows."""
    fine = on_shells(folder, 64, 1.0)
    even, graded = on_shells(folder, 8, 1.0), on_shells(folder, 8, 8.0)
    for name in ("force_x", "friction_torque"):
        errors = [answer[name]/fine[name] - 1.0 for answer in (even, graded)]
        checks.that(f"shells, {name}: error {errors[0]:.1e} of 8 equal rows, {errors[1]:.1e} of graded ones (below a half)",
                    abs(errors[1]) < 0.5*abs(errors[0]))
    for words, other in (("whole width", on_shells(folder, 8, 8.0, half_width="no")), ("two ranks", on_shells(folder, 8, 8.0, 2))):
        checks.below(f"shells, {words}: force", math.hypot(*graded.force)/math.hypot(*other.force) - 1.0, 1.0e-9)
        checks.below(f"shells, {words}: smallest gap", largest_difference([graded["minimum_gap"]], [other["minimum_gap"]]), 1.0e-8)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_film(checks, folder)
        check_shells(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
