#!/usr/bin/env python3
"""A Maxwell arm beside the springs of an elastic foundation: k_m lambda tau/(1 + lambda tau) of closed forms, its limits,
the rotor's modes, a small orbit over time, and what must not matter.
"""

import math
import pathlib
import random

import numpy

from dynamics import RING, SPRINGS, block_error, concentric, vibrate
from gfb_run import Bearing, case_groups, observed_order, run_checks, solve, write_case
from restart import bearing, check_kills, run_time
from rotor import modes_of, nearest_root, ring_matrix, speed_of
from transient import ORDER, TIGHT, foil_case, history, modes_in, plane

SPRING = SPRINGS["foundation_stiffness"]
OMEGA = RING.speed_rpm(3.0)*math.pi/30.0
ARM = {"maxwell_stiffness": 1.5*SPRING, "maxwell_time": 0.8/OMEGA}
PRESSURES = ("local", "axial_mean")


def arm_stiffness(rate):
    """What the arm adds to the springs under motions exp(rate t)."""
    turn = rate*ARM["maxwell_time"]
    return ARM["maxwell_stiffness"]*turn/(1.0 + turn)


def foundation(pressure, **model):
    """Groups of a case on springs."""
    return {"foil": "elastic_foundation", "groups": {"model": {"foundation_pressure": pressure, **SPRINGS, **model}}}


def check_ring(checks, folder):
    """The closed form of a concentric ring with k(w) for its stiffness, beside a loss factor and dampers."""
    damping = 0.2*SPRING/OMEGA
    case = {"mesh": (48, 16), "number": 3.0, "eccentricity": (0.0, 0.0), **foundation("local", film_order=2)}
    for words, loss, viscous in (("alone", 0.0, 0.0), ("with losses", 0.3, damping)):
        keys = {"frequency_ratios": (0.3, 1.0, 3.0), **ARM} | ({"loss_factor": loss, "foundation_damping": viscous} if loss else {})
        _, frequency, found = vibrate(folder, "ring", RING, keys, **case)
        wanted = numpy.array([concentric(RING, OMEGA, w, SPRING*(1.0 + 1j*loss) + 1j*w*viscous + arm_stiffness(1j*w), 0.0)
                              for w in frequency])
        bare = numpy.array([concentric(RING, OMEGA, w, SPRING, loss) for w in frequency])
        checks.below(f"concentric ring, arm {words}: translation", block_error(found, wanted, [(0, 0)]), 1.0e-4)
        checks.below(f"concentric ring, arm {words}: tilts", block_error(found, wanted, [(1, 1)]), 5.0e-4)
        checks.that(f"concentric ring, arm {words}: it counts", block_error(bare, wanted, [(0, 0)]) > 0.05)


def check_limits(checks, folder):
    """A short time is a damper, a long one a spring more; the steady film knows of neither."""
    case = {"mesh": (32, 6), "number": 2.0, "eccentricity": (0.4*RING.clearance, 0.2*RING.clearance)}
    ratios = {"frequency_ratios": (0.3, 1.0)}
    viscous = 0.3*SPRING/OMEGA
    for pressure in PRESSURES:
        springs = foundation(pressure)
        plain, _, _ = vibrate(folder, "plain", Bearing(), ratios, **case, **springs)
        damped, _, wanted = vibrate(folder, "damped", Bearing(), {**ratios, "foundation_damping": viscous}, **case, **springs)
        answer, _, found = vibrate(folder, "short", Bearing(),
                                   {**ratios, "maxwell_stiffness": viscous*1.0e14, "maxwell_time": 1.0e-14}, **case, **springs)
        checks.below(f"{pressure}: a short relaxation time is a damper", block_error(found, wanted, [(0, 0), (1, 1)]), 1.0e-9)
        # Where the steady film does not press, stiffer springs have the same one.
        ring = {**case, "eccentricity": (0.0, 0.0)}
        _, _, found = vibrate(folder, "long", RING, {**ratios, "maxwell_stiffness": 0.3*SPRING, "maxwell_time": 1.0e8},
                              **ring, **springs)
        _, _, wanted = vibrate(folder, "stiff", RING, ratios, **ring, **foundation(pressure, foundation_stiffness=1.3*SPRING))
        checks.below(f"{pressure}: a long one is a spring", block_error(found, wanted, [(0, 0), (1, 1)]), 1.0e-9)
        checks.that(f"{pressure}: the steady film is the same to the last digit",
                    all(plain[key] == damped[key] == answer[key] for key in ("force_x", "force_y", "minimum_gap")))


