#!/usr/bin/env python3
"""Orbits of a machine that close: one is where a long march ends, multipliers are those of the modes, bad input is named; with
--long the orbit and the limit cycle of two independent programs."""

import cmath
import math

import h5py
import numpy

from gfb_run import run_checks, solve
from machine import REFERENCE
from machine_time import AXES, COARSE, linear, lines, moving_case

SPEED, DISC = 10000.0, 0.24  # of M1 [rpm], [m]


def orbit_case(folder, name, speed_rpm, periodic, unbalance=None, mesh=COARSE):
    """A machine of the reference whose orbits are sought."""
    content = moving_case(folder, name, speed_rpm, {}, unbalance, mesh)
    content["scene"] = {"analysis": "periodic"}
    del content["transient"]
    content["periodic"] = periodic
    return content


def orbits(stem):
    """The table of orbits."""
    with h5py.File(f"{stem}.h5", "r") as file:
        return {name: data[...] for name, data in file["periodic"].items()}


def stepped(rate, step):
    """By how much a mode grows in a step of the difference of second order, (3 - 4 w + w^2)/2 = h lambda with w = 1/z."""
    return 1.0/(2.0 - cmath.sqrt(1.0 + 2.0*step*rate))


def check_orbit(checks, folder):
    """The orbit that closes is the last turn of a long march in the same steps."""
    steps, turns = 20, 24
    large = {"position": DISC, "value": 1.0e-5, "angle": 0.3}
    answer = solve(folder, "orbit", orbit_case(folder, "M1", SPEED, {"steps_per_turn": steps, "start_turns": 3}, large))
    found = orbits(answer.stem)
    march = solve(folder, "march", moving_case(folder, "M1", SPEED, {"turns": turns, "steps_per_turn": steps}, large))
    history = lines(march.stem)
    worst = 0.0
    for place in ("bearing_1", "bearing_2", "disc_1"):
        for axis in AXES:
            last, closed = history[f"{axis}_{place}"][-steps - 1:], found[f"{axis}_{place}"][0]
            worst = max(worst, abs(last - closed).max()/numpy.ptp(closed))
            checks.that(f"extent of {axis} at {place}", math.isclose(answer[f"orbit_{axis}_{place}"], found[f"orbit_{axis}_{place}"][0], rel_tol=1.0e-12))
    kept = max(abs(found["multipliers_real"][0] + 1j*found["multipliers_imaginary"][0]))**turns
    checks.that(f"an orbit is where {turns} turns lead: {worst:.1e} of it, what is left of the beginning {kept:.1e}", worst < 2.0*kept + 2.0e-6)
    checks.below("its largest multiplier is that of no disturbance that stays", answer["largest_multiplier"], 0.99)


def check_multipliers(checks, folder):
    """Of a small orbit, by two ranks: those of the modes, in the same steps."""
    steps = 20
    small = {"position": DISC, "value": 1.0e-9, "angle": 0.3}
    answer = solve(folder, "small", orbit_case(folder, "M1", SPEED, {"steps_per_turn": steps, "start_turns": 0}, small), ranks=2)
    found = orbits(answer.stem)
    multipliers = found["multipliers_real"][0] + 1j*found["multipliers_imaginary"][0]
    turn = 60.0/SPEED
    modes = linear(folder, "M1", SPEED)
    expected = sorted((stepped(rate, turn/steps)**steps for rate in modes[modes.imag > 0.0]), key=abs)[::-1]
    for number, one in enumerate(expected[:2]):
        off = min(abs(multipliers - one))
        checks.that(f"multiplier {number + 1} is that of a mode: {abs(one):.4f}, off {off:.1e}", off < 2.0e-5)


def check_refusals(checks, folder):
    """What cannot be asked for, with its rule."""
    unbalance = {"position": DISC, "value": 1.0e-5, "angle": 0.0}
    steps, free = {"steps_per_turn": 40}, {"steps_per_turn": 40, "motion": "free", "parameter": "speed_rpm", "final_value": 12000.0}
    for name, periodic, given, words in (
            ("without an unbalance", steps, None, "values: must be given with motion = 'forced'"),
            ("free with an unbalance", free, unbalance, "values = 1e-05: has no use with motion = 'free'"),
            ("over its mass", steps | {"parameter": "mass", "final_value": 5.0}, unbalance, "must be 'speed_rpm' or 'unbalance' beside &shaft"),
            ("without an end", steps | {"parameter": "unbalance"}, unbalance, "final_value: must be given with parameter")):
        answer = solve(folder, "wrong", orbit_case(folder, "M1", SPEED, periodic, given), status=1)
        checks.that(f"{name}: {words}", words in answer.complaint)


def check_references(checks, folder):
    """The orbit of two independent programs, with the mean of two lengths of steps."""
    row = REFERENCE["orbit"][0]
    stations = ("bearing_1", "disc_1", "bearing_2")
    harmonic = []
    for steps in (60, 120):
        answer = solve(folder, f"orbit_{steps}", orbit_case(folder, "M1", row["speed_rpm"], {"steps_per_turn": steps, "start_turns": 4},
                                                            row["unbalance"], (60, 8)))
        found = orbits(answer.stem)
        ways = numpy.array([found[f"{axis}_{place}"][0][:-1] for place in stations for axis in AXES])
        harmonic.append(numpy.array([2.0*(ways*numpy.exp(-2j*math.pi*k*numpy.arange(steps)/steps)).mean(axis=1) for k in (1, 2)]))
    best = harmonic[1] + (harmonic[1] - harmonic[0])/3.0
    for k, name in enumerate(("h1", "h2")):
        wanted = numpy.array(row[name]["B"])@[1.0, 1j]
        off = abs(best[k] - wanted).max()/abs(wanted).max()
        checks.that(f"orbit {name}: {off:.1e} off, the two are within {row[name]['agreement']:.1e}", off < 10.0*row[name]["agreement"])


def check_cycle(checks, folder):
    """The limit cycle of two programs, by a march from a push on until it is steady, with the mean of two lengths of steps."""
    row = REFERENCE["cycle"][0]
    extents = []
    for steps in (50, 100):
        content = moving_case(folder, "M4", float(row["speed_rpm"]), {"turns": 90.0, "steps_per_turn": steps, "pulse": (2.0e-2, 0.0), "pulse_length": 1.0e-3},
                              None, (60, 8), row["stations"])
        answer = solve(folder, f"cycle_{steps}", content)
        table = lines(answer.stem)
        ends = [numpy.ptp(table["x_bearing_1"][(table["turns"] > last - 5.0) & (table["turns"] <= last)]) for last in (80.0, 90.0)]
        print(f"{steps} steps: extents of x in bearing 1 ten turns apart {ends[0]:.6e}, {ends[1]:.6e} m")
        checks.below("the limit cycle is steady", ends[1]/ends[0] - 1.0, 1.0e-3)
        extents.append(numpy.array([answer[f"orbit_{axis}_station_{k}"] for k in range(1, len(row["stations"]) + 1) for axis in AXES]))
    best, agreement = extents[1] + (extents[1] - extents[0])/3.0, row["extents"]["agreement"]
    checks.below("limit cycle: extents", abs(best/numpy.array(row["extents"]["B"]) - 1.0).max(), 10.0*agreement)


if __name__ == "__main__":
    run_checks((check_orbit, check_multipliers, check_refusals), (check_references, check_cycle))
