#!/usr/bin/env python3
"""Rigid full ring without a slit: two exact results, two tables, and no preferred direction.

E1: the integral of H^3 P^2 over theta is 2 pi (1 + 1.5 eps^2) at every z, whatever Lambda. The trapezoidal
rule is exact for it to round-off (all is periodic), so what is left is the error of the nodal pressures.
E2: for Lambda -> infinity, P H = sqrt(1 + 1.5 eps^2), approached as Lambda^-1/2 (side layers of that width); with --long,
as the layers need a fine mesh.
"""

import functools
import json
import math
import pathlib

import numpy

from gfb_run import Bearing, largest_difference, observed_order, run, run_checks

MESHES = ((104, 32), (208, 64), (416, 128))
ORDER = (1.8, 2.2)
TABLE_FORCE = 5.0e-4    # relative, on 416 x 128; the tables have five digits
TABLE_ATTITUDE = 0.02   # degrees, on 416 x 128
RING = Bearing(leading_edge_condition="periodic")


@functools.cache
def solved(folder, mesh, number, eps):
    """The ring's answer, which an exact result and a table may share."""
    return run(folder, f"ring_{mesh[0]}_{number:g}_{eps:g}", RING, mesh=mesh, number=number,
               eccentricity=(eps*RING.clearance, 0.0))


def invariant_error(folder, mesh, number, eps):
    """Largest relative error of E1 over all z."""
    answer = solved(folder, mesh, number, eps)
    film = answer.film_arrays()
    integrand = (film["gap"]/RING.clearance)**3*(film["pressure"]/RING.ambient_pressure)**2
    angle = film["theta"][:, 0]
    if not math.isclose(math.remainder(angle[-1] - angle[0], 2.0*math.pi), 0.0, abs_tol=1.0e-12):
        return math.inf
    integral = integrand[:-1].mean(axis=0)*2.0*math.pi
    return float(numpy.abs(integral/(2.0*math.pi*(1.0 + 1.5*eps**2)) - 1.0).max())


def check_invariant(checks, folder):
    for number, eps in ((1.0, 0.6), (5.0, 0.9), (20.0, 0.5)):
        errors = [invariant_error(folder, mesh, number, eps) for mesh in MESHES]
        words = f"E1, Lambda {number:g}, eps {eps:g}"
        checks.below(f"{words}: error", errors[-1], 2.0e-4)
        checks.within(f"{words}: order", observed_order(errors[-2], errors[-1]), *ORDER)


def check_tables(checks, folder):
    """The two tables: Lambda 1 at four eccentricities, eps 0.5 at seven Lambda."""
    path = pathlib.Path(__file__).resolve().parent/"reference"/"film_rigid.json"
    exact = json.loads(path.read_text(encoding="utf-8"))["exact"]
    table = exact["periodic_Lam1_LD1"]
    unit = RING.ambient_pressure*RING.radius**2
    for eps, force, attitude in zip(table["eps"], table["W_over_pa_R2"], table["attitude_deg"]):
        compare(checks, folder, (1.0, eps), force*unit, attitude)
    table = exact["E2_eps_0p5_LD_1"]
    for number, force, attitude in zip(table["Lam"], table["W"], table["attitude_deg"]):
        compare(checks, folder, (number, 0.5), force*RING.force_unit, attitude)


def compare(checks, folder, place, force, attitude):
    """One row of a table on the finest mesh."""
    number, eps = place
    answer = solved(folder, MESHES[-1], number, eps)
    words = f"table, Lambda {number:g}, eps {eps:g}"
    checks.below(f"{words}: force", math.hypot(*answer.force)/force - 1.0, TABLE_FORCE)
    checks.below(f"{words}: attitude angle", answer["attitude_angle"] - attitude, TABLE_ATTITUDE)


def check_limit(checks, folder):
    """The force approaches E2's as Lambda^-1/2, extrapolated it reaches it."""
    eps = 0.5
    limit = math.pi/eps*math.sqrt(1.0 + 1.5*eps**2)*(1.0/math.sqrt(1.0 - eps**2) - 1.0)
    numbers = (1000.0, 4000.0, 16000.0)
    forces = []
    for number in numbers:
        answer = run(folder, "limit", RING, mesh=(208, 512), number=number,
                     eccentricity=(eps*RING.clearance, 0.0))
        forces.append(math.hypot(*answer.force)/RING.force_unit)
    deficits = [1.0 - force/limit for force in forces]
    for i in (0, 1):
        checks.within(f"E2: exponent of the approach, Lambda {numbers[i]:g} to {numbers[i + 1]:g}",
                      -observed_order(deficits[i], deficits[i + 1], 4.0), -0.55, -0.45)
    checks.below("E2: limit, extrapolated", (2.0*forces[2] - forces[1])/limit - 1.0, 1.0e-3)
    film = answer.film_arrays()
    product = film["pressure"]*film["gap"]/(RING.ambient_pressure*RING.clearance)
    checks.below("E2: P H at the midplane", largest_difference(
        product[:, product.shape[1]//2], numpy.full(len(product), math.sqrt(1.0 + 1.5*eps**2))), 1.0e-3)


def check_direction(checks, folder):
    """Where the ring's first station lies is of no consequence: film and force turn with the shaft."""
    mesh, turned, eps = (96, 16), 31, 0.7
    answers = []
    for steps in (0, turned):
        angle = 0.3 + 2.0*math.pi*steps/mesh[0]
        answers.append(run(folder, f"direction_{steps}", RING, mesh=mesh, number=3.0, eccentricity=(
            eps*RING.clearance*math.cos(angle), eps*RING.clearance*math.sin(angle))))
    angle = 2.0*math.pi*turned/mesh[0]
    turn = numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    checks.below("turned shaft: force turns with it", largest_difference(
        turn@answers[0].force, answers[1].force), 1.0e-10)
    first, second = (answer.film_arrays()["pressure"] for answer in answers)
    checks.below("turned shaft: pressure turns with it", largest_difference(
        numpy.roll(first[:-1], turned, axis=0), second[:-1]), 1.0e-10)
    checks.below("ring closed: last station is the first", largest_difference(second[0], second[-1]), 0.0)


def main():
    run_checks((check_invariant, check_direction), (check_tables, check_limit))


if __name__ == "__main__":
    main()