def check_modes(checks, folder):
    """Modes of a rotor on concentric rings, both kinds, against the closed form at their complex rates."""
    rotor = {"mass": 0.2, "transverse_inertia": 6.0e-4, "polar_inertia": 1.0e-4, "bearing_distance": 0.12}
    content = case_groups(RING, mesh=(48, 16), number=3.0, eccentricity=(0.0, 0.0), **foundation("local", film_order=2))
    content["scene"]["analysis"] = "linear_dynamics"
    content["dynamics"] = {"frequency_ratios": (0.5,), **ARM}
    content["rotor"] = rotor
    growth, frequency, share, kind, _ = modes_of(solve(folder, "modes", content))
    worst, count = 0.0, {1: 0, 2: 0}
    for one in numpy.flatnonzero((share > 0.02) & (frequency > 0.0) & (growth > -OMEGA)):
        found = growth[one] + 1j*frequency[one]
        wanted = nearest_root(lambda rate, k=int(kind[one]): numpy.linalg.det(
            ring_matrix(rotor, OMEGA, rate, SPRING + arm_stiffness(rate), 0.0)[k]), found)
        worst = max(worst, abs(found - wanted)/abs(wanted))
        count[int(kind[one])] += 1
    checks.below(f"ring: {count[1]} cylindrical and {count[2]} conical modes, closed form", worst, 3.0e-4)
    checks.that("ring: modes of both kinds", min(count.values()) >= 1)


def loaded(pressure, mass):
    """A rotor under a load on springs with the arm, under vibration."""
    content = case_groups(Bearing(), mesh=(32, 6), load=(-40.0, 0.0), speed_rpm=30000.0, **foundation(pressure))
    content["scene"]["analysis"] = "linear_dynamics"
    content["dynamics"] = {"frequency_ratios": (0.5,), "maxwell_stiffness": SPRING, "maxwell_time": 2.0e-4}
    content["rotor"] = {"mass": mass}
    return content


def check_threshold(checks, folder):
    """At the critical mass no mode grows."""
    for pressure in PRESSURES:
        content = loaded(pressure, 1.0)
        first = solve(folder, "threshold", content)
        content["rotor"]["mass"] = first["critical_mass"]
        answer = solve(folder, "threshold", content)
        checks.below(f"{pressure}: no growth at the critical mass", answer["growth_rate"]/speed_of(content), 1.0e-8)
        checks.below(f"{pressure}: whirl frequency there",
                     answer["whirl_frequency"]/speed_of(content)/answer["whirl_ratio"] - 1.0, 1.0e-8)


def check_orbit(checks, folder):
    """A small circle at a given frequency, its start forgotten after six turns: the force of the linear theory, of order 2 in the step."""
    radius, ratio = 1.0e-4*RING.clearance, 0.7
    for pressure in PRESSURES:
        case = {"mesh": (32, 4), "number": 3.0, "eccentricity": (0.0, 0.0), **foundation(pressure, film_order=2)}
        _, _, found = vibrate(folder, "linear", RING, {"frequency_ratios": (ratio,), **ARM}, **case)
        wanted = -(found[0, 0, 0] - 1j*found[0, 0, 1])
        forces = []
        for steps in (40, 80, 160):
            content = case_groups(RING, **case)
            content["scene"]["analysis"] = "transient"
            content["solver"] = TIGHT
            content["transient"] = {"turns": 6, "steps_per_turn": steps, "orbit_radius": radius, "orbit_frequency": ratio*OMEGA, **ARM}
            rows = history(solve(folder, "orbit", content))
            forces.append(plane(rows, "force")[-1]/plane(rows, "eccentricity")[-1])
        errors = [abs(one - wanted)/abs(wanted) for one in forces]
        checks.within(f"{pressure}: orbit, order of the steps", observed_order(*errors[1:]), *ORDER)
        checks.below(f"{pressure}: orbit, force of the linear theory", abs((4.0*forces[2] - forces[1])/3.0 - wanted)/abs(wanted), 1.0e-4)


