#!/usr/bin/env python3
"""Stiffness and damping on meshed foils: what shells and beams must share, and what must not matter."""

import tempfile

import numpy

from dynamics import FOIL_BEARING, METAL, beams, block_error, check_static, vibrate
from gfb_run import Bearing, Checks, observed_order

COARSE = {"arc_elements": 6, "flat_elements": 2, "align_crests": False}


def shells(friction, **model):
    """Shells on a coarse mesh."""
    case = beams(friction)
    case["groups"]["mesh"] = COARSE
    case["groups"]["model"].update(model)
    return case | {"foil": "shell"}


def check_slow(checks, folder):
    """The shells' columns and rows, contacts that slide on."""
    check_static(checks, folder, "shells, sliding on", FOIL_BEARING, shells(0.1), 1.0e-6, 5.0e-5,
                 {"contact_tangent": "slip"})


def check_same(checks, folder):
    """Condensed and full shells, half and whole width."""
    found = {}
    for tangent in ("stick", "slip"):
        for reduction, width in (("none", "no"), ("auto", "no"), ("auto", "yes")):
            case = shells(0.1, reduction=reduction, half_width=width) | {"tilt": (0.0, 0.0)}
            _, _, found[reduction, width] = vibrate(folder, "same", FOIL_BEARING, {
                "frequency_ratios": (0.5, 2.0), "contact_tangent": tangent, "loss_factor": 0.05}, **case)
        _, _, other = vibrate(folder, "same", FOIL_BEARING, {
            "frequency_ratios": (0.5, 2.0), "contact_tangent": tangent, "loss_factor": 0.05}, ranks=2, **case)
        checks.below(f"shells, {tangent}: 2 ranks", block_error(other, found["auto", "yes"], ((0, 0), (1, 1))), 1.0e-8)
        checks.below(f"shells, {tangent}: condensed and full",
                     block_error(found["auto", "no"], found["none", "no"], ((0, 0), (1, 1))), 1.0e-8)
        checks.below(f"shells, {tangent}: half and whole width",
                     block_error(found["auto", "yes"], found["auto", "no"], ((0, 0), (1, 1))), 1.0e-9)


def check_narrow(checks, folder):
    """On a bearing too narrow for them to bend along the axis shells are beams."""
    narrow = Bearing(FOIL_BEARING.radius, 2.0e-3, FOIL_BEARING.clearance, 4.0e-5, FOIL_BEARING.ambient_pressure)
    plane = METAL | {"poissons_ratio": 0.0}
    found = {}
    for foil in ("shell", "beam"):
        case = beams(0.1) | {"foil": foil, "mesh": (208, 8), "tilt": (0.0, 0.0),
                             "eccentricity": (0.9*narrow.clearance, 0.2*narrow.clearance)}
        for group, keys in (("model", {"half_width": "yes"}), ("top_foil", plane), ("bump_foil", plane),
                            ("mesh", {"arc_elements": 24, "flat_elements": 6})):
            case["groups"][group] = case["groups"][group] | keys
        _, frequency, found[foil] = vibrate(folder, "narrow", narrow, {"frequency_ratios": (0.01, 0.5, 1.0)}, **case)
    one, other = (found[foil][:, :2, :2] for foil in ("shell", "beam"))
    for name, part in (("stiffness", numpy.real), ("damping", lambda z: numpy.imag(z)/frequency[:, None, None])):
        checks.below(f"narrow bearing, shells and beams: {name}",
                     numpy.abs(part(one) - part(other)).max()/numpy.abs(part(other)).max(), 1.0e-2)


def check_mesh(checks, folder):
    """Direct damping at half the speed, a remainder of large shares, needs a fine mesh; the error is of second order."""
    damping = []
    for elements in (216, 432, 864):
        case = beams(0.1) | {"mesh": (elements, 16), "tilt": (0.0, 0.0), "eccentricity": None, "load": (-100.0, 0.0)}
        case["groups"]["mesh"] = {}
        case["groups"]["model"] = {"half_width": "yes"}
        _, frequency, found = vibrate(folder, "mesh", FOIL_BEARING, {"frequency_ratios": (0.5,)}, **case)
        damping.append(found[0, 0, 0].imag/frequency[0])
    checks.within("beams of [Gu2020]: order of C_xx with the elements along the pad",
                  observed_order(damping[0] - damping[1], damping[1] - damping[2]), 1.7, 2.6)
    checks.within("beams of [Gu2020]: C_xx on the finest mesh", damping[-1], -95.0, -70.0)


def check_losses(checks, folder):
    """A foil whose own stiffness is huge by its losses stays where it is: stiffer than one that gives way."""
    case = beams(0.1) | {"tilt": (0.0, 0.0)}
    case["groups"]["model"]["half_width"] = "yes"
    case["groups"]["mesh"] = {}
    found = {loss: vibrate(folder, "losses", FOIL_BEARING, {"frequency_ratios": (0.5,), "loss_factor": loss}, **case)[2]
             for loss in (0.0, 1.0e-6, 1.0e9)}
    checks.below("beams: a small loss factor changes little", block_error(found[1.0e-6], found[0.0], ((0, 0), (1, 1))),
                 1.0e-5)
    checks.that("beams: a huge one holds them", found[1.0e9][0, 0, 0].real > 1.3*found[0.0][0, 0, 0].real)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_slow(checks, folder)
        check_same(checks, folder)
        check_narrow(checks, folder)
        check_mesh(checks, folder)
        check_losses(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
