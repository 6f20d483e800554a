#!/usr/bin/env python3
"""Steps of order 4 over time (`time_method = 'esdirk4'`): an orbit whose force is known exactly, everything that has a past against
steps of order 2 extrapolated, contacts that rub and open, extents between steps, files and ranks.

Full ring: on a circle of half the speed's frequency the film bears nothing, at any amplitude (transient.py).
"""

import math
import random

import numpy

from dynamics import FOIL_BEARING, RING, beams
from dynamics_mass import heavy
from gfb_run import case_groups, observed_order, run_checks, solve, write_case
from restart import SEED, check_kills, run_time
from rotor import speed_of
from rotor_in_time import conical_case
from transient import TIGHT, foil_case, history, plane, ring_case

CLEARANCE = FOIL_BEARING.clearance
FOUR = {"time_method": "esdirk4"}
MOTION = {"turns": 1.0, "unbalance": 5.0e-7}


def march(folder, content, steps, method=None, **keys):
    """Rows of a case in so many steps a turn."""
    content = {group: dict(values) for group, values in content.items()}
    content["transient"] |= {"steps_per_turn": steps} | (method or {}) | keys
    return history(solve(folder, "march", content))


def places(rows):
    """Where the shaft is at the end, and after parts of a turn where all runs have steps that end there."""
    found = plane(rows, "eccentricity")
    if numpy.ptp(rows["speed"]) > 0.0:
        return found[-1:]
    at = [int(numpy.argmin(abs(rows["turns"] - turn))) for turn in (0.25, 0.5, 0.75, 1.0)]
    return found[at]


def limit_of(folder, content, steps):
    """What steps of order 2 tend to, and how far off those are that are extrapolated."""
    coarse, fine = (places(march(folder, content, number)) for number in (steps, 2*steps))
    return (4.0*fine - coarse)/3.0, abs(fine - coarse).max()


def check_ring(checks, folder):
    """No force at half the speed, but for what the steps leave, which is of order 4."""
    case = ring_case(0.5, 20, 0.4*RING.clearance)
    force = [abs(plane(march(folder, case, steps, FOUR), "force")) for steps in (10, 20)]
    left = [one[-1]/one[0] for one in force] # it begins with the steady film of its first place
    checks.below("ring: force at half the speed, 20 steps", left[1], 1.0e-5)
    checks.within("ring: its order", observed_order(*left), 3.5, 4.6)


def moving():
    """Cases with all that may have a past: damped springs with and without unknowns of their own, arms, tilts, a run-up with a
    pulse, beams with mass and losses."""
    arm = {"foundation_damping": 0.0, "maxwell_stiffness": 2.0e9, "maxwell_time": 1.0e-4}
    for words, model, keys in (("damped springs", {}, {}), ("local springs", {"foundation_pressure": "local"}, {}), ("arms", {}, arm),
                               ("run-up", {}, {"final_speed_rpm": 33000.0})):
        content, _ = foil_case(0.3, (-30.0, 0.0), **(MOTION | keys))
        content["model"] |= model
        yield words, content, 5.0e-5
    content, _ = conical_case(1.5, (-60.0, 0.0), couple_unbalance=2.0e-7, **MOTION)
    yield "tilts", content, 2.0e-4
    for words, friction, limit in (("beams", 0.0, 2.0e-4), ("beams that rub", 0.1, 5.0e-4)):
        content = case_groups(FOIL_BEARING, **(heavy(beams(friction)) | {"load": (-60.0, 0.0)}))
        content.pop("sweep", None)
        content["operation"].pop("eccentricity", None)
        content["scene"]["analysis"] = "transient"
        content["rotor"] = {"mass": 0.8}
        content["transient"] = dict(MOTION)
        content["foil_damping"] = {"foil_mass": "on", "loss_factor": 0.1, "loss_frequency": 3000.0}
        yield words, content, limit


def check_pasts(checks, folder):
    """A turn in 20 steps ends where steps of order 2 tend to."""
    for words, content, most in moving():
        content["solver"] = TIGHT
        wanted, apart = limit_of(folder, content, 200)
        found = march(folder, content, 20, FOUR)
        off = abs(places(found) - wanted).max()
        size = numpy.ptp(found["eccentricity_x"])
        checks.below(f"{words}: 20 steps of order 4 against the limit of order 2, over the orbit", off/size, most)
        checks.that(f"{words}: nearer than 200 of order 2, by {4.0*apart/3.0/off:.0f} times", off < 4.0*apart/3.0)


