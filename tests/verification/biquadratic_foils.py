#!/usr/bin/env python3
"""Foils under a film of biquadratic elements: they stand on its nodes, twice as many each way as elements.

Beams tend to the limit of an independent model; ranks, half the width and turns of film and foil change nothing.
"""


import numpy

from beam_bearing import CONVERGED, beams
from gfb_run import run_checks
from shell_bearing import BEARING, check_balance, compare, solve

ORDER = {"film_order": 2}
# Elements a pitch, over the width, of an arc; a flat has a quarter of an arc's.
FINE = ((2, 4, 12), (4, 8, 24), (8, 16, 48))
# Half the elements of shell_bearing's meshes: as many nodes.
ALIGNED = {"circumferential_elements": 52, "axial_elements": 4, "arc_elements": 8, "flat_elements": 2}
INSIDE = {"circumferential_elements": 26, "axial_elements": 4, "arc_elements": 8, "flat_elements": 2,
          "align_crests": False}


def shells(folder, name, model=None, **groups):
    """Runs the reference bearing on shells with changed groups."""
    return solve(folder, name, model={"film_scheme": "galerkin", **(model or {})}, **groups)


def check_limit(checks, folder):
    """Finer and finer beams: towards the independent model's limit."""
    found = []
    for pitch, axial, arc in FINE:
        run = beams(folder, "fine", model=ORDER, mesh={
            "circumferential_elements": 26*pitch, "axial_elements": axial, "arc_elements": arc,
            "flat_elements": arc//4, "align_crests": True})
        check_balance(checks, f"beams, {pitch} elements a pitch", run)
        found.append(run.eccentricity/BEARING.clearance)
    for number, (axis, wanted) in enumerate(zip("xy", CONVERGED)):
        values = [one[number] for one in found]
        words = " ".join(f"{value:.5f}" for value in values)
        checks.below(f"beams: e_{axis}/C {words}, last one off by", values[-1] - wanted, 3.0e-3)
        first, second = numpy.diff(values)
        checks.that(f"beams: e_{axis}/C changes less each time", abs(second) < 0.5*abs(first))


def check_same(checks, folder):
    """Half width, ranks and turns change nothing."""
    for foil, solver, mesh in (("beams", beams, ALIGNED), ("beams", beams, INSIDE), ("shells", shells, INSIDE)):
        words = f"{foil}, crests {'inside elements' if mesh is INSIDE else 'on nodes'}"
        base = solver(folder, "base", model=ORDER, mesh=mesh)
        check_balance(checks, words, base)
        checks.that(f"{words}: foils touch and lift", 0.0 < base["lifted_length"] < 1.0)
        bilinear = solver(folder, "bilinear", mesh={**mesh, "circumferential_elements": 2*mesh[
            "circumferential_elements"], "axial_elements": 2*mesh["axial_elements"]})
        checks.that(f"{words}: as many unknowns as bilinear elements of half the size",
                    base["unknowns"] == bilinear["unknowns"])
        checks.below(f"{words}: position of the shaft, from that of bilinear elements", numpy.linalg.norm(
            base.eccentricity - bilinear.eccentricity)/BEARING.clearance, 1.0e-2)
        whole = solver(folder, "whole", model={**ORDER, "half_width": "no"}, mesh=mesh)
        compare(checks, f"{words}, half and whole width", whole, base, 1.0e-9)
        ranks = solver(folder, "ranks", ranks=2, model=ORDER, mesh=mesh)
        compare(checks, f"{words}, 2 ranks", ranks, base, 1.0e-8)
        if mesh is INSIDE:
            turns = solver(folder, "turns", model={**ORDER, "coupling": "partitioned"}, mesh=mesh)
            compare(checks, f"{words}, in turns", turns, base, 1.0e-8)


def main():
    run_checks((check_limit,), (check_same,))


if __name__ == "__main__":
    main()
