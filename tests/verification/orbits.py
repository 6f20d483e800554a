#!/usr/bin/env python3
"""Orbits of an independent program (reference/orbits.json): spectral elements, harmonic balance, the exact limit of fine meshes
and steps, each with the error it states.

gfb's orbits have the error of N equal steps a turn, which begins with N^-2, and that of biquadratic elements of the size h, which
begins with h^4. Both are taken away by polynomials: over the steps on each mesh, and over four meshes (--long, with the names of the
orbits). The finer a mesh, the fewer steps are solved on it: from the second on the change from the next coarser mesh is extrapolated
over these.
"""

import sys
import tempfile

import numpy

from gfb_run import Checks, solve
from periodic import CLEARANCE, orbits, periodic_case
from transient import ORBITS

MESHES = ((30, 4), (60, 8), (120, 16), (240, 32))
MANY = (24, 32, 48, 64, 96, 128, 192)         # steps a turn
FEW = MANY[:3]
STEPS = (MANY, MANY[:5], MANY[:4], MANY[:2])  # on each mesh
MEAN, FIRST, SECOND = range(3)


def weights(sizes, powers):
    """Of answers at some sizes in their limit at size 0, with errors of these powers."""
    return numpy.linalg.inv([[1.0, *(size**power for power in powers)] for size in sizes])[0]


def harmonics(folder, name, mesh, steps):
    """Mean and two harmonics of the orbit that closes, x and y [m]."""
    one = ORBITS[name]["operation"]
    content, _ = periodic_case(one["mass"], one["load"], {"unbalance": one["unbalance_kg_m"], "steps_per_turn": steps}, name, mesh)
    answer = orbits(solve(folder, "orbit", content))
    place = numpy.array([answer[f"eccentricity_{axis}"][0, :-1] for axis in "xy"])
    wave = numpy.exp(-2j*numpy.pi*numpy.outer(numpy.arange(steps), range(3))/steps)
    return (place @ wave).T*numpy.array([[1.0], [2.0], [2.0]])/steps


def without_steps(found, many):
    """The limit of short steps."""
    share = weights([many[0]/steps for steps in many], range(2, len(many) + 1))
    return sum(one*found[steps] for one, steps in zip(share, many))


def distances(name, found):
    """From the reference: of the mean over the clearance, of each harmonic over its size."""
    wanted = ORBITS[name]["result"]
    mean = numpy.linalg.norm(found[MEAN].real - wanted["mean"])/CLEARANCE
    rest = [numpy.array([complex(*part) for part in wanted[f"harmonic_{number}"]]) for number in (FIRST, SECOND)]
    return [mean] + [numpy.linalg.norm(found[number] - one)/numpy.linalg.norm(one) for number, one in zip((FIRST, SECOND), rest)]


def stated(name):
    """The errors of these that the reference states."""
    error = ORBITS[name]["error"]
    return [error["mean"]/CLEARANCE, error["harmonic_1"], error["harmonic_2"]]


def check_coarse(checks, folder):
    """A small orbit on a coarse mesh: the limit of its steps is there but for the mesh."""
    found = {steps: harmonics(folder, "PT1", MESHES[0], steps) for steps in FEW}
    whole, two = (distances("PT1", without_steps(found, many)) for many in (FEW, FEW[:2]))
    for words, number, bound in (("centre over the clearance", MEAN, 1.0e-3), ("first harmonic", FIRST, 6.0e-4),
                                 ("second harmonic", SECOND, 2.0e-2)):
        checks.below(f"PT1, {MESHES[0][0]} x {MESHES[0][1]} elements, steps extrapolated: {words}", whole[number], bound)
    checks.that("PT1: more steps bring it nearer", whole[FIRST] < 0.3*two[FIRST])


def check_fine(checks, folder, name):
    """The limit of steps and meshes."""
    found = [{steps: harmonics(folder, name, mesh, steps) for steps in many} for mesh, many in zip(MESHES, STEPS)]
    limits = [without_steps(found[0], MANY)]
    for coarse, fine, many in zip(found, found[1:], STEPS[1:]):
        limits.append(limits[-1] + without_steps(fine, many) - without_steps(coarse, many))
    limit = sum(share*one for share, one in zip(weights([8.0, 4.0, 2.0, 1.0], (4, 5, 6)), limits))
    for words, number in (("centre", MEAN), ("first harmonic", FIRST), ("second harmonic", SECOND)):
        changes = [numpy.linalg.norm(limits[i][number] - limits[i + 1][number]) for i in range(3)]
        orders = [numpy.log2(changes[i]/changes[i + 1]) for i in (0, 1)]
        checks.within(f"{name}, {words}: order in the mesh, from {orders[0]:.2f} on", orders[1], max(orders[0], 3.4), 4.2)
        checks.below(f"{name}, {words}: limit of meshes and steps from the reference, over the error that it states",
                     distances(name, limit)[number]/stated(name)[number], 1.0)


def check_limit_cycle(checks, folder):
    """A limit cycle, its size and frequency within the errors that the reference states; few steps lead there from the onset."""
    one, found = ORBITS["PT2"], []
    steps = (50, 100)
    for number in steps:
        content, _ = periodic_case(0.26, one["operation"]["load"], {
            "motion": "free", "parameter": "mass", "final_value": one["operation"]["mass"], "steps_per_turn": number,
            "first_amplitude": 0.1, "step": 2.0}, mesh=(60, 8))
        rows = orbits(solve(folder, "cycle", content))
        found.append([rows[name][-1] for name in ("orbit_x", "orbit_y", "frequency_ratio")])
    limit = weights([steps[0]/number for number in steps], (2,)) @ numpy.array(found)
    error = [*one["error"]["limit_peak_to_peak"], one["error"]["frequency_over_Omega"]]
    wanted = [*one["result"]["limit_peak_to_peak"], one["result"]["frequency_over_Omega"]]
    for words, value, other, stated in zip(("size in x", "size in y", "frequency"), limit, wanted, error):
        checks.below(f"PT2, {words}: distance from the reference over the error that it states", (value - other)/stated, 1.0)


def check_foil(checks, folder):
    """A branch that comes to the foil before its end has not reached what it was asked for; its orbits are kept."""
    content, _ = periodic_case(0.3, (-60.0, 0.0), {"unbalance": 1.0e-6, "steps_per_turn": 24, "parameter": "unbalance",
                                                   "final_value": 9.4e-6, "step": 0.2}, mesh=(24, 3))
    content["solver"] = {"touch_down_gap": 5.0e-6}
    answer = solve(folder, "foil", content, status=2)
    checks.that("to the foil: not reached", answer["ending"] == "the shaft touches down" and answer["converged"] == "false"
                and answer["not_reached"] == "unbalance 9.4e-6 kg m" and "not reached: unbalance 9.4e-6 kg m: the shaft" in answer.log)
    gap = orbits(answer)["minimum_gap"]
    checks.that(f"to the foil: {len(gap)} orbits, the last with a film of {gap[-1]*1.0e6:.2f} um", len(gap) > 1 and gap[-1] > 5.0e-6)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        if "--long" in sys.argv:
            for name in [name for name in ("PT1", "PT3") if name in sys.argv]:
                check_fine(checks, folder, name)
            if "PT2" in sys.argv:
                check_limit_cycle(checks, folder)
                check_foil(checks, folder)
        else:
            check_coarse(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
