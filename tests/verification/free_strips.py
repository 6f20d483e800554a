#!/usr/bin/env python3
"""Strips that friction alone holds, between plates, with crests that are not all at one height."""

import tempfile

import numpy

from gfb_run import Checks, largest_difference
from strips import FOIL, MICROMETRE, crests, solve

SMALL = {"arc_elements": 8, "flat_elements": 2, "axial_elements": 8}
GAPS = ([0.0, 2.0, 4.0, 0.0], [0.0, 2.0, 5.0, 1.0], [0.0, 9.0, 0.0, 0.0])  # um
TRAVEL = 8.0*MICROMETRE


def loop(folder, name, gap, friction=0.1, steps=10, contact=(), **groups):
    """Up and down between plates; few crests touch at first."""
    foil = {"fixed_edge": "none", "fixed_line": "half_flat", "bumps": len(gap)}
    foil["crest_gap"] = [MICROMETRE*one for one in gap]
    foil |= groups.pop("bump_foil", {})
    load = {"kind": "plates", "maximum_displacement": TRAVEL, "steps_up": steps, "steps_down": steps}
    load |= groups.pop("strip_load", {})
    contact = {"friction_top": friction, "friction_sleeve": friction, **dict(contact)}
    return solve(folder, name, bump_foil=foil, mesh=SMALL, contact=contact, strip_load=load, **groups)


def check_answers(checks, folder):
    """Every loop ends; a strip turned end for end, or not condensed, answers the same; all loops lose energy."""
    for gap in GAPS:
        words = "gaps " + ", ".join(f"{one:g}" for one in gap) + " um"
        one = loop(folder, "one", gap)
        turned = loop(folder, "turned", gap[::-1])
        full = loop(folder, "full", gap, model={"reduction": "none"})
        coulomb = loop(folder, "coulomb", gap, contact={"friction_law": "coulomb"})
        force = one.history()["force"]
        checks.below(f"{words}: turned end for end", largest_difference(turned.history()["force"], force), 1.0e-9)
        checks.below(f"{words}: its crests", largest_difference(crests(turned)[::-1], crests(one)), 1.0e-9)
        checks.below(f"{words}: not condensed", largest_difference(full.history()["force"], force), 1.0e-9)
        checks.below(f"{words}: Coulomb's law", largest_difference(coulomb.history()["force"], force), 1.0e-3)
        checks.that(f"{words}: the loop loses energy", one["dissipated_energy"] > 0.0)


def check_steps(checks, folder):
    """The work that a loop loses does not depend on its steps; few of them cut corners where crests meet the plate."""
    lost = [loop(folder, "steps", GAPS[0], steps=steps)["dissipated_energy"] for steps in (40, 80)]
    checks.below("40 steps against 80: lost work", lost[0]/lost[1] - 1.0, 1.0e-2)


def check_out_of_reach(checks, folder):
    """A strip that no plate has come to lies still, however its numbers are rounded; then it is met."""
    gap = [4.905, 4.843, 6.503]
    load = {"maximum_displacement": 8.7*MICROMETRE, "steps_up": 12, "steps_down": 6}
    rows = loop(folder, "far", gap, 0.142, contact={"friction_law": "coulomb"}, strip_load=load,
                bump_foil={"fixed_line": "flat"}).history()
    far = rows["plate_travel"] < min(gap)*MICROMETRE
    checks.that("out of reach: no force", far.sum() > 6 and numpy.abs(rows["force"][far]).max() < 1.0e-9*rows["force"].max())
    checks.that("in reach: force", (rows["force"][~far] > 0.0).all())


def check_heights(checks, folder):
    """Crests low by their bumps' heights: nearly the strip with gaps in their place."""
    height = [FOIL["height"] - MICROMETRE*one for one in GAPS[0]]
    low = loop(folder, "low", GAPS[0], bump_foil={"height": None, "crest_gap": None, "bump_height": height})
    force = loop(folder, "gaps", GAPS[0]).history()["force"]
    checks.below("low bumps against gaps", largest_difference(low.history()["force"], force), 1.0e-2)


def check_little_friction(checks, folder):
    """With less and less friction the force on the way up tends to that without, with first order."""
    for gap in GAPS:
        words = "gaps " + ", ".join(f"{one:g}" for one in gap) + " um"
        none = loop(folder, "none", gap, 0.0).history()["force"][:10]
        off = [numpy.abs(loop(folder, "some", gap, friction).history()["force"][:10] - none).max()/none.max()
               for friction in (0.04, 0.01)]
        print(f"       {words}: friction 0.04 and 0.01 change forces by", " ".join(f"{one:.1e}" for one in off))
        checks.within(f"{words}: of little friction a quarter changes so much less", off[0]/off[1], 3.0, 5.0)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_answers(checks, folder)
        check_steps(checks, folder)
        check_out_of_reach(checks, folder)
        check_heights(checks, folder)
        check_little_friction(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
