#!/usr/bin/env python3
"""Plates on crest lines: thrust bearings against an independent solution, one pad against all, springs that push against springs that
hold, dense crests against an elastic foundation, ranks, derivatives; journals on half and whole width, and with springs at points."""

import math
import tempfile

import h5py
import numpy

from gfb_run import Checks, solve
from thrust import ARC, PADS, REFERENCE, TIGHT, coefficients, referred, thrust

CRESTS = tuple(REFERENCE["plate-17"]["input"]["bump_foil"]["crest_angles"])
TOP = {"thickness": 1.5e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29}
PLATE = {"foil": "plate", "crest_stiffness": 3.5e7}
BUMPS = {"bumps": 26, "half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3, "thickness": 1.02e-4, "youngs_modulus": 2.14e11,
         "poissons_ratio": 0.29}
PLATE_QUANTITIES = ("axial_gap", "minimum_gap", "maximum_top_foil_stress")  # that are derived


def plate(operation, analysis="fixed_position", model=None, **more):
    """Groups of a small thrust bearing with plates."""
    groups = {"top_foil": TOP, "bump_foil": {"crest_angles": CRESTS}} | more
    return thrust(operation, analysis, PLATE | (model or {}), **groups)


def journal(load, model=None, operation=None, **more):
    """Groups of [Gu2020]'s bearing with its top foil on springs."""
    return {"scene": {"analysis": "equilibrium"}, "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
            "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5}, "operation": {"speed_rpm": 30000.0, "load": load} | (operation or {}),
            "top_foil": TOP, "bump_foil": BUMPS, "model": {"foil": "plate"} | (model or {}),
            "mesh": {"axial_elements": 8, "circumferential_elements": 104}} | more


def check_reference(checks, folder):
    for name in ("plate-17", "plate_load-19"):
        row = REFERENCE[name]
        answer, wanted = solve(folder, name, referred(row)), row["output"]
        limits = {"axial_force": 2.0e-3, "friction_torque": 2.0e-3, "minimum_gap": 5.0e-3, "axial_gap": 2.0e-3, "maximum_pressure": 2.0e-3,
                  "maximum_deflection": 1.0e-2, "centre_radius": 1.0e-3, "centre_angle": 1.0e-3}
        for quantity, limit in limits.items():
            if abs(wanted.get(quantity, 0.0)) > 0.0:
                checks.below(f"{name}: {quantity}", answer[quantity]/wanted[quantity] - 1.0, limit)
        for number, force in enumerate(wanted["line_force"], 1):
            checks.below(f"{name}: force of crest {number}", answer[f"line_force_{number}"]/force - 1.0, 2.0e-3)
        for corner in ("inner", "outer"):
            away = answer[f"deflection_trailing_{corner}"] - wanted[f"deflection_trailing_{corner}"]
            checks.below(f"{name}: deflection at the {corner} trailing corner, over the largest", away/wanted["maximum_deflection"], 1.0e-2)
        for quantity, found in zip(("stiffness", "damping"), coefficients(answer), strict=True):
            there = numpy.array(wanted[quantity])
            size = numpy.sqrt(numpy.abs(numpy.outer(there[0].diagonal(), there[0].diagonal())))
            checks.below(f"{name}: {quantity}", float((numpy.abs(found - there)/size).max()), 5.0e-3)
        checks.that(f"{name}: two-sided springs touch everywhere", answer["lifted_length"] == 0.0)


def check_one_pad(checks, folder):
    """One pad that stands for all; springs that push against springs that hold where none is lifted; the surface in space."""
    more = {"dynamics": {"frequency_ratios": 0.5, "loss_factor": 0.1}} | TIGHT
    one = solve(folder, "one", plate({"axial_load": 150.0}, "linear_dynamics", **more))
    every = solve(folder, "all", plate({"axial_load": 150.0, "tilt": (1.0e-30, 0.0)}, "linear_dynamics", {"crest_springs": "two_sided"}, **more))
    checks.that("an aligned runner: one pad is solved, of a tilted one all", (one["pads_solved"], every["pads_solved"]) == (1, PADS))
    for name in ("axial_gap", "friction_torque", "maximum_deflection", "line_force_3", "axial_force_4"):
        checks.below(f"one pad, pushed, against all, held: {name}", one[name]/every[name] - 1.0, 1.0e-9)
    for name, first, second in zip(("K", "C"), coefficients(one), coefficients(every), strict=True):
        size = numpy.sqrt(numpy.abs(numpy.outer(first[0].diagonal(), first[0].diagonal())))
        checks.below(f"one pad, pushed, against all, held: {name}", float((numpy.abs(first - second)/size).max()), 1.0e-8)
    for number in range(1, PADS + 1):
        with h5py.File(f"{one.stem}.top_foil_{number}.vtkhdf", "r") as file, h5py.File(f"{every.stem}.top_foil_{number}.vtkhdf", "r") as other:
            for name, size in (("Points", 0.05), ("PointData/displacement", every["maximum_deflection"])):
                checks.below(f"one pad against all: {name} of top foil {number}",
                             float(numpy.abs(file[f"VTKHDF/{name}"][...] - other[f"VTKHDF/{name}"][...]).max())/size, 1.0e-9)
            points = file["VTKHDF/Points"][...]
            angle = numpy.unwrap(numpy.arctan2(points[:, 1], points[:, 0]))
            away = numpy.mod(angle.min() - (number - 1)*2.0*math.pi/PADS + 1.0, 2.0*math.pi) - 1.0
            checks.below(f"top foil {number} begins at its pad's leading edge", float(away), 1.0e-9)
            checks.below(f"top foil {number} ends at its trailing edge", float((angle.max() - angle.min())/ARC - 1.0), 1.0e-9)


