#!/usr/bin/env python3
"""Stiffness and damping at finite amplitudes of the shaft: limits, losses, and what must not matter."""

import math
import tempfile

import h5py
import numpy

from dynamics import FOIL_BEARING, beams, vibrate
from dynamics_foils import shells
from gfb_run import Checks

RATIO = 0.5
SMALL, LARGE = 1.0e-13, 1.0e-2
AMPLITUDES = (SMALL, 1.0e-6, 5.0e-6, 1.0e-5, LARGE, 3.0*LARGE)
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


def check_limits(checks, folder):
    """[Gu2020]'s beams, 100 N: contacts that stick, and contacts that slide as if there were no friction along them."""
    case = beams(0.1) | LOAD
    case["groups"]["mesh"] = {}
    case["groups"]["model"]["half_width"] = "yes"
    small, found, lost = at_amplitudes(folder, AMPLITUDES, **case)
    checks.below("beams: at no amplitude contacts stick", worst(found[0], small), 1.0e-9)
    checks.below("beams: nothing is lost there", abs(lost[0]).max(), 1.0e-6*SMALL**2*abs(small).max())
    checks.that("beams: nothing is gained anywhere", bool((lost >= 0.0).all()))
    direct = found[:, 0, 0].real
    checks.that("beams: friction holds less and less", bool((numpy.diff(direct) < 1.0e-6*direct[0]).all()))
    checks.below("beams: where it holds nothing, amplitudes are all the same", worst(found[-1], found[-2]), 1.0e-2)
    damping = (found[:, 0, 0] - small[0, 0]).imag
    checks.that("beams: sliding contacts damp", bool((damping[2:4] > 0.0).all()))
    work = math.pi*numpy.array(AMPLITUDES)**2*damping
    # Not equal: foils that are held less move more, and the film takes another share.
    for i in (2, 3):
        checks.within(f"beams, {AMPLITUDES[i]} m: the shaft's work over the loss", work[i]/lost[i, 0], 0.5, 2.0)
    # Friction at its limit loses in proportion to the amplitude.
    checks.below("beams: loss of contacts at their limit", lost[-1, 0]/lost[-2, 0]/3.0 - 1.0, 1.0e-2)


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


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_limits(checks, folder)
        check_same(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
