#!/usr/bin/env python3
"""Contact at the foils' faces: against solids, whole and condensed, on ranks, of beams and of shells."""

import tempfile

import numpy

from bump_sizes import BEARING, bearing
from contact_strips import AS_REFERENCE, FORCE, PAIR, squeezed
from gfb_run import Checks, natural_sizes, summary_difference
from solid_strip import Strip, loop
from strips import FOIL

CASE_1 = {"thickness": 0.102e-3, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3}
STEPS = 20


def check_solids(checks, folder):
    """What contact at the faces changes in a loop, by shells and by plane-strain solids: travel, and energy lost."""
    for words, foil, bumps, friction, clamped in (("case 2, clamped", {}, 1, 0.2, True),
                                                  ("case 1, free", CASE_1, 1, 0.2, False),
                                                  ("case 1, clamped", CASE_1, 2, 0.2, True),
                                                  ("case 1, free", CASE_1, 4, 0.5, False)):
        foil = {**PAIR, **foil, "bumps": bumps, "poissons_ratio": 0.0}
        held = {"fixed_edge": "leading", "fixed_line": "corner"} if clamped else {}
        found = {}
        for surface in ("mid", "face"):
            shells = squeezed(folder, "loop", friction, STEPS, bump_foil={**foil, **held},
                              mesh={"arc_elements": 64, "flat_elements": 8, "axial_elements": 2},
                              contact={**AS_REFERENCE, "friction_law": "coulomb", "contact_surface": surface})
            solid = loop(Strip(foil, surface, clamped=clamped), friction, FORCE*bumps/foil["width"], STEPS)
            found[surface] = (shells["maximum_deflection"], shells["dissipated_energy"], solid[0],
                              solid[1]*foil["width"])
            words_here = f"{words}, {bumps} bumps, {surface}"
            for name, here, limit in (("travel", 0, 2.0e-3), ("energy", 1, 5.0e-3)):
                checks.below(f"{words_here}: {name} against solids",
                             found[surface][here]/found[surface][here + 2] - 1.0, limit)
        change = [face/mid - 1.0 for face, mid in zip(found["face"], found["mid"])]
        print(f"       {words}, {bumps} bumps: faces change travel and energy by {100*change[0]:.2f} and "
              f"{100*change[1]:.2f} %, of solids {100*change[2]:.2f} and {100*change[3]:.2f} %")
        checks.below(f"{words}, {bumps} bumps: change of the travel against solids'", change[0] - change[2], 5.0e-4)
        checks.below(f"{words}, {bumps} bumps: change of the energy against solids'", change[1] - change[3], 2.0e-3)


def check_same(checks, folder):
    """Condensed as whole, on one rank as on several, strips and bearings."""
    mesh = {"arc_elements": 8, "flat_elements": 2, "axial_elements": 6}
    face = {"contact_surface": "face"}
    foil = {"bump_thickness": [0.12e-3, 0.127e-3, 0.13e-3, 0.125e-3], "thickness": None}
    foil = {**PAIR, **foil}
    plain = squeezed(folder, "plain", steps=5, mesh=mesh, contact=face, bump_foil=foil)
    for words, more in (("not condensed", {"model": {"reduction": "none"}}), ("two ranks", {"ranks": 2})):
        other = squeezed(folder, "other", steps=5, mesh=mesh, contact=face, bump_foil=foil, **more)
        for name in ("maximum_deflection", "dissipated_energy", "maximum_force"):
            checks.below(f"strip, {words}: {name}", other[name]/plain[name] - 1.0, 1.0e-9)
    bumps = 24
    foil = {**FOIL, "bumps": bumps, "fixed_edge": "trailing", "fixed_line": "half_flat",
            "pitch": 2.0*numpy.pi*BEARING.radius/bumps}
    law = {"friction_top": 0.1, "friction_sleeve": 0.1}
    for model in ("beam", "shell"):
        mid = bearing(folder, "mid", foil, model, contact=law)
        one = bearing(folder, "one", foil, model, contact={**law, **face})
        two = bearing(folder, "two", foil, model, ranks=2, contact={**law, **face})
        checks.below(f"{model}s: two ranks", summary_difference(two, one, natural_sizes(BEARING))[0], 1.0e-8)
        checks.within(f"{model}s: force at the faces over that at mid-surfaces", one["force_x"]/mid["force_x"], 1.001, 1.02)
    whole = bearing(folder, "whole", foil, "shell", contact={**law, **face}, model={"reduction": "none"})
    checks.below("shells, not condensed", summary_difference(whole, one, natural_sizes(BEARING))[0], 1.0e-9)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_solids(checks, folder)
        check_same(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
