#!/usr/bin/env python3
"""Orbits that close after a period: the orbit that a long march ends in, the linear theory of small motions, the modes of the
rotor, the onset of whirl, what must not matter; with --long the size from which a stable bearing is thrown out. An
independent program's orbits: orbits.py.
"""

import cmath
import math
import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, largest_difference, solve
from rotor import modes_of, speed_of
from transient import foil_case, history, stepped

CLEARANCE = 31.8e-6
UNBALANCE = 1.0e-9  # of a tiny orbit [kg m]
RIGID = {"foil": "rigid"}
ARM = {"maxwell_stiffness": 3.0e9, "maxwell_time": 1.0e-4}
LOCAL = {"foundation_pressure": "local"}  # springs whose deflections are no unknowns, but with dampers part of a state


def orbits(answer):
    """All rows of the orbits, one array a name."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        rows = {name: values[...] for name, values in file["periodic"].items()}
    rows["multipliers"] = rows.pop("multipliers_real") + 1j*rows.pop("multipliers_imaginary")
    return rows


def periodic_case(mass, load, keys, name="PT2", mesh=(32, 4), model=None):
    """A rotor on damped springs, or a rigid pad, on orbits that close, and the linear case beside it."""
    model = model or {}
    content, linear = foil_case(mass, load, mesh, name)
    content["scene"]["analysis"] = "periodic"
    content["periodic"] = content.pop("transient") | keys
    for one in (content, linear):
        one["model"] |= model
    if model == RIGID:
        for one in (content, linear):
            del one["model"]["foundation_stiffness"], one["model"]["foundation_pressure"]
        del content["periodic"]["foundation_damping"], linear["dynamics"]["foundation_damping"]
    return content, linear


def check_march(checks, folder):
    """The orbit under a large unbalance is that which a long march with the same steps ends in."""
    steps, turns = 40, 60
    for words, mass, load, unbalance, model, arm in (("forced orbit", 0.3, -60.0, 3.0e-6, {}, {}),
                                                     ("forced orbit, Maxwell arms", 0.3, -60.0, 3.0e-6, {}, ARM),
                                                     ("forced orbit, local springs", 0.1, -20.0, 1.0e-6, LOCAL, {}),
                                                     ("forced orbit, local springs, Maxwell arms", 0.1, -20.0, 1.0e-6, LOCAL, ARM)):
        keys = {"unbalance": unbalance, "unbalance_angle": 0.3, "steps_per_turn": steps, **arm}
        content, _ = periodic_case(mass, (load, 0.0), keys, model=model)
        answer = solve(folder, "closed", content)
        found = orbits(answer)
        checks.that(f"{words}: stable", answer["orbit_stable"] == "true" and abs(found["multipliers"]).max() < 1.0)
        march, _ = foil_case(mass, (load, 0.0), turns=turns, **keys)
        march["model"] |= model
        march["solver"] = {"residual_tolerance": 1.0e-11, "step_tolerance": 1.0e-11}
        rows = history(solve(folder, "march", march))
        for axis in "xy":
            checks.below(f"{words}, {axis}: the last turn of a long march", largest_difference(
                found[f"eccentricity_{axis}"][0], rows[f"eccentricity_{axis}"][-steps - 1:], CLEARANCE), 1.0e-7)
        checks.that(f"{words}: large", found["orbit_x"][0] > 0.1*CLEARANCE)
    for words, arm in (("local springs", {}), ("local springs, Maxwell arms", ARM)):
        content, _ = periodic_case(0.1, (-20.0, 0.0), {"unbalance": 2.0e-7, "steps_per_turn": 24, **arm}, mesh=(16, 2), model=LOCAL)
        one, two = (orbits(solve(folder, "ranks", content, ranks)) for ranks in (1, 2))
        checks.below(f"{words}: two ranks", largest_difference(one["eccentricity_x"], two["eccentricity_x"], CLEARANCE), 1.0e-7)
        checks.below(f"{words}: two ranks, multipliers", largest_difference(one["multipliers"], two["multipliers"], 1.0), 1.0e-4)


def check_small(checks, folder):
    """A tiny orbit: first harmonic of the linear theory, multipliers of the rotor's modes."""
    for words, model in (("foundation", {}), ("local springs", LOCAL), ("rigid pad", RIGID)):
        harmonics = []
        for steps in (60, 120):
            content, linear = periodic_case(0.1, (-20.0, 0.0), {"unbalance": UNBALANCE, "steps_per_turn": steps}, model=model)
            found = orbits(solve(folder, "tiny", content))
            first = numpy.exp(-2j*math.pi*numpy.arange(steps)/steps)*2.0/steps
            harmonics.append(numpy.array([first @ found[f"eccentricity_{axis}"][0, :-1] for axis in "xy"]))
        omega = speed_of(content)
        linear["dynamics"]["frequencies"] = (omega,)
        answer = solve(folder, "linear", linear)
        with h5py.File(f"{answer.stem}.h5", "r") as file:
            stiffness, damping = (file[f"dynamics/{name}"][0, :2, :2] for name in ("stiffness", "damping"))
        wanted = -numpy.linalg.solve(stiffness + 1j*omega*damping - 0.1*omega**2*numpy.eye(2),
                                     UNBALANCE*omega**2*numpy.array([1.0, -1.0j]))
        size = numpy.linalg.norm(wanted)
        errors = [numpy.linalg.norm(one - wanted)/size for one in harmonics]
        checks.within(f"{words}: order of the first harmonic", math.log2(errors[0]/errors[1]), 1.8, 2.2)
        checks.below(f"{words}: first harmonic of the linear theory",
                     numpy.linalg.norm((4.0*harmonics[1] - harmonics[0])/3.0 - wanted)/size, 1.0e-4)
        growth, frequency, *_ = modes_of(answer)
        slow = [rate for rate in growth + 1j*frequency if rate.imag >= 0.0 and rate.real > -0.25*omega]
        step, period = found["period"][0]/120, found["period"][0]
        for rate in slow:
            multiplier = cmath.exp(stepped(rate, step)*period)
            checks.below(f"{words}: multiplier of the mode at {rate.imag/omega:.2f} of the speed",
                         min(abs(found["multipliers"][0] - multiplier)), 1.0e-4)
        checks.that(f"{words}: a mode that whirls", any(rate.imag > 0.0 for rate in slow))


