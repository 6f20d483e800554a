#!/usr/bin/env python3
"""Several equilibria of one bearing of beams: independent numbers, stability, starts, folds from both ends.

With --long the table on the paper's mesh, and the lifted branch on one of 832 elements.
"""

import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks
from shell_bearing import BEARING, MICROMETRE, PAPER_MESH, check_balance, solve

MODEL = {"foil": "beam", "film_scheme": "galerkin"}
# Independent beam model: e/C, smallest gap [um], lift of the leading edge [um], negative eigenvalues.
REFERENCE = {"resting": ((0.9182, 0.2711), 6.67, 0.0, 0), "middle": ((0.9320, 0.2377), 6.66, 21.0, 2),
             "lifted": ((0.9435, 0.2181), 6.60, 29.0, 3)}
NEUTRAL = 0.01  # stiffness over p_a/C that is next to none
LIFTED = 2.9e-5
CONVERGED = (0.9791, 0.2269)  # of the lifted branch; beam_bearing.py has the resting one's
LOADS = [100.0, 60.0, 30.0]
NARROW = {**PAPER_MESH, "axial_elements": 10}  # too few for the reference's gap, not for its positions


def beams(folder, name, **groups):
    """The reference bearing on beams with changed groups."""
    groups.setdefault("mesh", NARROW)
    return solve(folder, name, model=MODEL, **groups)


def nearest(rows, lift):
    """The row whose edge is lifted most nearly so [um]."""
    return int(numpy.argmin(numpy.abs(rows["leading_edge_lift"]/MICROMETRE - lift)))


def check_table(checks, folder, mesh):
    """The table of equilibria against the independent model's."""
    run = beams(folder, "all", mesh=mesh, options=["--branches"])
    rows = run.history()
    position = numpy.stack([rows["eccentricity_x"], rows["eccentricity_y"]], axis=1)/BEARING.clearance
    checks.that(f"{len(position)} equilibria were found, 3 are known", len(position) >= 3)
    checks.that("all are different", len(numpy.unique(numpy.round(position, 5), axis=0)) == len(position))
    for name, (wanted, gap, lift, negative) in REFERENCE.items():
        i = nearest(rows, lift)
        for axis, word in enumerate("xy"):
            checks.below(f"{name}: e_{word}/C {position[i, axis]:.5f}, off by", position[i, axis] - wanted[axis], 3.0e-3)
        found = rows["minimum_gap"][i]/MICROMETRE
        if mesh is PAPER_MESH:
            checks.below(f"{name}: smallest gap {found:.3f} um, off by", found - gap, 0.02)
        checks.below(f"{name}: lift, off by [um]", rows["leading_edge_lift"][i]/MICROMETRE - lift, 0.5)
        checks.that(f"{name}: {rows['stability'][i]:.0f} negative eigenvalues, {negative} expected",
                    rows["stability"][i] == negative)
        checks.that(f"{name}: it {'is stable' if negative == 0 else 'is not stable'}",
                    (rows["growing_modes"][i] == 0) == (negative == 0))
    checks.below("the middle one is nearly neutral", rows["stability_margin"][nearest(rows, 21.0)], NEUTRAL)
    checks.that("that is said", "nearly neutral" in run.log)
    checks.that("the determinant changes its sign from one to the next",
                all(rows["determinant_sign"][1:]*rows["determinant_sign"][:-1] == -1.0))
    with h5py.File(f"{run.stem}.{nearest(rows, 29.0) + 1}.top_foil.vtkhdf", "r") as file:
        lift = file["VTKHDF/PointData/displacement"][...][:, 1].max()
    checks.that("the lifted one's foil is written lifted", lift >= rows["leading_edge_lift"].max())
    return rows


def check_start(checks, folder, rows):
    """A scene starts where it asks to, on any number of ranks, and a sweep stays there."""
    i = nearest(rows, LIFTED/MICROMETRE)
    table = numpy.array([rows["eccentricity_x"][i], rows["eccentricity_y"][i]])
    for ranks in (1, 2):
        run = beams(folder, "start", ranks=ranks, operation={"leading_edge_lift": LIFTED})
        checks.below(f"{ranks} ranks: start on the lifted branch, off the table by",
                     numpy.abs(run.eccentricity - table).max()/BEARING.clearance, 1.0e-8)
        check_balance(checks, "lifted", run)
    swept = beams(folder, "swept", operation={"leading_edge_lift": LIFTED},
                  sweep={"parameter": "load", "values": [100.0, 110.0, 120.0]}).history()
    lift = swept["leading_edge_lift"]/MICROMETRE
    checks.within("a sweep stays on the branch: smallest lift [um]", lift.min(), 28.0, 36.0)
    checks.within("largest [um]", lift.max(), 28.0, 36.0)
    checks.that("and the determinant keeps its sign", len(set(swept["determinant_sign"])) == 1)
    resting = beams(folder, "resting", operation={"leading_edge_lift": 0.0})
    checks.below("asked for no lift: resting, lift [um]", resting["leading_edge_lift"]/MICROMETRE, 0.1)


def check_folds(checks, folder):
    """A branch round its fold, from both its ends."""
    sweep = {"parameter": "load", "values": LOADS, "turn_folds": True}
    there = beams(folder, "there", sweep=sweep).history()
    back = beams(folder, "back", sweep=sweep, operation={"leading_edge_lift": 1.49e-5}).history()
    for name, rows in (("from the resting end", there), ("from the other end", back)):
        checks.that(f"{name}: loads {', '.join(f'{load:.5g}' for load in rows['load'])} N",
                    len(rows["load"]) == 5 and list(rows["fold"]) == [0.0, 0.0, 1.0, 0.0, 0.0])
        checks.that(f"{name}: the determinant has changed its sign",
                    rows["determinant_sign"][0] == -rows["determinant_sign"][-1])
    checks.below("the fold's load from both ends, apart by [N]", there["load"][2] - back["load"][2], 1.0e-2)
    for name in ("eccentricity_x", "eccentricity_y", "leading_edge_lift", "minimum_gap"):
        off = numpy.abs(there[name] - back[name][::-1])/BEARING.clearance
        checks.below(f"{name} from both ends, at the loads", off[[0, 1, 3, 4]].max(), 1.0e-8)
    stopped = beams(folder, "stopped", status=2, sweep={"parameter": "load", "values": LOADS})
    checks.that("without turning the sweep stops at the fold, and says so", "ends in a fold" in stopped.log)
    checks.below("at the same load [N]", numpy.linalg.norm(stopped.force) - there["load"][2], 0.1)


def check_fine_mesh(checks, folder, pitch):
    """The lifted branch with so many elements a pitch."""
    run = beams(folder, "fine", operation={"leading_edge_lift": LIFTED}, mesh={
        "circumferential_elements": 26*pitch, "axial_elements": 16, "arc_elements": 3*pitch//2,
        "flat_elements": 3*pitch//8, "align_crests": True})
    for axis, word in enumerate("xy"):
        found = run.eccentricity[axis]/BEARING.clearance
        checks.below(f"{pitch} elements a pitch, lifted: e_{word}/C {found:.5f}, off by", found - CONVERGED[axis], 3.0e-3)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        if "--long" in sys.argv:
            check_table(checks, folder, PAPER_MESH)
            check_fine_mesh(checks, folder, 32)
        else:
            rows = check_table(checks, folder, NARROW)
            check_start(checks, folder, rows)
            check_folds(checks, folder)
            check_fine_mesh(checks, folder, 12)
    checks.close()


if __name__ == "__main__":
    main()
