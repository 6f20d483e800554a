#!/usr/bin/env python3
"""Rigid bearing with a slit against the twelve rows of reference/film_rigid.json.

Six rows hold the eccentricity along x, six turn it so that the force is along x. The slit sits at
theta = 0, so the two sets see the same film turned by the attitude angle against the groove: a groove in
the wrong place, or a wrong sense of rotation, would spoil one of them. The rows of eps 0.6 and 0.9, with --long those of 0.3.
"""

import json
import math
import pathlib
import sys
import tempfile

import numpy

from gfb_run import Bearing, Checks, observed_order, run

MESHES = ((208, 60), (416, 120))
EXACT = 1.0e-3      # of the force on the finest mesh, relative
ORDER = (1.8, 2.2)  # between the two meshes
PRESSURE = 1.0e-3   # of the largest and smallest nodal pressure on the finest mesh: it misses the
                    # true extremum by less than a cell's curvature
BEARING = Bearing()


def held_errors(folder, row):
    """Errors of force and pressures on each mesh with the eccentricity along x."""
    for mesh in MESHES:
        answer = run(folder, "held", BEARING, mesh=mesh, number=row["Lam"],
                     eccentricity=(row["eps"]*BEARING.clearance, 0.0))
        force = answer.force/BEARING.force_unit
        errors = {"W": numpy.hypot(*force)/row["W"] - 1.0, "Fx": force[0]/row["Fx"] - 1.0,
                  "Fy": force[1]/row["Fy"] - 1.0}
        yield errors, pressure_errors(answer, row)


def balanced_errors(folder, row):
    """Errors of position and pressures on each mesh with the force along x."""
    for mesh in MESHES:
        answer = run(folder, "balanced", BEARING, mesh=mesh, number=row["Lam"],
                     load=(row["Fx"]*BEARING.force_unit, 0.0))
        eccentricity = answer.eccentricity/BEARING.clearance
        direction = math.degrees(math.atan2(eccentricity[1], eccentricity[0]))
        errors = {"eps": numpy.hypot(*eccentricity) - row["eps"],
                  "direction": math.radians(direction - row["ecc_dir_deg"]),
                  "attitude": math.radians(answer["attitude_angle"] - row["ecc_dir_deg"])}
        yield errors, pressure_errors(answer, row)


def pressure_errors(answer, row):
    """Relative errors of the extreme pressures."""
    return [answer["maximum_pressure"]/BEARING.ambient_pressure/row["p_max"] - 1.0,
            answer["minimum_pressure"]/BEARING.ambient_pressure/row["p_min"] - 1.0]


def check_cells(checks, folder):
    """Biquadratic cells too long for their Peclet number: the smallest pressure is off, and that is told."""
    found = [run(folder, "cells", BEARING, mesh=(around, 16), number=130.0, eccentricity=(0.3*BEARING.clearance, 0.0),
                 groups={"model": {"film_order": 2}}) for around in (26, 104)]
    told = ["of the concentric film, without upwinding: the smallest pressure may be" in answer.log for answer in found]
    checks.that("cells too long: told of the long ones alone", told == [True, False])
    checks.within("cells too long: the smallest pressure", found[0]["minimum_pressure"]/found[1]["minimum_pressure"] - 1.0, -0.06, -0.01)


def main():
    path = pathlib.Path(__file__).resolve().parent/"reference"/"film_rigid.json"
    rows = json.loads(path.read_text(encoding="utf-8"))["rows"]
    checks = Checks()
    checks.that(f"{len(rows)} rows", len(rows) == 12)
    rows = [row for row in rows if (row["eps"] > 0.5) is not ("--long" in sys.argv)]
    checks.that(f"{len(rows)} of them", len(rows) == (4 if "--long" in sys.argv else 8))
    with tempfile.TemporaryDirectory() as folder:
        for row in rows:
            held = row["mode"] == "ey=0"
            errors, pressures = zip(*(held_errors if held else balanced_errors)(folder, row))
            words = f"Lambda {row['Lam']:g}, eps {row['eps']:g}, {row['mode']}"
            for name in errors[0]:
                checks.below(f"{words}: {name}", errors[-1][name], EXACT)
            leading = "W" if held else "eps"
            checks.within(f"{words}: order of {leading}",
                          observed_order(errors[-2][leading], errors[-1][leading]), *ORDER)
            checks.below(f"{words}: extreme pressures", max(map(abs, pressures[-1])), PRESSURE)
        if "--long" not in sys.argv:
            check_cells(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
