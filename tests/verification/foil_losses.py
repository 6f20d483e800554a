#!/usr/bin/env python3
"""Viscous losses of meshed foils: in vibrations they are a loss factor that grows with the frequency, in time the same
forces, growth rates, orbits, and no digit where the factor is 0.

Small motions in equal steps obey the formula of the steps in all unknowns, so growth is compared without any error of them
(`transient.py`). Contacts do not rub here, but where stops and ranks are tried. With --long shells, the mass of the foils with modes
inside condensed pieces, stops, and two bearings.
"""

import math
import pathlib
import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, largest_difference, solve
from heat import changed, foils_at
from periodic import orbits
from restart import check_march
from small_motions import OMEGA, case, harmonic
from transient import TIGHT, history, modes_in

ETA, WHIRL = 0.2, 0.45*OMEGA  # a loss factor and the frequency at which foils have it
LOSSES = {"loss_factor": ETA, "loss_frequency": WHIRL}
PLACE, LOAD = {"eccentricity": (1.1e-5, 5.0e-6)}, {"load": (-1.5, 0.2)}
CLEARANCE, RADIUS = 15.0e-6, 1.0e-9
SMOOTH = {"friction_top": 0.0, "friction_sleeve": 0.0}
SHELLS = {"foil": "shell", "reduction": "guyan", "half_width": "yes"}


def foils(foil, analysis, operation, damping=None, friction=0.0, **groups):
    """A small bearing whose foils lose something."""
    content = case(foil, analysis, operation, contact={"friction_top": friction, "friction_sleeve": friction}, **groups)
    content["foil_damping"] = {"foil_mass": "off"} | (damping or {})
    if foil == "shell":
        content["model"] = dict(SHELLS)
    if foil == "plate":
        content["model"]["crest_springs"] = "two_sided"
        del content["contact"]
        for key in ("arc_elements", "flat_elements"):
            del content["mesh"][key]
    return content


def vibrate(folder, foil, operation, dynamics, damping=None, mass=None, **groups):
    """The linear answer and its Z of x and y at all frequencies."""
    content = foils(foil, "linear_dynamics", operation, damping, dynamics=dynamics, **groups)
    if mass:
        content["rotor"] = {"mass": mass}
    answer = solve(folder, "linear", content)
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        group = file["dynamics"]
        omega = numpy.atleast_1d(group["frequency"][...].ravel())[-1 if "sweep" in groups else 0:]
        found = [group[name][...].reshape(-1, 4, 4)[-len(omega):, :2, :2] for name in ("stiffness", "damping")]
        return answer, found[0] + 1j*omega[:, None, None]*found[1]


def apart(one, other):
    """Largest difference of two matrices over the largest entry."""
    return float(numpy.abs(one - other).max()/numpy.abs(other).max())


def check_frequencies(checks, folder, foil, heavy):
    """At each frequency w the losses are those of a loss factor eta w/w_0, whatever else the foil does."""
    keys = {"foil_mass": heavy, "foil_modes": 4} if (foil, heavy) == ("shell", "on") else {"foil_mass": heavy}
    frequencies = (0.5*WHIRL, WHIRL, 12.0*WHIRL)
    _, viscous = vibrate(folder, foil, PLACE, {"frequencies": frequencies}, LOSSES | keys)
    for frequency, z in zip(frequencies, viscous):
        _, (steady,) = vibrate(folder, foil, PLACE, {"frequencies": frequency, "loss_factor": ETA*frequency/WHIRL}, keys)
        _, (none,) = vibrate(folder, foil, PLACE, {"frequencies": frequency}, keys)
        words = f"{foil}, foil mass {heavy}, {frequency/OMEGA:.3g} of the speed"
        checks.below(f"{words}: the loss factor there", apart(z, steady), 1.0e-9)
        checks.that(f"{words}: it is felt", apart(none, steady) > 1.0e-3)


def check_onset(checks, folder, foil, heavy="off"):
    """At the frequency with which it begins whirl begins as with a loss factor, and does not grow there."""
    keys, ratios = {"foil_mass": heavy}, {"frequency_ratios": 0.5}
    bare, _ = vibrate(folder, foil, LOAD, ratios, keys)
    steady, _ = vibrate(folder, foil, LOAD, ratios | {"loss_factor": ETA}, keys)
    critical, whirl = steady["critical_mass"], steady["whirl_ratio"]*OMEGA
    losses = {"loss_factor": ETA, "loss_frequency": whirl}
    viscous, _ = vibrate(folder, foil, LOAD, ratios, losses | keys, critical)
    words = f"{foil}, foil mass {heavy}"
    checks.that(f"{words}: losses move the critical mass from {bare['critical_mass']:.4g} to {critical:.4g} kg",
                abs(critical/bare["critical_mass"] - 1.0) > 0.02)
    checks.below(f"{words}: critical mass of a loss factor, at its frequency", viscous["critical_mass"]/critical - 1.0, 1.0e-7)
    checks.below(f"{words}: whirl ratio", viscous["whirl_ratio"]*OMEGA/whirl - 1.0, 1.0e-7)
    checks.below(f"{words}: growth there, over the speed", viscous["growth_rate"]/OMEGA, 1.0e-7)


