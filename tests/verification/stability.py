#!/usr/bin/env python3
"""Whether foils stay where they are: a sheet's own stiffness, determinants, sweeps (resting bearings on the paper's
mesh are in shell_bearing.py and beam_bearing.py)."""

import math
import tempfile

import numpy

from gfb_run import Checks, observed_order
from shell_bearing import BEARING, INSIDE, SHEET, held, solve

COUNTED = {"solver": {"stability": True}}
FOILS = ("beam", "shell")
# Foils that no contact holds: the top foil is a sheet clamped at one edge.
LOOSE = {"contact": {"normal_stiffness": 1.0e-6, "friction_top": 0.0, "friction_sleeve": 0.0}}
PLACE = (22.0e-6, 8.0e-6)
CANTILEVER = 1.875104068711961  # cos a cosh a = -1
STEP = 1.0e-9                   # of the shaft, for differences [m]


def counted(folder, name, foil, model=None, **groups):
    """A bearing of foils whose growing modes are counted."""
    return solve(folder, name, model={"foil": foil, **(model or {})}, **COUNTED, **groups)


def check_held(checks, folder, run):
    """A shaft held where it was found: the same foils, without the shaft's equations."""
    there = counted(folder, "held", "beam", **held(run.eccentricity))
    checks.below("held at the equilibrium: margin", there["stability_margin"]/run["stability_margin"] - 1.0, 1.0e-6)
    checks.that("held at the equilibrium: no determinant", "determinant_sign" not in there.summary)


def check_same(checks, folder):
    """Counting changes nothing but four factorizations, ranks change nothing; the whole width changes nothing for
    beams, and can only add modes for shells."""
    for foil in FOILS:
        base = counted(folder, "base", foil)
        plain = solve(folder, "plain", model={"foil": foil})
        if foil == "beam":
            check_held(checks, folder, base)
        checks.that(f"{foil}: four factorizations tell it", base["factorizations"] == plain["factorizations"] + 4.0)
        checks.that(f"{foil}: nothing is counted unasked", "stability" not in plain.summary
                    and plain["determinant_sign"] == 1.0)
        others = {"2 ranks": {"ranks": 2}, "whole width": {"model": {"half_width": "no"}}}
        if foil == "beam":
            others |= {"3 ranks": {"ranks": 3}, "whole width, 2 ranks": {"model": {"half_width": "no"}, "ranks": 2}}
        for words, groups in others.items():
            other = counted(folder, "other", foil, **groups)
            for name in ("stability", "determinant_sign"):
                checks.that(f"{foil}, {words}: {name} {other[name]:.0f}", other[name] == base[name])
            off = other["stability_margin"]/base["stability_margin"] - 1.0
            if foil == "beam" or "whole" not in words:
                checks.below(f"{foil}, {words}: margin", off, 1.0e-8)
            else:
                checks.that(f"{foil}, {words}: margin no larger ({off:.1e})", off <= 1.0e-8)
        symmetric = "symmetric about z = 0" in base.log
        checks.that(f"{foil}: the log says what half the width shows", symmetric == (foil == "shell"))


def check_mesh(checks, folder):
    """The margin is that of the bearing, not of its mesh; a crest that sticks on one mesh and slides on another may
    change it by a fifth."""
    for aligned, limits in ((False, (0.03, 0.015)), (True, (0.25, 0.25))):
        margins = [counted(folder, "mesh", "beam", mesh={
            "circumferential_elements": 26*pitch, "axial_elements": 8, "arc_elements": 12, "flat_elements": 3,
            "align_crests": aligned})["stability_margin"] for pitch in (4, 8, 16)]
        words = f"crests {'on nodes' if aligned else 'inside elements'}, margins" \
            + "".join(f" {margin:.4f}" for margin in margins)
        for pitch, margin, limit in zip((4, 8), margins, limits):
            checks.below(f"{words}: {pitch} elements a pitch, off the finest by", margin/margins[-1] - 1.0, limit)


