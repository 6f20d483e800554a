#!/usr/bin/env python3
"""Mass of foils over time: the force of the linear theory on a small orbit, condensed shells with modes inside and full
ones, two bearings, ranks, runs that are stopped. With --long shells and stops alone.

Small orbits are tiny against the gaps of open contacts, and without friction: the foils are linear then. What rings on from
the sleeve's sudden start dies out slowly, so the harmonic is read through a window.
"""


import numpy

from dynamics import FOIL_BEARING, beams, vibrate
from dynamics_foils import shells
from dynamics_mass import heavy
from gfb_run import case_groups, largest_difference, run_checks, solve
from restart import check_march
from rotor import speed_of
from transient import TIGHT, history, plane

CLEARANCE = FOIL_BEARING.clearance
FREE = ("tilt", "eccentricity")
SHORT = {"turns": 0.5, "steps_per_turn": 60, "unbalance": 2.0e-6}


def in_time(case, **transient):
    """The case over time, solved to the last digits."""
    content = case_groups(FOIL_BEARING, **case)
    content["scene"]["analysis"] = "transient"
    content["solver"] = TIGHT
    content["transient"] = transient
    return content


def rotor_in_time(case, mass=0.8, **transient):
    """A shaft of some mass on the bearing, with an unbalance that moves it far."""
    free = {key: value for key, value in case.items() if key not in FREE}
    content = in_time(free | {"load": (-60.0, 0.0)}, **SHORT, **transient)
    content["rotor"] = {"mass": mass}
    return content


def orbit(rows):
    """Positions of the shaft over the clearance."""
    return plane(rows, "eccentricity")/CLEARANCE


def harmonic(rows, frequency, turns):
    """The force of a frequency over the last turns, x and y, by a Blackman window."""
    kept = rows["turns"] > rows["turns"][-1] - turns + 1.0e-9
    window = numpy.blackman(numpy.count_nonzero(kept) + 1)[:-1]*numpy.exp(-1j*frequency*rows["time"][kept])
    return numpy.array([2.0*(window*rows[f"force_{axis}"][kept]).sum()/numpy.abs(window).sum() for axis in "xy"])


def check_force(checks, folder):
    """The force on a small circular orbit is that of stiffness and damping with mass, and not that without."""
    ratio, radius = 1.5, 1.0e-5*CLEARANCE
    case = heavy(beams(0.0))
    frequency = ratio*speed_of(case_groups(FOIL_BEARING, **case))
    wanted = {}
    for mass in ("on", "off"):
        _, _, found = vibrate(folder, "linear", FOIL_BEARING, {"frequencies": (frequency,), "foil_mass": mass}, **case)
        wanted[mass] = -found[0, :2, :2] @ numpy.array([radius, -1j*radius])
    found = []
    for steps in (60, 120):
        rows = history(solve(folder, "orbit", in_time(case, turns=14, steps_per_turn=steps, orbit_radius=radius,
                                                      orbit_frequency=frequency, foil_mass="on")))
        found.append(harmonic(rows, frequency, 10.0))
    size = numpy.linalg.norm(wanted["on"])
    checks.that("small orbit: the mass is felt", numpy.linalg.norm(wanted["on"] - wanted["off"])/size > 5.0e-3)
    checks.below("small orbit: force of the linear theory with mass",
                 numpy.linalg.norm((4.0*found[1] - found[0])/3.0 - wanted["on"])/size, 5.0e-5)


def check_shells(checks, folder):
    """Shells that rub, on a large orbit: half the width is the whole one, condensed bumps have the mass of full ones, and
    with modes inside their motion."""
    found = {}
    for words, mass, model in (("half", {}, {}), ("whole", {}, {"half_width": "no"}), ("full", {}, {"reduction": "none"}),
                               ("off", {"foil_mass": "off"}, {}), ("modes", {"foil_modes": 12}, {}), ("none", {"foil_modes": 0}, {})):
        case = heavy(shells(0.1, **({"reduction": "guyan", "half_width": "yes"} | model)))
        answer = solve(folder, words, rotor_in_time(case, **({"foil_mass": "on"} | mass)))
        found[words] = orbit(history(answer))
    effect = largest_difference(found["off"], found["half"], 1.0)
    checks.that("shells: a large orbit, on which the mass is felt", numpy.ptp(found["half"].real) > 0.05 and effect > 1.0e-4)
    checks.below("shells: half and whole width", largest_difference(found["half"], found["whole"], 1.0), 1.0e-8)
    off = {words: largest_difference(found[words], found["full"], effect) for words in ("none", "half", "modes")}
    checks.below("shells: condensed and full bumps, over what the mass changes, two modes", off["half"], 1.0e-5)
    checks.below("shells: the same, twelve modes", off["modes"], 1.0e-7)
    checks.that(f"shells: the same, none: {off['none']:.1e}, further off", off["none"] > 2.0*off["half"])


def check_stops(checks, folder):
    """Shells with modes inside go on with the same digits after they were killed, and on other ranks."""
    content = rotor_in_time(heavy(shells(0.1, reduction="guyan", half_width="yes")), foil_mass="on", foil_modes=4)
    content["transient"] |= {"turns": 2.0, "unbalance": 1.0e-6}  # whose film is not yet so thin that round-off shows
    content["output"] = {"restart_every": 10}
    check_march(checks, folder, content)


def check_beams(checks, folder):
    """Beams that rub: ranks, two bearings alike, by default where it counts, and none without a density."""
    case = heavy(beams(0.1))
    one, two = (orbit(history(solve(folder, "ranks", rotor_in_time(case, foil_mass="on"), ranks))) for ranks in (1, 2))
    checks.below("beams: 2 ranks", largest_difference(one, two, 1.0), 1.0e-8)
    content = rotor_in_time(case, foil_mass="on")
    content["rotor"] |= {"transverse_inertia": 1.6e-3, "polar_inertia": 4.0e-4, "bearing_distance": 0.12}
    checks.below("beams: two bearings alike", largest_difference(
        one, orbit(history(solve(folder, "two", content))), 1.0), 1.0e-8)
    answer = solve(folder, "auto", rotor_in_time(case))
    checks.that("by default: the log says why", "of top foil and bumps, for" in answer.log)
    checks.that("by default: the same digits", bool(numpy.array_equal(orbit(history(answer)), one)))
    bare = solve(folder, "bare", rotor_in_time(beams(0.1)))
    checks.that("without a density: the log says so", "left out, for a foil has no density" in bare.log)
    off = orbit(history(solve(folder, "off", rotor_in_time(case, foil_mass="off"))))
    checks.that("off: as without densities, to the last bit", bool(numpy.array_equal(orbit(history(bare)), off)))
    checks.that("beams: the mass is felt", largest_difference(one, off, 1.0) > 1.0e-5)


def main():
    run_checks((check_beams,), (check_force, check_shells, check_stops))


if __name__ == "__main__":
    main()
