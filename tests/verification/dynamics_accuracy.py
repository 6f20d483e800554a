#!/usr/bin/env python3
"""Stiffness and damping with &accuracy: whether the stated errors cover the true ones, and by how much they exceed them."""

import csv
import pathlib
import tempfile

import h5py
import numpy

from dynamics import BLOCKS, REFERENCE
from gfb_run import Bearing, Checks, case_groups, solve

CASES = {"rigid slit, held": (2,), "axial mean, balanced": (1, 2)}  # orders of the film's elements
# Biquadratic elements give coefficients with order 4 where the rule counts on 3: F (2^4 - 1)/(2^3 - 1) 2^4/2^3.
LARGEST = {1: 10.0, 2: 3.0*15.0/7.0*2.0}
MESH = {1: (208, 64), 2: (104, 32)}  # by film order; runs begin with a quarter


def accurate(folder, one, quantity, order):
    """A case of the reference that must know a quantity so well."""
    case = one["case"]
    bearing = Bearing(*(case[key] for key in ("radius", "length", "clearance", "viscosity", "ambient_pressure",
                                              "leading_edge_condition")))
    model = {"film_order": order} | {key: case[key] for key in ("foundation_stiffness", "foundation_pressure")
                                     if key in case}
    losses = {key: case[key] for key in ("loss_factor", "foundation_damping") if key in case}
    frequencies = [row["w"] for row in one.get("frequencies", [])] or [0.5*case["speed_rpm"]*numpy.pi/30.0]
    content = case_groups(bearing, mesh=MESH[order], foil=case["foil"], groups={
        "model": model, "dynamics": {"frequencies": frequencies, **losses},
        "accuracy": {"quantity": quantity, "target": 0.02}}, speed_rpm=case["speed_rpm"], **one["operation"])
    content["scene"]["analysis"] = "linear_dynamics"
    return solve(folder, "accurate", content)


def check_coefficients(checks, folder, one, order):
    """The largest stated and true error of each block, over its largest entry."""
    answer = accurate(folder, one, "coefficients", order)
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        group = file["dynamics"]
        found = {key: group[key][...] for key in ("stiffness", "damping", "stiffness_error", "damping_error")}
    worst, wanted = 0.0, {"stiffness": "K", "damping": "C"}
    for key, letter in wanted.items():
        true = numpy.array([row[letter] for row in one["frequencies"]])
        for k in range(len(true)):
            for block in BLOCKS:
                part = (k, block, block)
                off = numpy.abs(found[key][part] - true[part])
                stated = found[f"{key}_error"][part]
                words = f"{one['name']}, order {order}: {key} {k}, {'translation' if block == BLOCKS[0] else 'tilts'}"
                checks.that(f"{words}: every stated error covers the true one", (stated >= off).all())
                ratio = stated.max()/off.max()
                checks.below(f"{words}: largest stated error over the largest true one", ratio, LARGEST[order])
                worst = max(worst, stated.max()/numpy.abs(found[key][part]).max())
    checks.below(f"{one['name']}, order {order}: error of the summary against the arrays'",
                 abs(answer.summary["coefficients_error"]/worst - 1.0), 1.0e-9)
    with open(f"{answer.stem}.coefficients.csv", encoding="ascii", newline="") as file:
        rows = list(csv.DictReader(file))
    checks.below("the table's errors are the arrays'",
                 max(abs(float(row["cxy_error"]) - error[0, 1]) for row, error in zip(rows, found["damping_error"])),
                 0.0)


def check_whirl(checks, folder, one, quantity, order):
    """The stated error of the mass that whirls, or of its frequency."""
    summary = accurate(folder, one, quantity, order).summary
    off = abs(summary[quantity] - one[quantity])
    checks.within(f"{one['name']}, order {order}: stated error of {quantity} over the true one",
                  summary[f"{quantity}_error"]/off, 1.0, 10.0)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for one in REFERENCE["coefficients"]:
            for order in CASES.get(one["name"], ()):
                check_coefficients(checks, folder, one, order)
        for quantity, order in (("critical_mass", 1), ("whirl_ratio", 2)):
            check_whirl(checks, folder, REFERENCE["critical_mass"][1], quantity, order)
    checks.close()


if __name__ == "__main__":
    main()