def check_sheet(checks, folder):
    """At rest the film is not there: the softest mode of a sheet that nothing holds is a cantilever's, D (a/l)^4."""
    rigidity = SHEET["youngs_modulus"]*SHEET["thickness"]**3/12.0
    stiffness = (rigidity/(1.0 - SHEET["poissons_ratio"]**2)*(CANTILEVER/(2.0*math.pi*BEARING.radius))**4
                 * BEARING.clearance/BEARING.ambient_pressure)
    errors = []
    for elements in (26, 52):
        run = counted(folder, "sheet", "beam", mesh={**INSIDE, "circumferential_elements": elements}, **LOOSE,
                      **held(PLACE, speed_rpm=0.0))
        checks.that(f"sheet of {elements} elements: stable, but nearly neutral",
                    run["stability"] == 0.0 and "(stable, one nearly neutral)" in run.log)
        errors.append(run["stability_margin"]/stiffness - 1.0)
    checks.below("sheet of beams: D (a/l)^4 of plane strain, off by", errors[-1], 5.0e-4)
    checks.within("sheet of beams: observed order", observed_order(*errors), 1.8, 2.2)
    plate = counted(folder, "sheet", "shell", **LOOSE, **held(PLACE, speed_rpm=0.0))["stability_margin"]/stiffness
    checks.within("sheet of shells: between plane stress and plane strain", plate,
                  1.0 - SHEET["poissons_ratio"]**2, 1.0)


def force_slope(folder, eccentricity, **groups):
    """Derivative of the film's force by the shaft's position, the foils following: central differences [N/m]."""
    slope = numpy.zeros((2, 2))
    for column in range(2):
        move = STEP*numpy.eye(2)[column]
        ends = [solve(folder, "slope", **groups, **held(eccentricity + sign*move)) for sign in (1.0, -1.0)]
        slope[:, column] = (ends[0].force - ends[1].force)/(2.0*STEP)
    return slope


def check_determinants(checks, folder):
    """Where the foils are stable the determinant has the sign of the force's slopes by the position."""
    scenes = {"rigid": {"foil": "rigid"}, "beams": {"foil": "beam"},
              "foundation": {"foil": "elastic_foundation", "foundation_stiffness": 5.0e9, "foundation_pressure": "local"}}
    for words, model in scenes.items():
        groups = {"model": model}
        if words != "beams":
            groups |= {"top_foil": None, "bump_foil": None, "contact": None,
                       "mesh": {"arc_elements": None, "flat_elements": None, "align_crests": None}}
        base = solve(folder, "base", operation={"load": (-50.0, 0.0)}, **groups)
        determinant = numpy.linalg.det(force_slope(folder, base.eccentricity, **groups))
        checks.that(f"{words}: slopes' determinant {determinant:.2e} N^2/m^2, sign {base['determinant_sign']:.0f}",
                    base["determinant_sign"] == numpy.sign(determinant))
    # At light loads a cold start may end where foils do not stay: every real mode that grows turns the sign, which
    # another library finds in another way.
    for load in (10.0, 20.0, 40.0, 60.0):
        run = counted(folder, "light", "beam", operation={"load": (-load, 0.0)})
        growing, margin, sign = (run[name] for name in ("stability", "stability_margin", "determinant_sign"))
        checks.that(f"beams under {load:.0f} N: {growing:.0f} modes grow (margin {margin:.2g}), sign {sign:.0f}",
                    sign == (-1.0)**growing)


def check_sweep(checks, folder):
    """Every point of a sweep has its own; a shaft that is held has no determinant."""
    loads = (60.0, 80.0, 100.0)
    rows = counted(folder, "sweep", "beam", sweep={"parameter": "load", "values": loads}).history()
    alone = counted(folder, "alone", "beam", operation={"load": (-loads[0], 0.0)})
    checks.that("sweep: one count a point", list(rows["stability"]) == [0.0]*3)
    checks.that("sweep: one determinant a point", list(rows["determinant_sign"]) == [1.0]*3)
    off = rows["stability_margin"][0]/alone["stability_margin"] - 1.0
    checks.below("sweep: margin of the first point", off, 1.0e-8)
    checks.that("sweep: margins differ", len(set(rows["stability_margin"])) == len(loads))
    rows = counted(folder, "held", "beam", sweep={"parameter": "tilt_x", "values": (1.0e-5, 2.0e-5),
                                                   "hold_position": True}).history()
    checks.that("held sweep: one count a point", list(rows["stability"]) == [0.0]*2)
    checks.that("held sweep: no determinants", "determinant_sign" not in rows)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_same(checks, folder)
        check_mesh(checks, folder)
        check_sheet(checks, folder)
        check_determinants(checks, folder)
        check_sweep(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
