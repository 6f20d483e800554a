#!/usr/bin/env python3
"""The bearing of beams: independent numbers, a fine mesh, balance, what must not change it, limits."""

import tempfile

import numpy

from gfb_run import Checks, largest_difference, observed_order
from shell_bearing import ALIGNED, BEARING, INSIDE, MICROMETRE, PAPER_MESH, check_balance, check_resting, check_stiff, \
    check_ways, compare, held, solve

# Independent beam model: keys of the shells' reference.
REFERENCE = {"trailing": {"eccentricity": (0.9182, 0.2711), "gap": 6.67, "pressure": 2.574},
             "leading": {"eccentricity": (0.9248, 0.2666), "gap": 6.59}}
CONVERGED = (0.9553, 0.2799)
# Elements a pitch, over the width, of an arc; a flat has a quarter of an arc's.
FINE = ((8, 16, 12), (16, 32, 24), (32, 64, 48))
BEAM = {"foil": "beam", "film_scheme": "galerkin"}


def beams(folder, name, model=None, **groups):
    """Runs the reference bearing on beams with changed groups."""
    return solve(folder, name, model={**BEAM, **(model or {})}, **groups)


def check_reference(checks, folder):
    """Both cases of the independent model, on its mesh, from a cold start."""
    for edge, wanted in REFERENCE.items():
        run = beams(folder, edge, mesh=PAPER_MESH, top_foil={"fixed_edge": edge}, solver={"stability": edge == "trailing"})
        words = f"top foil fixed at the {edge} edge"
        off = run.eccentricity/BEARING.clearance - wanted["eccentricity"]
        checks.below(f"{words}: e_x/C off by", off[0], 3.0e-3)
        checks.below(f"{words}: e_y/C off by", off[1], 3.0e-3)
        gap = run["minimum_gap"]/MICROMETRE
        checks.below(f"{words}: gap {gap:.3f} um, off by", gap/wanted["gap"] - 1.0, 2.0e-2)
        if "pressure" in wanted:
            pressure = run["maximum_pressure"]/BEARING.ambient_pressure
            checks.below(f"{words}: highest pressure {pressure:.4f} p_a, off by",
                         pressure/wanted["pressure"] - 1.0, 1.0e-2)
        # The free edge rests on the bumps: the branch the reference calls resting.
        checks.below(f"{words}: leading edge lies on the bumps [um]", run["leading_edge_lift"]/MICROMETRE, 0.5)
        check_balance(checks, words, run)
        if edge == "trailing":
            check_resting(checks, words, run)
        film = run.film_arrays()
        checks.that(f"{words}: all stations of a row along z move as one",
                    numpy.ptp(film["gap"], axis=1).max() <= 1.0e-12*BEARING.clearance)
    smooth, rubbing = (beams(folder, "friction", mesh=PAPER_MESH,
                             contact={"friction_top": value, "friction_sleeve": value}) for value in (0.0, 0.1))
    rise = (smooth.eccentricity - rubbing.eccentricity)[0]/BEARING.clearance
    checks.below("without friction e_x/C rises by 0.111, off by", rise - 0.111, 3.0e-3)


def check_fine_mesh(checks, folder):
    """Finer and finer along the motion, along z and in the bumps: towards the independent model's limit."""
    found = []
    for pitch, axial, arc in FINE:
        run = beams(folder, "fine", mesh={"circumferential_elements": 26*pitch, "axial_elements": axial,
                                          "arc_elements": arc, "flat_elements": arc//4, "align_crests": True})
        check_balance(checks, f"{pitch} elements a pitch", run)
        found.append(run.eccentricity/BEARING.clearance)
    for number, (axis, wanted) in enumerate(zip("xy", CONVERGED)):
        values = [one[number] for one in found]
        words = " ".join(f"{value:.5f}" for value in values)
        checks.below(f"fine mesh: e_{axis}/C {words}, last one off by", values[-1] - wanted, 3.0e-3)
        first, second = numpy.diff(values)
        checks.that(f"fine mesh: e_{axis}/C changes less each time, observed order "
                    f"{observed_order(first, second):.1f}", abs(second) < 0.5*abs(first))


def check_same(checks, folder):
    """Half width, ranks and the way to the answer change nothing."""
    for mesh, words in ((ALIGNED, "crests on nodes"), (INSIDE, "crests inside elements")):
        base = beams(folder, "base", mesh=mesh)
        check_balance(checks, words, base)
        checks.that(f"{words}: foils touch and lift", 0.0 < base["lifted_length"] < 1.0)
        whole = beams(folder, "whole", mesh=mesh, model={"half_width": "no"})
        checks.that(f"{words}: half the width has fewer unknowns", base["unknowns"] < whole["unknowns"])
        compare(checks, f"{words}, half and whole width", whole, base, 1.0e-9)
    # crests inside elements
    check_ways(checks, folder, base, ((25.0e-6, 10.0e-6), (15.0e-6, 0.0), (28.0e-6, 8.0e-6)), beams)


def check_in_turns(checks, folder):
    """Film and foils in turns give the answer of solving them together."""
    scenes = {"crests on nodes": {"mesh": ALIGNED}, "crests inside elements": {},
              "top foil fixed at the leading edge": {"top_foil": {"fixed_edge": "leading"}},
              "without friction, held": {"contact": {"friction_top": 0.0, "friction_sleeve": 0.0},
                                         **held((28.0e-6, 8.0e-6))}}
    for words, groups in scenes.items():
        base = beams(folder, "together", **groups)
        turns = beams(folder, "turns", model={"coupling": "partitioned"}, **groups)
        checks.that(f"{words}, in turns: another way", turns["newton_iterations"] != base["newton_iterations"])
        compare(checks, f"{words}, in turns", turns, base, 1.0e-8)


def check_rest(checks, folder):
    """Without speed nothing moves."""
    place = numpy.array((22.0e-6, 8.0e-6))
    run = beams(folder, "rest", **held(place, speed_rpm=0.0))
    film = run.film_arrays()
    gap = BEARING.clearance + place[0]*numpy.cos(film["theta"]) + place[1]*numpy.sin(film["theta"])
    checks.that("at rest: ambient pressure, exactly", numpy.all(film["pressure"] == BEARING.ambient_pressure))
    checks.that("at rest: no deflection, exactly", not numpy.any(film["deflection"]))
    checks.below("at rest: undeflected gap", largest_difference(film["gap"], gap), 1.0e-12)
    checks.below("at rest: no force", numpy.abs(run.force).max()/BEARING.force_unit, 1.0e-12)
    moved = beams(folder, "moving", **held(place)).film_arrays()
    checks.that("at speed: the top foil moves", numpy.abs(moved["deflection"]).max() > 0.01*BEARING.clearance)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_reference(checks, folder)
        check_fine_mesh(checks, folder)
        check_same(checks, folder)
        check_in_turns(checks, folder)
        check_stiff(checks, folder, beams)
        check_rest(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