def check_onset(checks, folder):
    """Limit cycles begin where the linear theory's whirl neither grows nor decays; the square of their size is then linear."""
    for words, model, arm in (("springs", {}, {}), ("Maxwell arms", {}, ARM), ("local springs, Maxwell arms", LOCAL, ARM)):
        keys = {"motion": "free", "parameter": "mass", "steps_per_turn": 40, "points": 5, "step": 0.06, **arm}
        content, linear = periodic_case(0.25, (-20.0, 0.0), keys, model=model)
        linear["dynamics"] |= arm
        critical = solve(folder, "critical", linear)["critical_mass"]
        content["rotor"]["mass"], content["periodic"]["final_value"] = 0.93*critical, 1.2*critical
        answer = solve(folder, "branch", content)
        found = orbits(answer)
        rates = []
        for mass in (0.99*critical, 1.01*critical):
            linear["rotor"]["mass"] = mass
            modes = solve(folder, "mode", linear)
            rates.append(complex(modes["growth_rate"], modes["whirl_frequency"]))
        # Growth that the steps take from a whirl: the rate of which a mode of constant size is made.
        step = found["period"][0]/(len(found["eccentricity_x"][0]) - 1)
        z = cmath.exp(1j*0.5*(rates[0] + rates[1]).imag*step)
        taken = ((3.0 - 4.0/z + 1.0/z**2)/(2.0*step)).real
        wanted = critical + taken*0.02*critical/(rates[1] - rates[0]).real
        checks.below(f"onset, {words}: critical mass, with what the steps take", answer["critical_mass"]/wanted - 1.0, 2.0e-5)
        checks.below(f"onset, {words}: frequency", found["frequency_ratio"][0]*speed_of(content)/rates[0].imag - 1.0, 5.0e-3)
        checks.below(f"onset, {words}: the whirl's multipliers are 1", numpy.abs(found["multipliers"][0, :2] - 1.0).max(), 2.0e-5)
        squares = (found["orbit_x"][1:4]/CLEARANCE)**2
        begin = numpy.polyfit(squares, found["mass"][1:4], 2)
        checks.below(f"branch, {words}: where its size goes to zero", begin[2]/wanted - 1.0, 1.0e-5)
        checks.below(f"branch, {words}: the square of its size is linear there", begin[0]*squares[0]/begin[1], 2.0e-2)
        checks.that(f"branch, {words}: supercritical and stable", answer["subcritical"] == "false" and bool(found["stable"][1:].all()))
        checks.below(f"branch, {words}: the multiplier of a shift is 1", numpy.abs(found["multipliers"] - 1.0).min(axis=1).max(), 1.0e-5)