def check_foundation(checks, folder):
    """A thin plate on crests side by side is nearly an elastic foundation."""
    crests = tuple(ARC*(i + 0.5)/32.0 for i in range(32))
    pitch = ARC/32.0*0.0375
    held = {"axial_gap": 1.0e-5}
    mesh = {"circumferential_elements": 32, "radial_elements": 8, "edge_refinement": 1.0}
    springs = solve(folder, "springs", thrust(held, model={
        "foil": "elastic_foundation", "foundation_stiffness": 1.0e10, "foundation_exponent": -1.0}, mesh=mesh))
    found = solve(folder, "dense", plate(held, model={"crest_stiffness": 1.0e10*pitch}, top_foil=TOP | {"thickness": 4.0e-5},
                                         bump_foil={"crest_angles": crests}, mesh=mesh))
    checks.below("a plate of 40 um on 32 crests against an elastic foundation: axial force", found["axial_force"]/springs["axial_force"] - 1.0,
                 1.5e-2)


def check_strips(checks, folder):
    """Two strips that nearly touch are one; a wide cut lets the plate sink between them."""
    held = {"axial_gap": 8.0e-6}
    bumps = {"crest_angles": CRESTS, "strips": 2}
    whole, narrow, wide = (solve(folder, name, plate(held, bump_foil=strips)) for name, strips in (
        ("whole", {"crest_angles": CRESTS}), ("narrow", bumps | {"cut_width": 1.0e-7}), ("wide", bumps | {"cut_width": 4.0e-3})))
    checks.below("two strips 0.1 um apart: axial force", narrow["axial_force"]/whole["axial_force"] - 1.0, 1.0e-5)
    checks.that("strips 4 mm apart: the plate is deflected farther", wide["maximum_deflection"] > whole["maximum_deflection"])


def check_derivatives(checks, folder):
    """Derivatives by keys of plate and springs against differences of answers."""
    named = {"model%crest_stiffness": ("model", "crest_stiffness", 3.5e7), "top_foil%thickness": ("top_foil", "thickness", 1.5e-4)}
    load = {"axial_load": 150.0}
    derived = solve(folder, "derived", plate(load, "equilibrium", sensitivity={
        "quantity": PLATE_QUANTITIES, "parameters": tuple(named)}, **TIGHT))
    for key, (group, name, value) in named.items():
        step = 1.0e-3*value
        ahead, behind = (solve(folder, "moved", plate(load, "equilibrium", {name: value + sign*step} if group == "model" else {}, **TIGHT, **(
            {"top_foil": TOP | {name: value + sign*step}} if group == "top_foil" else {}))) for sign in (1.0, -1.0))
        for quantity in PLATE_QUANTITIES:
            rate = (ahead[quantity] - behind[quantity])/(2.0*step)
            checks.below(f"{quantity} by {key} against differences", derived[f"d_{quantity}_d_{group}_{name}"]/rate - 1.0, 1.0e-4)


def check_ranks(checks, folder):
    """Two ranks give the answer of one, under a moment that lifts nothing, and with springs at points."""
    groups = plate({"axial_load": 150.0, "moment": (0.1, -0.05)}, "equilibrium", {"spring_pitch": 2.0e-3}, **TIGHT)
    one, two = solve(folder, "one_rank", groups), solve(folder, "two_ranks", groups, ranks=2)
    for name in ("axial_gap", "tilt_x", "tilt_y", "minimum_gap", "line_force_2", "deflection_trailing_outer"):
        checks.below(f"two ranks: {name}", two[name]/one[name] - 1.0, 1.0e-8)


def check_journal(checks, folder):
    """[Gu2020]'s bearing with its top foil on springs: half and whole width, springs that hold, springs at points of the rows."""
    load = (-60.0, 0.0)
    half = solve(folder, "half", journal(load, **TIGHT))
    whole = solve(folder, "whole", journal(load, {"half_width": "no"}, **TIGHT))
    for name in ("eccentricity_x", "minimum_gap", "maximum_pressure", "lifted_length", "line_force_13"):
        checks.below(f"journal, half against whole width: {name}", half[name]/whole[name] - 1.0, 1.0e-8)
    checks.that(f"journal: {100.0*half['lifted_length']:.0f} % of the crests carry nothing", 0.1 < half["lifted_length"] < 0.9)
    held = solve(folder, "both_ways", journal(load, {"crest_springs": "two_sided"}, **TIGHT))
    pulled = [min(answer[f"line_force_{number}"] for number in range(1, 27)) for answer in (half, held)]
    checks.that("journal: springs that push never pull, springs that hold do", pulled[0] >= 0.0 > pulled[1])
    # As many points as intervals of rows, in the middle of each: the sum of their forces is that of lines to second order.
    points = solve(folder, "points", journal(load, {"spring_pitch": 38.1e-3/16.0}, **TIGHT))
    checks.below("journal: springs at points against lines: eccentricity", points["eccentricity_x"]/half["eccentricity_x"] - 1.0, 2.0e-2)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_reference(checks, folder)
        check_one_pad(checks, folder)
        check_foundation(checks, folder)
        check_strips(checks, folder)
        check_derivatives(checks, folder)
        check_ranks(checks, folder)
        check_journal(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
