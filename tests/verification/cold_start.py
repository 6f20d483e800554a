#!/usr/bin/env python3
"""From nothing to the equilibrium, for positions from nearly centred to nearly touching, and along sweeps.

A held position gives the force; that force as the load, from nothing, must give the position back. The
thinnest film is kept away from the slit: near it the same load has two equilibria, and the start value chooses.
"""

import math

import numpy

from gfb_run import Bearing, natural_sizes, run, run_checks

POSITION = 1.0e-8   # of the clearance
NUMBERS = (0.01, 1.0, 100.0, 1000.0)
ECCENTRICITIES = (0.05, 0.3, 0.6, 0.9, 0.97, 0.99)
BEARING = Bearing()
GU2020 = Bearing(radius=0.01905, length=0.0381, clearance=31.8e-6, viscosity=1.95e-5, ambient_pressure=1.0135e5)


def check_way_back(checks, folder):
    """Lambda from 0.01 to 1000, eccentricity up to 0.99, in different directions."""
    for i, number in enumerate(NUMBERS):
        for j, eps in enumerate(ECCENTRICITIES):
            direction = math.radians(-90.0 + (37.0*(len(ECCENTRICITIES)*i + j)) % 180.0)
            wanted = eps*BEARING.clearance*numpy.array([math.cos(direction), math.sin(direction)])
            case = {"mesh": (128, 16), "number": number}
            if number > 10.0:
                case["groups"] = {"model": {"film_scheme": "supg"}}
            held = run(folder, "held", BEARING, eccentricity=tuple(wanted), **case)
            found = run(folder, "found", BEARING, load=tuple(held.force), **case)
            checks.below(f"Lambda {number:g}, eps {eps:g}, {math.degrees(direction):.0f} deg: position",
                         numpy.abs(found.eccentricity - wanted).max()/BEARING.clearance, POSITION)


def check_branches(checks, folder):
    """With the thinnest film near the slit one load has two equilibria; a start value near one finds it."""
    direction = math.radians(176.4)
    wanted = 0.9*BEARING.clearance*numpy.array([math.cos(direction), math.sin(direction)])
    case = {"mesh": (128, 16), "number": 0.01}
    load = tuple(run(folder, "held", BEARING, eccentricity=tuple(wanted), **case).force)
    cold = run(folder, "cold", BEARING, load=load, **case)
    near = run(folder, "near", BEARING, load=load, eccentricity=tuple(0.97*wanted), **case)
    again = run(folder, "held", BEARING, eccentricity=tuple(cold.eccentricity), **case)
    checks.below("two equilibria: the start value's",
                 numpy.abs(near.eccentricity - wanted).max()/BEARING.clearance, POSITION)
    checks.that("two equilibria: another one", numpy.abs(cold.eccentricity - wanted).max() > 0.1*BEARING.clearance)
    checks.below("two equilibria: with the same force",
                 numpy.abs(again.force - load).max()/numpy.hypot(*load), POSITION)


def check_loads(checks, folder):
    """Very light and heavy loads on the bearing of [Gu2020], rigid."""
    per_load = []
    for load in (1.0e-6, 1.0e-3):
        answer = run(folder, "light", GU2020, mesh=(96, 16), speed_rpm=30000.0, load=(-load, 0.0))
        checks.below(f"load {load:g} N: force", (answer["force_x"] + load)/GU2020.force_unit, 1.0e-12)
        per_load.append(answer.eccentricity/load)
    checks.below("light loads: position in proportion", numpy.abs(
        per_load[0]/per_load[1] - 1.0).max(), 1.0e-4)
    gaps = []
    for load in (100.0, 1000.0, 5000.0):
        answer = run(folder, "heavy", GU2020, mesh=(256, 16), speed_rpm=30000.0, load=(-load, 0.0))
        checks.below(f"load {load:g} N: force", answer["force_x"]/load + 1.0, 1.0e-10)
        gaps.append(answer["minimum_gap"])
    checks.that("heavier loads make thinner films", gaps[0] > gaps[1] > gaps[2] > 0.0)


def check_sweeps(checks, folder):
    """Every point of a sweep is what a cold start finds there."""
    unit = BEARING.force_unit
    sweeps = {
        "load": (0.05*unit, 0.6*unit, 0.2*unit),
        "speed_rpm": (BEARING.speed_rpm(1.0), BEARING.speed_rpm(30.0), BEARING.speed_rpm(3.0)),
        "tilt_x": (0.0, 3.0e-4, -1.0e-4),
        "tilt_y": (0.0, -2.0e-4),
    }
    base = {"mesh": (96, 16)}
    for parameter, values in sweeps.items():
        point = {"speed_rpm": BEARING.speed_rpm(2.0), "load": (-0.3*unit, 0.4*unit)}
        swept = run(folder, "sweep", BEARING, groups={"sweep": {"parameter": parameter, "values": values}},
                    **base, **point)
        rows = swept.history()
        checks.that(f"sweep of {parameter}: {len(values)} rows",
                    all(len(column) == len(values) for column in rows.values()))
        checks.that(f"sweep of {parameter}: its values are in the history", numpy.array_equal(rows[parameter], values))
        for i, value in enumerate(values):
            if parameter == "load":
                point["load"] = tuple(value*numpy.array([-0.6, 0.8]))
            elif parameter == "speed_rpm":
                point["speed_rpm"] = value
            else:
                point["tilt"] = (value, 0.0) if parameter == "tilt_x" else (0.0, value)
            cold = run(folder, "cold", BEARING, **base, **point)
            checks.below(f"sweep of {parameter} at {value:g}", row_difference(rows, i, cold), POSITION)


def check_held_sweeps(checks, folder):
    """A held shaft in a sweep is a fixed position; a sweep of the position too."""
    unit, place = BEARING.force_unit, (0.3*BEARING.clearance, 0.5*BEARING.clearance)
    base = {"mesh": (96, 16), "speed_rpm": BEARING.speed_rpm(2.0)}
    tilts = (1.0e-4, -2.0e-4)
    swept = run(folder, "held_sweep", BEARING, load=(-0.3*unit, 0.4*unit), **base, groups={"sweep": {
        "parameter": "tilt_x", "values": tilts, "hold_position": True}})
    start = run(folder, "start", BEARING, load=(-0.3*unit, 0.4*unit), **base)
    for i, tilt in enumerate(tilts):
        cold = run(folder, "cold", BEARING, eccentricity=tuple(start.eccentricity), tilt=(tilt, 0.0), **base)
        checks.below(f"held sweep at {tilt:g}", row_difference(swept.history(), i, cold), POSITION)
    values = (0.0, 0.6*BEARING.clearance)
    swept = run(folder, "position_sweep", BEARING, eccentricity=place, **base, groups={"sweep": {
        "parameter": "eccentricity_x", "values": values}})
    for i, value in enumerate(values):
        cold = run(folder, "cold", BEARING, eccentricity=(value, place[1]), **base)
        checks.below(f"position sweep at {value:g}", row_difference(swept.history(), i, cold), POSITION)


def row_difference(rows, i, answer):
    """Largest relative difference of a row of the history from an answer."""
    sizes = natural_sizes(BEARING)
    return max(abs(rows[name][i] - value)/(sizes.get(name) or abs(value))
               for name, value in answer.physical().items() if abs(value) > 0.0 or name in sizes)


def main():
    run_checks((check_branches, check_loads, check_sweeps, check_held_sweeps), (check_way_back,))


if __name__ == "__main__":
    main()
