#!/usr/bin/env python3
"""Foils so thin, and contacts so hard, that the last digits of what is stiff are a part of what is soft."""

import tempfile

import numpy

from gfb_run import Checks, largest_difference
from strips import FOIL, solve

DENSITY = 8440.0
SMALL = {"arc_elements": 6, "flat_elements": 2, "axial_elements": 6}
SHORT = {"bumps": 4, "width": 10.0e-3, "fixed_edge": "none"}
SMOOTH = {"friction_top": 0.0, "friction_sleeve": 0.0}


def squeezed(folder, name, ratio=0.0223, force=10.0, contact=None, ranks=1):
    """A free strip without friction, as thin as that part of its pitch, between plates."""
    thickness = ratio*FOIL["pitch"]
    return solve(folder, name, ranks=ranks, bump_foil={**SHORT, "thickness": thickness}, mesh=SMALL,
                 contact={**SMOOTH, **(contact or {})},
                 strip_load={"kind": "plates", "maximum_force": force*(thickness/0.1e-3)**3, "steps_up": 2,
                             "steps_down": 0})


def left(answer, name="deflection_round_off"):
    """What a run says that round-off leaves."""
    return answer.summary.get(name, 0.0)


def check_strip(checks, folder):
    """Travel over force, times t^3, is a + b t^2 where shear layers are thinner than elements."""
    thin = [squeezed(folder, f"thin_{n}", ratio=ratio) for n, ratio in enumerate((1.0e-4, 0.5e-4, 1.0e-5))]
    compliance = [ratio**3/answer["loading_stiffness"] for ratio, answer in zip((1.0e-4, 0.5e-4, 1.0e-5), thin)]
    b = (compliance[0] - compliance[1])/(1.0 - 0.25)
    off = compliance[2]/(compliance[0] - b*(1.0 - 0.01)) - 1.0
    checks.within("thickness 1e-5 of the pitch: said to be left by round-off", left(thin[2]), 1.0e-7, 1.0e-4)
    checks.below("compliance as foretold, over that", off/(2.0*left(thin[2]) + 1.0e-7), 1.0)
    checks.that("its log says so", "ended at round-off" in thin[2].log and "warning: round-off" in thin[2].log)
    checks.that("takes few iterations", thin[2]["newton_iterations"] < 30)
    other = squeezed(folder, "thin_ranks", ratio=1.0e-5, ranks=2)
    checks.below("2 ranks, over that", (other["loading_stiffness"]/thin[2]["loading_stiffness"] - 1.0)
                 / (left(thin[2]) + left(other)), 1.0)
    thick = squeezed(folder, "thick")
    checks.that("a usual strip has no such word", "round-off" not in thick.log and left(thick) == 0.0)


def check_contact(checks, folder):
    """A stiffness ten times as hard leaves a tenth of the penetration, down to 1e-12 m."""
    hard = [squeezed(folder, f"hard_{power}", force=40.0, contact={"normal_stiffness": 10.0**power})
            for power in (13, 14, 15)]
    travel = [answer["maximum_deflection"] for answer in hard]
    checks.within("fall of the penetration from 1e14 to 1e15 N/m^2", (travel[0] - travel[1])/(travel[1] - travel[2]),
                  9.99, 10.01)
    checks.that("the hardest stands at round-off", "ended at round-off" in hard[2].log)
    checks.that("few iterations", hard[2]["newton_iterations"] < 40)
    other = squeezed(folder, "hard_ranks", force=40.0, contact={"normal_stiffness": 1.0e15}, ranks=2)
    checks.below("2 ranks", other["maximum_deflection"]/travel[2] - 1.0, 1.0e-10)


def modes(folder, name, ratio, edge, ranks=1):
    """Frequencies of a strip over its thickness, and its answer."""
    answer = solve(folder, name, ranks=ranks, scene={"analysis": "modes"}, modes={"part": "strip", "count": 8}, mesh=SMALL,
                   bump_foil={**SHORT, "fixed_edge": edge, "density": DENSITY, "thickness": ratio*FOIL["pitch"]})
    return numpy.array([answer[f"frequency_{i}"] for i in range(1, 9)])/ratio, answer


def check_modes(checks, folder):
    """Frequencies in proportion to the thickness, six of a free strip zero."""
    for edge, first in ("leading", 0), ("none", 6):
        thick = modes(folder, "thick", 1.0e-5, edge)[0]
        thin, answer = modes(folder, "thin", 1.0e-6, edge)
        limit = left(answer, "frequency_round_off") + 3.0e-7
        checks.below(f"fixed_edge '{edge}': frequencies at 1e-6 of the pitch as at 1e-5",
                     largest_difference(thin[first:]/thick[first:], numpy.ones(8 - first)), min(limit, 1.0e-6))
        checks.that(f"fixed_edge '{edge}': {first} rigid modes", answer["rigid_modes"] == first)
        checks.that("its log says what the matrix had lost", "round-off of its stretching stiffness" in answer.log)
        ranks, _ = modes(folder, "ranks", 1.0e-6, edge, ranks=2)
        checks.below(f"fixed_edge '{edge}': 2 ranks", numpy.abs(ranks[first:]/thin[first:] - 1.0).max(), limit)
        if first:
            checks.below("the six over the first elastic one", thin[first - 1]/thin[first], 1.0e-6)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_strip(checks, folder)
        check_contact(checks, folder)
        check_modes(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