def check_contacts(checks, folder):
    """Contacts that open, close and rub on a large orbit: 20 steps err less than 200 of order 2, with less iterations."""
    content = rubbing(MOTION | {"unbalance": 3.0e-6})
    wanted, apart = limit_of(folder, content, 800)
    size = numpy.ptp(march(folder, content, 200)["eccentricity_x"])
    off, spent = [], []
    for steps, method in ((20, FOUR), (200, {})):
        rows = march(folder, content, steps, method)
        off.append(abs(places(rows) - wanted).max()/size)
        spent.append(rows["newton_iterations"][-1] - rows["newton_iterations"][0])
    checks.that(f"contacts: the orbit is {size/CLEARANCE:.2f} of the clearance, its limit known to {apart/size:.1e}", size > 0.2*CLEARANCE)
    checks.below("contacts: 20 steps of order 4", off[0], 3.0e-4)
    checks.that(f"contacts: 200 of order 2 err more, {off[1]:.1e}", off[1] > off[0])
    checks.that(f"contacts: iterations {spent[0]:.0f}, and {spent[1]:.0f}", spent[0] < 0.8*spent[1])


def rubbing(transient):
    """A shaft on beams that rub."""
    content = case_groups(FOIL_BEARING, **(beams(0.1) | {"load": (-60.0, 0.0)}))
    content["operation"].pop("eccentricity", None)
    content["scene"]["analysis"] = "transient"
    content["rotor"] = {"mass": 1.5}
    content["transient"] = dict(transient)
    return content


def check_steps(checks, folder):
    """Steps that the error chooses, 20 a turn at least, meet the end of a pulse and where equal ones tend to; few steps have the
    extents of many."""
    mass = 0.3
    content, _ = foil_case(mass, (-60.0, 0.0), turns=1.0)
    omega = speed_of(content)
    content["transient"] |= {"pulse": (0.05*31.8e-6*mass*omega, 0.0), "pulse_length": 1.2*math.pi/omega}
    content["solver"] = TIGHT
    wanted = plane(march(folder, content, 160, FOUR), "eccentricity")[-1]
    for tolerance, most in ((1.0e-5, 1.0e-5), (1.0e-7, 1.0e-6)):
        content["transient"] |= {"time_tolerance": tolerance} | FOUR
        rows = history(solve(folder, "chosen", content))
        checks.below(f"steps by an error of {tolerance:g}, {len(rows['time']) - 1} of them: where the shaft ends",
                     abs(plane(rows, "eccentricity")[-1] - wanted)/31.8e-6, most)
        checks.below("steps by the error: one ends with the pulse",
                     numpy.abs(rows["time"] - content["transient"]["pulse_length"]).min()*omega, 1.0e-9)
    content, _ = foil_case(mass, (-60.0, 0.0), **(MOTION | {"turns": 2.0}))
    orbits = []
    for steps in (10, 80):
        content["transient"] |= {"steps_per_turn": steps} | FOUR
        orbits.append(solve(folder, "extents", content))
    for name in ("orbit_x", "orbit_y"):
        checks.below(f"ten steps a turn: {name}", abs(orbits[0][name]/orbits[1][name] - 1.0), 2.0e-3)


def check_same(checks, folder):
    """Rest stays rest, gas stays in the film, ranks, and a run that goes on from a restart file."""
    content, _ = foil_case(0.3, (-60.0, 0.0), turns=1.0)
    rows = march(folder, content, 20, FOUR)
    checks.below("without a drive nothing moves", numpy.ptp(rows["eccentricity_x"])/31.8e-6, 1.0e-9)
    content = rubbing(MOTION | {"steps_per_turn": 20} | FOUR)
    content["solver"] = TIGHT
    one, two = (history(solve(folder, "ranks", content, ranks)) for ranks in (1, 2))
    checks.below("two ranks: positions", numpy.abs(plane(one, "eccentricity") - plane(two, "eccentricity")).max()/CLEARANCE, 1.0e-7)
    content["transient"]["foil_mass"] = "off"
    content["output"] = {"restart_every": 7}
    whole = solve(folder, "restart", content)
    checks.below("files on the way: the same orbit", abs(plane(history(whole), "eccentricity")[-1] - plane(one, "eccentricity")[-1])/CLEARANCE, 1.0e-5)


def check_stops(checks, folder):
    """Beams that rub, with mass and losses, go on with the same digits after they were killed. On other ranks digits differ: the first
    rates behind a file are differences over a short step, which show what rounding leaves 1e4 times."""
    *_, (_, content, _) = moving()
    content["transient"] |= {"steps_per_turn": 20, "turns": 4.0} | FOUR
    content["solver"] = TIGHT
    content["output"] = {"restart_every": 5}
    whole = run_time(write_case(folder, "stopped", content), folder/"whole")
    check_kills(checks, folder, "stopped", content, random.Random(SEED), (1, 1, 1, 1), whole)


def main():
    run_checks((check_ring, check_pasts, check_contacts, check_steps, check_same), (check_stops,))


if __name__ == "__main__":
    main()
