#!/usr/bin/env python3
"""The number of ranks changes nothing: 1 and, in turn, 2 or 4, with --long 4 or 2, give the same numbers and the same film file."""

import sys
import tempfile

import h5py
import numpy

from gfb_run import COST, Bearing, Checks, largest_difference, natural_sizes, run, summary_difference

LIMIT = 1.0e-10
BEARING = Bearing()
RING = Bearing(leading_edge_condition="periodic")
STIFFNESS = 2.0*BEARING.ambient_pressure/BEARING.clearance
PLACE = (0.3*BEARING.clearance, 0.5*BEARING.clearance)
LOAD = (-0.4*BEARING.force_unit, 0.1*BEARING.force_unit)
LOCAL = {"foil": "elastic_foundation", "groups": {"model": {"foundation_stiffness": STIFFNESS,
                                                            "foundation_pressure": "local"}}}
MEAN = {"foil": "elastic_foundation", "groups": {"model": {"foundation_stiffness": STIFFNESS,
                                                           "foundation_pressure": "axial_mean"}}}

CASES = {
    "rigid held": (BEARING, {"eccentricity": PLACE}),
    "rigid balanced": (BEARING, {"load": LOAD}),
    "ring balanced": (RING, {"load": LOAD}),
    "upwind": (BEARING, {"eccentricity": PLACE, "groups": {"model": {"film_scheme": "supg"}}}),
    "biquadratic": (BEARING, {"load": LOAD, "tilt": (1.0e-4, -2.0e-4), "groups": {"model": {"film_order": 2}}}),
    "biquadratic ring on a mean foundation": (RING, {"load": LOAD, "foil": "elastic_foundation", "groups": {
        "model": {**MEAN["groups"]["model"], "film_order": 2}}}),
    "local foundation": (BEARING, {"load": LOAD, **LOCAL}),
    "mean foundation": (BEARING, {"load": LOAD, **MEAN}),
    "mean foundation on a ring, held": (RING, {"eccentricity": PLACE, **MEAN}),
    "tilt": (BEARING, {"load": LOAD, "tilt": (1.0e-4, -2.0e-4)}),
    "sweep": (BEARING, {"load": LOAD, "groups": {"sweep": {"parameter": "load", "values": (10.0, 40.0, 60.0)}}}),
    "held sweep": (BEARING, {"load": LOAD, "groups": {"sweep": {
        "parameter": "tilt_x", "values": (0.0, 1.0e-4, 2.0e-4), "hold_position": True}}}),
}


def datasets(path):
    """Every dataset of a film file."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[...]}) if isinstance(item, h5py.Dataset) else None)
    return found


def check_case(checks, folder, name, bearing, case, several):
    stem = name.replace(" ", "_").replace(",", "")
    answers = {ranks: run(folder, f"{stem}_{ranks}", bearing, ranks=ranks, mesh=(64, 16), number=3.0, **case)
               for ranks in (1, *several)}
    one, sizes = answers[1], natural_sizes(bearing)
    film = datasets(f"{one.stem}.film.vtkhdf")
    history = one.history()
    for ranks in several:
        words = f"{name}, {ranks} ranks"
        difference, worst = summary_difference(one, answers[ranks], sizes)
        checks.below(f"{words}: summary ({worst})", difference, LIMIT)
        other = datasets(f"{answers[ranks].stem}.film.vtkhdf")
        checks.that(f"{words}: film file has the same datasets", set(film) == set(other))
        grid = [key for key in film if "PointData" not in key and not key.endswith("/rank")]
        rank = next(key for key in film if key.endswith("CellData/rank"))
        checks.that(f"{words}: every rank has cells, side by side", numpy.array_equal(
            numpy.unique(other[rank]), numpy.arange(ranks)))
        checks.that(f"{words}: same grid", all(numpy.array_equal(film[key], other[key]) for key in grid))
        # A foil that does not move has only zeros to compare.
        checks.below(f"{words}: fields", max(
            largest_difference(film[key], other[key]) for key in film if "PointData" in key), LIMIT)
        rows = answers[ranks].history()
        checks.that(f"{words}: same history columns", set(rows) == set(history))
        checks.below(f"{words}: history", max(
            largest_difference(history[key], rows[key], sizes.get(key)) for key in set(history) - COST), LIMIT)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for i, (name, (bearing, case)) in enumerate(CASES.items()):
            check_case(checks, folder, name, bearing, case, (4 - 2*(i % 2) if "--long" in sys.argv else 2 + 2*(i % 2),))
    checks.close()


if __name__ == "__main__":
    main()