def check_growth(checks, folder):
    """A pushed shaft above its critical mass: growth and frequency of the rotor's mode; steps by the error end where equal ones tend to."""
    arm = {"maxwell_stiffness": 3.0e9, "maxwell_time": 1.0e-4}
    for pressure in PRESSURES:
        content, linear = foil_case(0.3, (-20.0, 0.0), name="PT2", turns=10, steps_per_turn=60)
        for one in (content, linear):
            one["model"]["foundation_pressure"] = pressure
        content["transient"] = {"turns": 10, "steps_per_turn": 60, **arm}
        linear["dynamics"] = {"frequency_ratios": (0.5,), **arm}
        omega = speed_of(content)
        mass = 1.1*solve(folder, "critical", linear)["critical_mass"]
        linear["rotor"]["mass"] = content["rotor"]["mass"] = mass
        answer = solve(folder, "mode", linear)
        content["transient"] |= {"pulse": (1.0e-4*31.8e-6*mass*0.5*omega, 0.0), "pulse_length": 2.0*math.pi/omega}
        found = modes_in(history(solve(folder, "growth", content)), 4.0)[0]/omega
        checks.below(f"{pressure}: push, growth over the speed", found.real - answer["growth_rate"]/omega, 2.0e-5)
        checks.below(f"{pressure}: push, frequency over the speed", found.imag - answer["whirl_frequency"]/omega, 2.0e-5)
        ends = []
        for keys in ({"time_tolerance": 1.0e-7}, {"steps_per_turn": 120}, {"steps_per_turn": 240}):
            content["transient"] = {"turns": 1, **arm, **keys, "pulse_length": 1.2*math.pi/omega,
                                    "pulse": (0.05*31.8e-6*mass*omega, 0.0)}
            ends.append(plane(history(solve(folder, "steps", content)), "eccentricity")[-1])
        checks.below(f"{pressure}: steps by the error, where the shaft ends", abs(ends[0] - (4.0*ends[2] - ends[1])/3.0)/31.8e-6, 2.0e-5)


def in_time(pressure, **drive):
    """A rotor with an unbalance on springs with the arm and dampers."""
    content = bearing("elastic_foundation", {}, every=15, scene={"analysis": "transient"}, rotor={"mass": 0.3},
                      operation={"load": (-20.0, 0.0)}, mesh={"circumferential_elements": 48, "axial_elements": 6},
                      model={"foundation_pressure": pressure, "foundation_stiffness": 4.8243e9},
                      transient={"turns": 2.0, "steps_per_turn": 60, "unbalance": 1.5e-6, "foundation_damping": 1.0e5,
                                 "maxwell_stiffness": 3.0e9, "maxwell_time": 1.0e-4, **drive})
    return {group: keys for group, keys in content.items() if group != "sweep"}


def check_same(checks, folder):
    """Rest stays rest, ranks, and files of a run that was killed."""
    chance = random.Random(7)
    for pressure in PRESSURES:
        rows = history(solve(folder, "rest", in_time(pressure, unbalance=0.0)))
        checks.below(f"{pressure}: without a drive nothing moves", numpy.ptp(rows["eccentricity_x"])/31.8e-6, 1.0e-9)
        one, two = (history(solve(folder, "ranks", in_time(pressure), ranks)) for ranks in (1, 2))
        checks.below(f"{pressure}: two ranks", numpy.abs(plane(one, "eccentricity") - plane(two, "eccentricity")).max()/31.8e-6, 1.0e-8)
        checks.that(f"{pressure}: the shaft moves", numpy.ptp(one["eccentricity_x"]) > 1.0e-7)
        content = in_time(pressure)
        whole = run_time(write_case(folder, f"killed_{pressure}", content), pathlib.Path(folder)/"whole")
        check_kills(checks, folder, f"killed_{pressure}", content, chance, whole=whole)


def main():
    """All checks."""
    run_checks((check_ring, check_limits, check_modes, check_threshold, check_orbit), (check_growth, check_same))


if __name__ == "__main__":
    main()
