#!/usr/bin/env python3
"""Orbits that close, of a small bearing of eight bumps: beams and shells, without and with friction, against the last turn of a march in the
same steps, and against themselves one turn later; multipliers of the rotor's modes.
"""

import cmath

import numpy

from dynamics import beams
from gfb_run import Bearing, case_groups, largest_difference, run_checks, solve
from periodic import orbits
from rotor import modes_of, speed_of
from transient import history, stepped

CLEARANCE = 15.0e-6
SMALL = Bearing(5.85e-3, 12.0e-3, CLEARANCE, 1.95e-5, 1.0135e5)
MASS, STEPS = 0.02, 24


def small_case(analysis, friction=0.0, foil="beam", **keys):
    """Eight bumps under a load, and the keys of the analysis's group."""
    groups = {group: dict(values) for group, values in beams(friction)["groups"].items() if group != "model"}
    groups["bump_foil"]["bumps"] = 8
    content = case_groups(SMALL, (32, 4), foil, load=(-6.0, 0.0), speed_rpm=60000.0, groups=groups | {"rotor": {"mass": MASS}})
    content["scene"]["analysis"] = analysis
    content["dynamics" if analysis == "linear_dynamics" else analysis] = keys
    if analysis == "transient":
        content["solver"] = {"residual_tolerance": 1.0e-11, "step_tolerance": 1.0e-11}
    return content


def check_march(checks, folder, words, turns):
    """The orbit is that which a long march with the same steps ends in; what the march still changes in a turn is left."""
    keys = {"unbalance": 1.0e-8, "steps_per_turn": STEPS}
    answer = solve(folder, "closed", small_case("periodic", **keys))
    found = orbits(answer)
    rows = history(solve(folder, "march", small_case("transient", turns=turns, **keys)))
    checks.that(f"{words}: stable, and no small motion", answer["orbit_stable"] == "true" and found["orbit_x"][0] > 0.1*CLEARANCE)
    for axis in "xy":
        values = rows[f"eccentricity_{axis}"]
        left = largest_difference(values[-STEPS - 1:], values[-2*STEPS - 1:-STEPS], CLEARANCE)
        print(f"{words}, {axis}: the march changes by {left:.1e} of the clearance in its last turn")
        checks.below(f"{words}, {axis}: the last turn of a long march", largest_difference(
            found[f"eccentricity_{axis}"][0], values[-STEPS - 1:], CLEARANCE), 1.0e-7)


def check_modes(checks, folder):
    """Beams without friction: multipliers of a tiny orbit are those of the rotor's modes."""
    unbalance, steps = 1.0e-12, 48
    linear = small_case("linear_dynamics", foil_mass="off")
    omega = speed_of(linear)
    linear["dynamics"]["frequencies"] = (omega,)
    growth, frequency, *_ = modes_of(solve(folder, "linear", linear))
    found = orbits(solve(folder, "tiny", small_case("periodic", unbalance=unbalance, steps_per_turn=steps)))
    rates = [rate for rate in growth + 1j*frequency if rate.imag > 0.0 and rate.real > -0.1*omega]
    for rate in rates:
        multiplier = cmath.exp(stepped(rate, found["period"][0]/steps)*found["period"][0])
        checks.below(f"beams: multiplier of the mode at {rate.imag/omega:.2f} of the speed",
                     min(abs(found["multipliers"][0] - multiplier)), 1.0e-4)
    checks.that("beams: a mode that whirls", len(rates) > 0)


def check_friction(checks, folder):
    """Contacts that rub. Where all slip in a turn there is one orbit, that of the march. Where some always stick there are as many
    as there are slips that they began with: the one found repeats itself in a march of two turns without a break."""
    keys = {"unbalance": 1.0e-8, "steps_per_turn": STEPS}
    slides = orbits(solve(folder, "closed", small_case("periodic", 0.01, "shell", **keys)))
    rows = history(solve(folder, "march", small_case("transient", 0.01, "shell", turns=50, **keys)))
    twice = solve(folder, "twice", small_case("periodic", 0.1, period_turns=2, **keys))
    sticks = orbits(twice)
    other = check_starts(checks, folder, 0.1, (1.0e-4, 1.0e-2), keys)
    check_starts(checks, folder, 0.01, (0.0, 1.0e-8), keys)
    for axis, last_turn in zip("xy", other):
        name = f"eccentricity_{axis}"
        checks.below(f"shells, all contacts slip, {axis}: the last turn of a long march",
                     largest_difference(slides[name][0], rows[name][-STEPS - 1:], CLEARANCE), 1.0e-8)
        checks.below(f"beams, some stick, {axis}: a turn later", largest_difference(
            sticks[name][0][:STEPS + 1], sticks[name][0][-STEPS - 1:], CLEARANCE), 1.0e-8)
        checks.below(f"beams, some stick, {axis}: beside the march's", largest_difference(
            sticks[name][0][:STEPS + 1], last_turn, CLEARANCE), 1.0e-3)
    checks.that("multipliers are not given", "orbit_stable" not in twice.summary and numpy.isnan(sticks["stable"]).all())


def check_starts(checks, folder, friction, limits, keys):
    """Marches let go from the equilibria of two loads: with contacts that stick they end on two steady orbits, with little friction
    on one. The last turn of the first march is returned."""
    words = f"beams, friction {friction}"
    ends = []
    for load in ((-6.0, 0.0), (-6.0, 3.0)):
        rows = history(solve(folder, "start", small_case("transient", friction, turns=40, start_load=load, **keys)))
        values = [rows[f"eccentricity_{axis}"] for axis in "xy"]
        checks.below(f"{words}, let go at {load}: steady", max(largest_difference(
            value[-STEPS - 1:], value[-2*STEPS - 1:-STEPS], CLEARANCE) for value in values), 1.0e-7)
        ends.append([value[-STEPS - 1:] for value in values])
    checks.within(f"{words}: from two starts", max(
        largest_difference(one, other, CLEARANCE) for one, other in zip(*ends)), *limits)
    return ends[0]


def check_march_of_beams(checks, folder):
    """Orbits that close against steps in time, on beams."""
    check_march(checks, folder, "beams", 60)


def main():
    run_checks((check_modes, check_march_of_beams), (check_friction,))


if __name__ == "__main__":
    main()