def check_onset_speed(checks, folder, mass=0.012):
    """Over the speed the onset of growth is where the critical mass of a loss factor passes the rotor's."""
    sweep = {"parameter": "speed_rpm", "values": (65000.0, 75000.0)}
    keys, ratios = {"foil_mass": "off"}, {"frequency_ratios": 0.5}
    bare, steady = (vibrate(folder, "beam", LOAD, ratios | one, keys, mass, sweep=sweep)[0]["onset_speed_rpm"]
                    for one in ({}, {"loss_factor": ETA}))
    at_onset, _ = vibrate(folder, "beam", LOAD | {"speed_rpm": steady}, ratios | {"loss_factor": ETA}, keys, mass)
    losses = {"loss_factor": ETA, "loss_frequency": at_onset["whirl_ratio"]*steady*math.pi/30.0}
    viscous = vibrate(folder, "beam", LOAD, ratios, losses | keys, mass, sweep=sweep)[0]["onset_speed_rpm"]
    checks.that(f"losses move the onset from {bare:.0f} to {steady:.0f} rpm", abs(steady/bare - 1.0) > 0.01)
    checks.below("onset over the speed, that of the loss factor", viscous/steady - 1.0, 1.0e-6)


def check_growth(checks, folder, foil, heavy="off"):
    """A pushed shaft, lighter and heavier than whirls, grows and dies out as its modes say."""
    keys, ratios = {"foil_mass": heavy}, {"frequency_ratios": 0.5}
    critical = vibrate(folder, foil, LOAD, ratios, LOSSES | keys)[0]["critical_mass"]
    for share in (0.8, 1.2):
        answer, _ = vibrate(folder, foil, LOAD, ratios, LOSSES | keys, share*critical)
        bare, _ = vibrate(folder, foil, LOAD, ratios, keys, share*critical)
        march = solve(folder, "growth", foils(foil, "transient", LOAD, LOSSES | keys, rotor={"mass": share*critical}, solver=TIGHT, transient={
            "turns": 24, "steps_per_turn": 60, "pulse": (0.0, 1.0e-7), "pulse_length": 2.0e-4}))
        found = modes_in(history(march), 8.0)[0]
        words = f"{foil}, foil mass {heavy}, {share} of the critical mass"
        checks.below(f"{words}: the march tells it", march["critical_mass"]/critical - 1.0, 1.0e-7)
        checks.below(f"{words}: growth over the speed", (found.real - answer["growth_rate"])/OMEGA, 2.0e-5)
        checks.below(f"{words}: frequency over the speed", (found.imag - answer["whirl_frequency"])/OMEGA, 2.0e-5)
        checks.that(f"{words}: losses change growth from {bare['growth_rate']:.4g} to {answer['growth_rate']:.4g} 1/s",
                    abs(bare["growth_rate"] - answer["growth_rate"])/OMEGA > 2.0e-4)


def check_circle(checks, folder, foil, heavy="off"):
    """The force on a small circle is that of the linear theory, but for the error of the steps, of second order."""
    frequency = 1.5*OMEGA
    keys = {"foil_mass": heavy}
    circle = numpy.array([RADIUS, -1j*RADIUS])
    wanted, bare = (-vibrate(folder, foil, PLACE, {"frequencies": frequency}, damping | keys)[1][0] @ circle for damping in (LOSSES, {}))
    found = [harmonic(history(solve(folder, "circle", foils(foil, "transient", PLACE, LOSSES | keys, solver=TIGHT, transient={
        "turns": 14, "steps_per_turn": steps, "orbit_radius": RADIUS, "orbit_frequency": frequency}))), "force", frequency, 10.0)
        for steps in (60, 120)]
    size = numpy.linalg.norm(wanted)
    words = f"{foil}, foil mass {heavy}, a circle"
    checks.that(f"{words}: losses are felt", numpy.linalg.norm(bare - wanted)/size > 0.02)
    checks.below(f"{words}: force of the linear theory", numpy.linalg.norm((4.0*found[1] - found[0])/3.0 - wanted)/size, 1.0e-4)


def turning(damping, foil="beam", friction=0.0, mass=0.01, **transient):
    """A shaft with an unbalance over some turns."""
    return foils(foil, "transient", LOAD, damping, friction, rotor={"mass": mass}, solver=TIGHT,
                 transient={"turns": 2.0, "steps_per_turn": 60} | transient, unbalance={"unbalance": 2.0e-8})


def orbit(rows):
    """Positions of the shaft over the clearance."""
    return (rows["eccentricity_x"] + 1j*rows["eccentricity_y"])/CLEARANCE