def check_branch(checks, folder):
    """Over the unbalance: the branch's end is the orbit by itself; ranks."""
    keys = {"unbalance": 2.0e-7, "steps_per_turn": 30, "parameter": "unbalance", "final_value": 2.0e-6, "step": 0.5}
    content, _ = periodic_case(0.3, (-60.0, 0.0), keys)
    one, two = (orbits(solve(folder, "branch", content, ranks)) for ranks in (1, 2))
    for name in ("eccentricity_x", "orbit_y"):
        checks.below(f"two ranks: {name}", largest_difference(one[name], two[name], CLEARANCE), 1.0e-7)
    checks.below("two ranks: multipliers", largest_difference(one["multipliers"], two["multipliers"], 1.0), 1.0e-4)
    content["periodic"] = {key: value for key, value in keys.items() if key not in ("parameter", "final_value", "step")}
    content["periodic"] |= {"unbalance": 2.0e-6, "foundation_damping": 3.0e5}
    alone = orbits(solve(folder, "alone", content))
    checks.below("the end of a branch is the orbit by itself", largest_difference(
        one["eccentricity_x"][-1], alone["eccentricity_x"][0], CLEARANCE), 1.0e-7)
    checks.below("the branch ends at the value asked for", one["unbalance"][-1]/2.0e-6 - 1.0, 1.0e-9)


def check_threshold(checks, folder):
    """A push throws the shaft out where it takes it beyond the unstable limit cycle: on the way between it stays there long."""
    speed, mass, load, steps, mesh = 12860.0, 2.0, (-19.62, 0.0), 40, (32, 4)
    keys = {"motion": "free", "parameter": "speed_rpm", "final_value": speed, "steps_per_turn": steps, "step": 0.5}
    content, _ = periodic_case(mass, load, keys, mesh=mesh)
    content["operation"]["speed_rpm"] = 13100.0
    answer = solve(folder, "unstable", content)
    cycle = orbits(answer)
    checks.that("limit cycles below the onset: subcritical and unstable",
                answer["subcritical"] == "true" and not cycle["stable"][1:].any())
    turns, low, high, plateau = 60, 0.0, 2.0, None
    omega = speed*math.pi/30.0
    for _ in range(9):
        share = 0.5*(low + high)
        march, _ = foil_case(mass, load, mesh, "PT2", turns=turns, steps_per_turn=steps)
        march["operation"]["speed_rpm"] = speed
        march["transient"] |= {"pulse": (share*CLEARANCE*mass*0.43*omega, 0.0), "pulse_length": 2.0*math.pi/omega}
        rows = history(solve(folder, "push", march))
        size = [numpy.ptp(rows["eccentricity_x"][(rows["turns"] > end - 5.0) & (rows["turns"] <= end)])
                for end in range(10, int(rows["turns"][-1]) + 1, 2)]
        grows = rows["turns"][-1] < turns - 0.5 or size[-1] > cycle["orbit_x"][-1]
        low, high = (low, share) if grows else (share, high)
        change = numpy.abs(numpy.diff(size))
        plateau = size[int(numpy.argmin(change[:len(change)*2//3 + 1]))]
    checks.that("push: some are thrown out, some come back", 0.0 < low and high < 2.0)
    checks.below("push: between them the shaft stays on the unstable cycle", plateau/cycle["orbit_x"][-1] - 1.0, 5.0e-2)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        if "--long" in sys.argv:
            check_threshold(checks, folder)
        else:
            check_march(checks, folder)
            check_small(checks, folder)
            check_onset(checks, folder)
            check_branch(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
