#!/usr/bin/env python3
"""Mass of foils under vibration: condensed and full shells, shells and beams, low frequencies, what decides."""

import tempfile

import numpy

from dynamics import FOIL_BEARING, METAL, beams, block_error, vibrate
from dynamics_foils import shells
from gfb_run import Bearing, Checks

DENSITY = 8200.0
BLOCKS = ((0, 0), (1, 1))


def heavy(case):
    """The same with densities, on an aligned shaft."""
    for foil in ("top_foil", "bump_foil"):
        case["groups"][foil] = case["groups"][foil] | {"density": DENSITY}
    return case | {"tilt": (0.0, 0.0)}


def check_reduction(checks, folder):
    """Condensed shells with many modes are the full ones, losses or not; without the modes they are next to them."""
    frequencies = (3.0e3, 3.0e4)
    case = {reduction: heavy(shells(0.1, reduction=reduction, half_width="yes")) for reduction in ("none", "guyan")}
    found = {}
    for name, reduction, keys in (("full", "none", {}), ("condensed", "guyan", {"foil_modes": 0}),
                                  ("modes", "guyan", {"foil_modes": 12}), ("off", "guyan", {})):
        mass = "off" if name == "off" else "on"
        _, _, found[name] = vibrate(folder, name, FOIL_BEARING, {"frequencies": frequencies, "foil_mass": mass,
                                                                 "loss_factor": 0.05, **keys}, **case[reduction])
    effect = [block_error(found["off"][i], found["full"][i], BLOCKS) for i in (0, 1)]
    checks.that("shells: the mass counts at 30,000 rad/s, hardly at 3,000", effect[0] < 0.01 and effect[1] > 0.05)
    checks.below("shells: condensed with 12 modes and full", block_error(found["modes"], found["full"], BLOCKS), 1.0e-8)
    checks.below("shells: condensed without modes and full", block_error(found["condensed"], found["full"], BLOCKS),
                 3.0e-5)


def check_beams(checks, folder):
    """Off is as without densities, to the last bit; low frequencies feel -w^2 times a mass; two ranks."""
    case = heavy(beams(0.1))
    low = {"frequencies": (10.0, 20.0)}
    _, frequency, on = vibrate(folder, "on", FOIL_BEARING, {**low, "foil_mass": "on"}, **case)
    _, _, off = vibrate(folder, "off", FOIL_BEARING, {**low, "foil_mass": "off"}, **case)
    _, _, bare = vibrate(folder, "bare", FOIL_BEARING, low, **(beams(0.1) | {"tilt": (0.0, 0.0)}))
    checks.that("beams without mass: as without densities, to the last bit", bool(numpy.array_equal(off, bare)))
    mass = (off - on)/frequency[:, None, None]**2
    checks.below("beams: the mass of low frequencies is constant", block_error(mass[1], mass[0], BLOCKS[:1]), 5.0e-3)
    total = DENSITY*FOIL_BEARING.length*METAL["thickness"]*2.0*numpy.pi*FOIL_BEARING.radius*2.3
    checks.that("beams: it is a part of the foils' own", bool(0.0 < mass[0, 0, 0].real < total))
    _, _, other = vibrate(folder, "ranks", FOIL_BEARING, {**low, "foil_mass": "on"}, ranks=2, **case)
    checks.below("beams with mass: 2 ranks", block_error(other, on, BLOCKS), 1.0e-9)


def check_narrow(checks, folder):
    """On a bearing too narrow for them to bend along the axis shells have the mass of beams."""
    narrow = Bearing(FOIL_BEARING.radius, 2.0e-3, FOIL_BEARING.clearance, 4.0e-5, FOIL_BEARING.ambient_pressure)
    plane = METAL | {"poissons_ratio": 0.0}
    change = {}
    for foil in ("shell", "beam"):
        case = heavy(beams(0.1) | {"foil": foil, "mesh": (208, 4),
                                   "eccentricity": (0.9*narrow.clearance, 0.2*narrow.clearance)})
        for group, keys in (("model", {"half_width": "yes"}), ("top_foil", plane), ("bump_foil", plane),
                            ("mesh", {"arc_elements": 24, "flat_elements": 6})):
            case["groups"][group] = case["groups"][group] | keys
        found = [vibrate(folder, "narrow", narrow, {"frequencies": (1.0e4,), "foil_mass": mass}, **case)[2]
                 for mass in ("on", "off")]
        change[foil] = found[0] - found[1]
    checks.below("narrow bearing, shells and beams: what the mass changes",
                 block_error(change["shell"], change["beam"], BLOCKS[:1]), 2.0e-2)


def check_choice(checks, folder):
    """By default the mass is there where the foil's own frequency asks for it, and the log says why."""
    for speed, there in ((30000.0, True), (1500.0, False)):
        case = heavy(beams(0.1)) | {"speed_rpm": speed}
        found = {}
        for mass in ("auto", "on", "off"):
            answer, _, found[mass] = vibrate(folder, f"choice_{mass}", FOIL_BEARING,
                                             {"frequency_ratios": (0.5, 1.0), "foil_mass": mass}, **case)
            if mass == "auto":
                checks.that(f"{speed:g} rpm: the log says why", "of top foil and bumps, for" in answer.log if there
                            else "left out: the foil alone" in answer.log)
        checks.that(f"{speed:g} rpm: foil mass as it counts",
                    bool(numpy.array_equal(found["auto"], found["on" if there else "off"])))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_reduction(checks, folder)
        check_beams(checks, folder)
        check_narrow(checks, folder)
        check_choice(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