def check_same(checks, folder):
    """No digit changes where the factor is 0; ranks, and an orbit that closes."""
    one, zero, lossy, ranks = (orbit(history(solve(folder, "same", turning(damping, friction=0.1), ranks)))
                               for damping, ranks in (({}, 1), (LOSSES | {"loss_factor": 0.0}, 1), (LOSSES, 1), (LOSSES, 2)))
    checks.that("loss factor 0: every digit", bool(numpy.array_equal(one, zero)))
    checks.that("loss factor 0.2: another orbit", largest_difference(one, lossy, 1.0) > 1.0e-4)
    checks.below("2 ranks", largest_difference(ranks, lossy, 1.0), 1.0e-8)
    z = [vibrate(folder, "beam", PLACE, {"frequency_ratios": (0.5, 1.0)}, damping)[1] for damping in ({}, LOSSES | {"loss_factor": 0.0})]
    checks.that("loss factor 0, vibrations: every digit", bool(numpy.array_equal(*z)))
    march = orbit(history(solve(folder, "march", turning(LOSSES, turns=60.0))))
    content = foils("beam", "periodic", LOAD, {key: LOSSES[key] for key in LOSSES}, rotor={"mass": 0.01}, solver=TIGHT,
                    unbalance={"unbalance": 2.0e-8}, periodic={"steps_per_turn": 60})
    del content["foil_damping"]["foil_mass"]
    closed = orbits(solve(folder, "closed", content))
    checks.below("an orbit that closes is the last turn of a long march", largest_difference(
        (closed["eccentricity_x"][0] + 1j*closed["eccentricity_y"][0])/CLEARANCE, march[-61:], 1.0), 1.0e-8)


def check_stops(checks, folder):
    """Shells with modes inside go on with the same digits after they were killed, and on other ranks."""
    content = turning(LOSSES | {"foil_mass": "on", "foil_modes": 4}, "shell", 0.1)
    content["output"] = {"restart_every": 10}
    check_march(checks, folder, content)


def check_reduction(checks, folder):
    """Condensed shells with many modes inside lose over time what full ones do; two bearings alike what one does."""
    found = {}
    keys = LOSSES | {"foil_mass": "on"}
    for words, modes, reduction in (("full", {}, "none"), ("modes", {"foil_modes": 12}, "guyan"), ("none", {"foil_modes": 0}, "guyan")):
        content = turning(keys | modes, "shell")
        content["model"]["reduction"] = reduction
        found[words] = orbit(history(solve(folder, words, content)))
    off = {words: largest_difference(found[words], found["full"], 1.0) for words in ("modes", "none")}
    checks.below("shells with mass: twelve modes and full bumps", off["modes"], 1.0e-9)
    checks.that(f"shells with mass: without modes {off['none']:.1e}, further off", off["none"] > 2.0*off["modes"])
    one = orbit(history(solve(folder, "one", turning(keys))))
    content = turning(keys)
    content["rotor"] |= {"transverse_inertia": 1.0e-4, "polar_inertia": 2.0e-5, "bearing_distance": 0.05}
    content["model"]["half_width"] = "no"
    checks.below("beams: two bearings alike", largest_difference(one, orbit(history(solve(folder, "two", content))), 1.0), 1.0e-8)


def check_temperature(checks, folder):
    """Foils whose modulus follows their temperature lose as those do that have this modulus, over time with modes inside."""
    modulus, ratios = 214.0e9, (0.86, 0.9 + 0.1*15.0/107.0)  # at 420 K, at 385 K
    table = {"modulus_temperatures": (293.0, 400.0, 600.0), "modulus_ratios": (1.0, 0.9, 0.5)}
    moving = {"scene": {"analysis": "transient"}, "rotor": {"mass": 1.0}, "solver": TIGHT, "unbalance": {"unbalance": 2.0e-6},
              "transient": {"turns": 1.0, "steps_per_turn": 60}, "foil_damping": {"foil_mass": "on", **LOSSES}}
    found = [orbit(history(solve(folder, "hot", groups))) for groups in (
        changed(foils_at([modulus*ratio for ratio in ratios], SHELLS), **moving),
        changed(foils_at((modulus, modulus), SHELLS), thermal=table, **moving),
        changed(foils_at((modulus, modulus), SHELLS), **moving))]
    checks.below("shells that soften, against their modulus typed", largest_difference(found[1], found[0], 1.0), 1.0e-8)
    checks.that("their modulus is felt", largest_difference(found[2], found[0], 1.0) > 1.0e-4)


def check_beams(checks, folder, heavy):
    """All of it on beams, their mass left out or not."""
    for check in (check_frequencies, check_onset, check_growth, check_circle):
        check(checks, folder, "beam", heavy)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if "--long" in sys.argv:
            for foil, heavy in (("shell", "off"), ("shell", "on")):
                check_frequencies(checks, folder, foil, heavy)
                check_growth(checks, folder, foil, heavy)
            check_circle(checks, folder, "shell", "on")
            check_onset(checks, folder, "shell")
            check_frequencies(checks, folder, "plate", "on")
            check_growth(checks, folder, "plate", "on")
            check_temperature(checks, folder)
            check_reduction(checks, folder)
            check_stops(checks, folder)
            check_beams(checks, folder, "off")
            check_same(checks, folder)
        else:
            check_beams(checks, folder, "on")
            check_onset_speed(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
