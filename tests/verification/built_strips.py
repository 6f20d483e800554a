#!/usr/bin/env python3
"""Strips as they are built: crests with gaps at rest."""

import tempfile

import numpy

from gfb_run import Checks, largest_difference
from strips import FOIL, HELD, MICROMETRE, crests, fields, solve

SMALL = {"arc_elements": 8, "flat_elements": 2, "axial_elements": 4}
GAP = numpy.array([5.0, 2.0, 8.5])*MICROMETRE
FAR = 0.1e-3  # no plate here gets there


def strip(folder, name, gap, travel, steps=1, **foil):
    """A strip without friction under a plate; its corner lines cannot lift."""
    load = {"kind": "plates", "maximum_displacement": travel, "steps_up": steps, "steps_down": 0, **HELD}
    return solve(folder, name, bump_foil={"crest_gap": list(gap), "bumps": len(gap), **foil}, mesh=SMALL,
                 strip_load=load)


def check_shift(checks, folder):
    """Equal gaps are travel without force."""
    for bumps in (1, 3):
        touching = strip(folder, "touching", bumps*[0.0], 9*MICROMETRE, 3)
        apart = strip(folder, "apart", bumps*[3*MICROMETRE], 12*MICROMETRE, 4)
        force = apart.history()["force"]
        checks.that(f"{bumps} bumps, equal gaps: no force up to the gap", force[0] == 0.0)
        checks.below(f"{bumps} bumps, equal gaps: then that of crests that touch",
                     largest_difference(force[1:], touching.history()["force"]), 1.0e-9)
        checks.below(f"{bumps} bumps, equal gaps: crests", largest_difference(crests(apart), crests(touching)), 1.0e-9)


def check_kinks(checks, folder):
    """Three heights: straight between kinks, with the stiffness of the crests that touch."""
    for words, foil in (("", {}), ("far bumps, ", {"pitch": 20*FOIL["half_length"]})):
        rows = strip(folder, "gaps", GAP, 12*MICROMETRE, 24, **foil).history()
        force, travel = rows["force"], rows["plate_travel"]
        before = travel <= GAP.min()*(1.0 + 1.0e-9)
        checks.that(f"{words}no force before the highest crest is met", before.sum() == 4
                    and numpy.abs(force[before]).max() < 1.0e-9*force.max())
        slope = numpy.diff(force)/numpy.diff(travel)
        order = numpy.argsort(GAP)
        ends = [*sorted(GAP), 12*MICROMETRE]
        lines = []
        for count in (1, 2, 3):
            alone = numpy.full(3, FAR)
            alone[order[:count]] = 0.0
            stiffness = strip(folder, "some", alone, MICROMETRE, **foil)["loading_stiffness"]
            middle = 0.5*(ends[count - 1] + ends[count])
            at = numpy.searchsorted(travel, middle) - 1
            checks.below(f"{words}slope over {count} crests: that of the strip that they touch alone",
                         slope[at]/stiffness - 1.0, 1.0e-6)
            lines.append((slope[at], force[at] - slope[at]*travel[at]))
        kinks = [-lines[0][1]/lines[0][0]] + [-(b[1] - a[1])/(b[0] - a[0]) for a, b in zip(lines, lines[1:])]
        off = numpy.abs(numpy.array(kinks)/numpy.sort(GAP) - 1.0)
        print("       kinks at", " ".join(f"{kink/MICROMETRE:.4f}" for kink in kinks), "um")
        checks.below(f"{words}first kink at the smallest gap", off[0], 1.0e-9)
        if foil:  # flats bend, so that a bump hardly lifts its neighbour
            checks.below(f"{words}kinks at the sorted gaps", off.max(), 5.0e-2)
        for bump in range(3):
            room = rows[f"crest_deflection_{bump + 1}"] - (travel - GAP[bump])
            checks.below(f"{words}crest {bump + 1} is not passed", min(0.0, room.min())/MICROMETRE, 1.0e-2)


def check_corners(checks, folder):
    """Corners off the sleeve: under the plate bump after bump comes down by its gap, and rests there."""
    gaps = numpy.array([4.0, 2.0, 3.0])*MICROMETRE
    load = {"kind": "plates", "maximum_displacement": 20*MICROMETRE, "steps_up": 40, "steps_down": 0}

    def press(name, **more):
        return solve(folder, name, bump_foil={"bumps": 3, **more}, mesh=SMALL, strip_load=load)

    touching = press("rest")
    zero = press("zero", corner_gap=[0.0])
    checks.that("corner gaps of nothing: the answer to the last digit",
                (zero.history()["force"] == touching.history()["force"]).all())
    answer = press("corners", corner_gap=list(gaps))
    slopes = []
    for one in (answer, touching):
        rows = one.history()
        slopes.append(numpy.diff(rows["force"], prepend=0.0)/numpy.diff(rows["plate_travel"], prepend=0.0))
    checks.that("corner gaps: slopes never fall", (numpy.diff(slopes[0]) > -1.0e-6*slopes[1][0]).all())
    checks.that("hardly a force before the smallest gap", slopes[0][0] < 0.1*slopes[1][-1])
    checks.below("all bumps down: the slope of the strip that rests on all", slopes[0][-1]/slopes[1][-1] - 1.0, 1.0e-6)
    found = fields(answer)
    start = 0.0
    for bump, gap in enumerate(gaps):
        corners = (start, start + 2.0*FOIL["half_length"])[0 if bump else 1:]  # the first line of all is clamped
        at = numpy.array([abs(found["points"][:, 0] - x) < 1.0e-9 for x in corners]).any(axis=0)
        moved = found["displacement"][at, 1]
        checks.below(f"bump {bump + 1}: its corners have come down by their gap", numpy.abs(moved + gap).max()/gap, 1.0e-2)
        start += FOIL["pitch"]


def check_random(checks, folder):
    """The same seed gives the same strip; far beyond the deviations, stiffness is that without."""
    height = {"height_deviation": 0.5*MICROMETRE, "seed": 3}
    load = {"kind": "plates", "maximum_displacement": 20*MICROMETRE, "steps_up": 10, "steps_down": 0, **HELD}
    force = []
    for more, groups in ((height, {}), (height, {"model": {"reduction": "none"}}), ({}, {})):
        answer = solve(folder, "random", bump_foil={"bumps": 6, **more}, mesh=SMALL, strip_load=load, **groups)
        force.append(answer.history()["force"])
    checks.below("random heights, condensed and full", largest_difference(force[0], force[1]), 1.0e-8)
    slope = [numpy.diff(values)[-1] for values in force]
    checks.below("random heights, all crests loaded: stiffness", slope[0]/slope[2] - 1.0, 1.0e-6)
    checks.that(f"random heights lose force: {force[0][-1]:.3f} < {force[2][-1]:.3f} N", force[0][-1] < force[2][-1])


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_shift(checks, folder)
        check_kinks(checks, folder)
        check_corners(checks, folder)
        check_random(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
