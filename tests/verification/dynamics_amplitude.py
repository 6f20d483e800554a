#!/usr/bin/env python3
"""Stiffness and damping at finite amplitudes of the shaft: limits, losses, and what must not matter."""

import math
import tempfile

import h5py
import numpy

from dynamics import FOIL_BEARING, beams, vibrate
from dynamics_foils import shells
from gfb_run import Checks, case_groups, solve

RATIO = 0.5
SMALL = 1.0e-13
AMPLITUDES = (SMALL, 1.0e-6, 5.0e-6, 1.0e-5)
LARGE, WEAKER = (1.0e-5, 3.0e-5), 1.0e-3  # friction and stick length are so much smaller: contacts are at their limit
LOAD = {"eccentricity": None, "load": (-100.0, 0.0), "tilt": (0.0, 0.0)}
XY = (slice(None), slice(0, 2), slice(0, 2))


def at_amplitudes(folder, amplitudes, ranks=1, **case):
    """Z of small vibrations, Z of each amplitude along x and y, and energies that contacts lose in a cycle."""
    answer, frequency, small = vibrate(folder, "amplitude", FOIL_BEARING, {
        "frequency_ratios": (RATIO,), "vibration_amplitudes": amplitudes}, ranks=ranks, **case)
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        group = file["dynamics"]
        given = group["amplitude"][...]
        found = group["stiffness_at_amplitude"][0] + 1j*frequency[0]*group["damping_at_amplitude"][0]
        lost = group["friction_loss_at_amplitude"][...].reshape(-1, 2)
    if not numpy.array_equal(given, amplitudes) or not numpy.all(numpy.isnan(found[:, :, 2:])):
        raise AssertionError("amplitudes or columns of tilts are not what they should be")
    return small[0, :2, :2], found[XY], lost


def worst(found, wanted):
    """Largest error over the largest entry."""
    return float(numpy.abs(found - wanted).max()/numpy.abs(wanted).max())


def half_width(friction):
    """[Gu2020]'s beams, 100 N, on their usual mesh."""
    case = beams(friction) | LOAD
    case["groups"]["mesh"] = {}
    case["groups"]["model"]["half_width"] = "yes"
    return case


def check_limits(checks, folder):
    """[Gu2020]'s beams, 100 N: contacts that stick, and contacts that slide as if there were no friction along them."""
    small, found, lost = at_amplitudes(folder, AMPLITUDES, **half_width(0.1))
    checks.below("beams: at no amplitude contacts stick", worst(found[0], small), 1.0e-9)
    checks.below("beams: nothing is lost there", abs(lost[0]).max(), 1.0e-6*SMALL**2*abs(small).max())
    checks.that("beams: nothing is gained anywhere", bool((lost >= 0.0).all()))
    direct = found[:, 0, 0].real
    checks.that("beams: friction holds less and less", bool((numpy.diff(direct) < 1.0e-6*direct[0]).all()))
    damping = (found[:, 0, 0] - small[0, 0]).imag
    checks.that("beams: sliding contacts damp", bool((damping[2:4] > 0.0).all()))
    work = math.pi*numpy.array(AMPLITUDES)**2*damping
    # Not equal: foils that are held less move more, and the film takes another share.
    for i in (2, 3):
        checks.within(f"beams, {AMPLITUDES[i]} m: the shaft's work over the loss", work[i]/lost[i, 0], 0.5, 2.0)
    # With less friction and a shorter stick length in proportion contacts that stick are as stiff, and slide all the way.
    weak = half_width(0.1*WEAKER)
    weak["groups"]["contact"]["stick_length"] = FOIL_BEARING.clearance/300.0*WEAKER
    _, free, lost = at_amplitudes(folder, LARGE, **weak)
    checks.that("beams: friction at its limit holds least", bool((free[:, 0, 0].real < 0.9*direct[-1]).all()))
    checks.below("beams: where it holds nothing, amplitudes are all the same", worst(free[-1], free[-2]), 1.0e-2)
    # Friction at its limit loses in proportion to the amplitude.
    checks.below("beams: loss of contacts at their limit", abs(lost[-1, 0]/lost[-2, 0]/3.0 - 1.0), 1.0e-2)


