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
    check_static(checks, folder, "shells, sliding on", FOIL_BEARING, shells(0.1), 2.0e-8, 5.0e-5,
                 {"contact_tangent": "slip"})


def check_same(checks, folder):
    """Half and whole width; condensed and full shells, and ranks, with contacts that stick."""
    keys = {"frequency_ratios": (0.5, 2.0), "loss_factor": 0.05}
    for tangent, more in (("stick", {"full": {"reduction": "none", "half_width": "no"}}), ("slip", {})):
        case = keys | {"contact_tangent": tangent}
        found = {}
        for words, model in ({"whole": {"half_width": "no"}, "half": {"half_width": "yes"}} | more).items():
            foil = shells(0.1, **({"reduction": "auto"} | model)) | {"tilt": (0.0, 0.0)}
            _, _, found[words] = vibrate(folder, "same", FOIL_BEARING, case, **foil)
            if words == "half" and more:
                _, _, found["ranks"] = vibrate(folder, "same", FOIL_BEARING, case, ranks=2, **foil)
        for words, one, other, limit in (("half and whole width", "half", "whole", 1.0e-9),
                                         ("condensed and full", "whole", "full", 1.0e-8), ("2 ranks", "ranks", "half", 1.0e-8)):
            if one in found and other in found:
                checks.below(f"shells, {tangent}: {words}", block_error(found[one], found[other], ((0, 0), (1, 1))), limit)


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
    """A foil whose own stiffness is huge by its losses stays where it is: stiffer than one that deflects."""
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
