#!/usr/bin/env python3
"""Mesh convergence of the bearing on shells: elements of a bump, and over the width.

`tools/bench bearing-mesh` does the same on finer meshes, in all directions; `shell_bearing.py` has the elements along
the motion. The film at the bearing's edges does not converge over the width on meshes like these: it is bounded.
"""

import tempfile

import numpy

from gfb_run import Checks, observed_order
from shell_bearing import BEARING, MICROMETRE, solve

# Elements a pitch, of an arc, over the width; a flat has a quarter of an arc's.
SERIES = {"elements of a bump": ((4, 12, 8), (4, 24, 8), (4, 48, 8)),
          "elements over the width": ((4, 12, 8), (4, 12, 16), (4, 12, 32))}
QUANTITIES = ("e_x/C", "e_y/C", "film at the midplane [um]", "film at the edges [um]", "highest p/p_a")
# Observed orders, where the answer depends on the direction by more than single contacts make of it.
SECOND = {"elements of a bump": QUANTITIES,
          "elements over the width": ("e_x/C", "film at the midplane [um]", "highest p/p_a")}
LAST_CHANGE = {"e_y/C": 5.0e-4, "film at the edges [um]": 0.15}  # over the width, from 16 to 32 elements


def quantities(folder, mesh):
    """What is watched, on a mesh."""
    pitch, arc, axial = mesh
    run = solve(folder, "mesh", mesh={"circumferential_elements": 26*pitch, "axial_elements": axial,
                                      "arc_elements": arc, "flat_elements": arc//4, "align_crests": True})
    return (*run.eccentricity/BEARING.clearance, run["minimum_gap_midplane"]/MICROMETRE,
            run["minimum_gap_edge"]/MICROMETRE, run["maximum_pressure"]/BEARING.ambient_pressure)


def check_series(checks, words, found):
    """Values of three meshes, the sizes of whose elements halve."""
    for name, values in zip(QUANTITIES, zip(*found)):
        first, second = numpy.diff(values)
        label = f"{words}: {name} " + " ".join(f"{value:.5f}" for value in values)
        if name in SECOND[words]:
            checks.that(f"{label}: changes of one sign", first*second > 0.0)
            checks.within(f"{label}: observed order", observed_order(first, second), 1.5, 2.5)
        else:
            checks.below(f"{label}: last change", second, LAST_CHANGE[name])


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for words, meshes in SERIES.items():
            check_series(checks, words, [quantities(folder, mesh) for mesh in meshes])
    checks.close()


if __name__ == "__main__":
    main()