def check_same(checks, folder):
    """Half and whole width, two ranks; shells."""
    amplitudes = (1.0e-6, 1.0e-5)
    one = beams(0.1) | LOAD
    one["groups"]["model"]["half_width"] = "no"
    _, whole, lost = at_amplitudes(folder, amplitudes, **one)
    one["groups"]["model"]["half_width"] = "yes"
    for ranks in (1, 2):
        _, half, less = at_amplitudes(folder, amplitudes, ranks, **one)
        checks.below(f"beams, {ranks} ranks: half and whole width", worst(half, whole), 1.0e-5)
        checks.below(f"beams, {ranks} ranks: their losses", worst(less, lost), 1.0e-4)
    case = shells(0.1, half_width="yes") | LOAD
    small, found, lost = at_amplitudes(folder, (SMALL, 5.0e-6), **case)
    checks.below("shells: at no amplitude contacts stick", worst(found[0], small), 1.0e-9)
    checks.that("shells: they lose energy", bool((lost[1] > 0.0).all()))


STEPS, CYCLES = 32, 3  # of the shaft's motion to and fro, load steps a cycle
SLOW = 1.0e-4          # of the speed: the film follows


def check_loops(checks, folder):
    """All contacts of a bearing: the shaft's work in a slow cycle against the loop of the static code's load steps.

    Beams that slide at all contacts, motions that are small against the film. Loops shake down first: the last cycle.
    """
    case = beams(0.003) | {"tilt": (0.0, 0.0)}
    case["groups"]["model"]["half_width"] = "yes"
    case["groups"]["contact"] |= {"friction_law": "coulomb", "stick_length": 1.0e-8}
    content = case_groups(FOIL_BEARING, **case)
    content["scene"]["analysis"] = "linear_dynamics"
    amplitudes = (1.0e-6, 2.0e-6)
    content["dynamics"] = {"frequency_ratios": SLOW, "vibration_amplitudes": amplitudes}
    answer = solve(folder, "balance", content)
    omega = SLOW*case["speed_rpm"]*math.pi/30.0
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        direct = [file[f"dynamics/{name}_at_amplitude"][0, :, 0, 0] for name in ("stiffness", "damping")]
        lost = file["dynamics/friction_loss_at_amplitude"][...].reshape(-1, 2)[:, 0]
    angle = numpy.arange(CYCLES*STEPS + 1)*2.0*math.pi/STEPS
    for i, amplitude in enumerate(amplitudes):
        content = case_groups(FOIL_BEARING, **case)
        content["sweep"] = {"parameter": "eccentricity_x", "friction_memory": True, "values": [
            case["eccentricity"][0] + amplitude*s for s in (0.0, 0.5, *numpy.cos(angle))]}
        history = solve(folder, "loop", content).history()
        force = history["force_x"][-STEPS:]
        # The first harmonic, whose area is the loop's.
        first = 2.0/STEPS*numpy.sum(force*numpy.exp(-1j*angle[-STEPS:]))/amplitude
        work, slope = -math.pi*amplitude**2*first.imag, -first.real
        checks.below(f"beams, {amplitude} m: stiffness against the loop's", abs(direct[0][i]/slope - 1.0), 0.01)
        checks.within(f"beams, {amplitude} m: work against the loop's",
                      math.pi*amplitude**2*omega*direct[1][i]/work, 1.0/1.25, 1.25)
        # Without the film's own share of the work.
        checks.within(f"beams, {amplitude} m: contacts' loss against the loop's", lost[i]/work, 1.0/1.25, 1.25)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_limits(checks, folder)
        check_same(checks, folder)
        check_loops(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
