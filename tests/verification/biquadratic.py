#!/usr/bin/env python3
"""The film of biquadratic elements against the references of the bilinear one, on meshes that cost far less.

The rigid bearing with a slit against the twelve rows of reference/film_rigid.json, the rigid ring against an exact
integral (see ring.py), the ring on springs against an independent solution (see foundation.py). The force converges
faster than with the second order of bilinear elements. On half their number each way, that is on as many nodes, its
error is a quarter of theirs at most.
"""

import json
import math
import pathlib
import tempfile

import numpy

from foundation import TABLE, on_springs
from gfb_run import Bearing, Checks, observed_order, run

MESHES = ((52, 16), (104, 32))
BILINEAR = (208, 64)   # as many nodes as the finer one
EXACT = 5.0e-4         # of the force on 104 x 32, relative; 1.8e-4 where Lambda is 5 and eps 0.9
PRESSURE = 1.0e-3      # of the extreme nodal pressures, as for bilinear elements
ORDER = 2.2            # of the force at least: where eps is 0.9 these meshes are not fine yet
BEARING = Bearing()
RING = Bearing(leading_edge_condition="periodic")


def solve(folder, bearing, mesh, order, **case):
    """A run with elements of an order."""
    groups = {group: dict(keys) for group, keys in case.pop("groups", {}).items()}
    groups.setdefault("model", {})["film_order"] = order
    return run(folder, f"order_{order}", bearing, mesh=mesh, groups=groups, **case)


def held_error(folder, row, mesh, order):
    """Relative error of the force with the eccentricity along x, and the answer."""
    answer = solve(folder, BEARING, mesh, order, number=row["Lam"], eccentricity=(row["eps"]*BEARING.clearance, 0.0))
    return numpy.hypot(*answer.force)/BEARING.force_unit/row["W"] - 1.0, answer


def balanced_error(folder, row, mesh, order):
    """Error of the eccentricity ratio with the force along x, and the answer."""
    answer = solve(folder, BEARING, mesh, order, number=row["Lam"], load=(row["Fx"]*BEARING.force_unit, 0.0))
    return numpy.hypot(*answer.eccentricity)/BEARING.clearance - row["eps"], answer


def check_row(checks, folder, row):
    """One row of the tables."""
    held = row["mode"] == "ey=0"
    error = held_error if held else balanced_error
    words = f"Lambda {row['Lam']:g}, eps {row['eps']:g}, {row['mode']}: {'W' if held else 'eps'}"
    coarse, _ = error(folder, row, MESHES[0], 2)
    fine, answer = error(folder, row, MESHES[1], 2)
    bilinear, other = error(folder, row, BILINEAR, 1)
    checks.below(words, fine, EXACT)
    checks.that(f"{words}: as many nodes", answer["unknowns"] == other["unknowns"])
    checks.below(f"{words}: error over that of bilinear elements", fine/bilinear, 0.25)
    if abs(fine) > 1.0e-7:  # the table has eight digits
        checks.that(f"{words}: order {observed_order(coarse, fine):.2f} (at least {ORDER})",
                    observed_order(coarse, fine) > ORDER)
    checks.below(f"{words}: extreme pressures", max(
        abs(answer["maximum_pressure"]/BEARING.ambient_pressure/row["p_max"] - 1.0),
        abs(answer["minimum_pressure"]/BEARING.ambient_pressure/row["p_min"] - 1.0)), PRESSURE)


def invariant_error(folder, mesh, number, eps):
    """Largest relative error of the integral of H^3 P^2 over the ring, at the rows of nodes."""
    film = solve(folder, RING, mesh, 2, number=number, eccentricity=(eps*RING.clearance, 0.0)).film_arrays()
    integrand = (film["gap"]/RING.clearance)**3*(film["pressure"]/RING.ambient_pressure)**2
    return float(numpy.abs(integrand[:-1].mean(axis=0)/(1.0 + 1.5*eps**2) - 1.0).max())


def check_ring(checks, folder):
    """At the nodes the error shrinks with the third order at least."""
    for number, eps in ((1.0, 0.6), (20.0, 0.5)):
        errors = [invariant_error(folder, mesh, number, eps) for mesh in ((26, 8), (52, 16), (104, 32))]
        words = f"ring, Lambda {number:g}, eps {eps:g}"
        checks.below(f"{words}: error", errors[-1], 1.0e-4)
        checks.that(f"{words}: order {observed_order(errors[1], errors[2]):.2f} (at least 2.9)",
                    observed_order(errors[1], errors[2]) > 2.9)


def check_springs(checks, folder):
    """The ring on springs, whose table has five digits."""
    for eps, force, attitude in TABLE:
        answer = solve(folder, RING, (52, 16), 2, number=1.0, eccentricity=(eps*RING.clearance, 0.0),
                       **on_springs(RING.ambient_pressure/RING.clearance))
        words = f"ring on springs, eps {eps:g}"
        checks.below(f"{words}: force",
                     math.hypot(*answer.force)/(RING.ambient_pressure*RING.radius**2)/force - 1.0, 5.0e-4)
        checks.below(f"{words}: attitude angle", answer["attitude_angle"] - attitude, 0.02)


def check_mean(checks, folder):
    """Springs that feel the mean along the axis sink by Simpson's rule."""
    bearing = Bearing()
    stiffness = 0.5*bearing.ambient_pressure/bearing.clearance
    film = solve(folder, bearing, (32, 8), 2, number=2.0, eccentricity=(0.0, 0.5*bearing.clearance),
                 **on_springs(stiffness, "axial_mean")).film_arrays()
    over = film["pressure"] - bearing.ambient_pressure
    mean = (over[:, :-2:2] + 4.0*over[:, 1::2] + over[:, 2::2]).sum(axis=1)/6.0/8.0
    checks.below("mean foundation: deflection", numpy.abs(film["deflection"] - mean[:, None]/stiffness).max()/
                 film["deflection"].max(), 1.0e-9)


def main():
    path = pathlib.Path(__file__).resolve().parent/"reference"/"film_rigid.json"
    rows = json.loads(path.read_text(encoding="utf-8"))["rows"]
    checks = Checks()
    checks.that(f"{len(rows)} rows", len(rows) == 12)
    with tempfile.TemporaryDirectory() as folder:
        for row in rows:
            check_row(checks, folder, row)
        check_ring(checks, folder)
        check_springs(checks, folder)
        check_mean(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
