#!/usr/bin/env python3
"""Contact at faces and at mid-surfaces against solids that move far: what small displacements cost, and that it is
they."""

import tempfile

from contact_faces import CASE_1
from contact_strips import AS_REFERENCE, PAIR, squeezed
from gfb_run import Checks
from large_strip import LargeStrip, moved_loop

STEPS = 20
THICK = {"thickness": 0.15e-3, "youngs_modulus": 200.0e9, "poissons_ratio": 0.3, "half_length": 2.4e-3, "height": 0.7e-3,
         "pitch": 5.8e-3, "bumps": 2, "width": 20.0e-3, "fixed_edge": "leading", "fixed_line": "flat"}
HELD = {"fixed_edge": "leading", "fixed_line": "corner"}
STRIPS = (("thick, clamped", THICK, 0.1, 50.0e-6),
          ("case 2, clamped", {"bumps": 1, "poissons_ratio": 0.0, **HELD}, 0.2, 60.0e-6),
          ("case 1, free", {**CASE_1, "bumps": 1, "poissons_ratio": 0.0}, 0.2, 30.0e-6),
          ("case 1, clamped", {**CASE_1, "bumps": 2, "poissons_ratio": 0.0, **HELD}, 0.2, 25.0e-6))


def shells(folder, foil, friction, travel, surface):
    """Energy that the program's strip loses."""
    answer = squeezed(folder, "loop", friction, STEPS, bump_foil=foil,
                      strip_load={"maximum_displacement": travel},
                      mesh={"arc_elements": 48, "flat_elements": 8, "axial_elements": 2 if foil["poissons_ratio"] == 0.0
                            else 16},
                      contact={**AS_REFERENCE, "friction_law": "coulomb", "contact_surface": surface})
    return answer["dissipated_energy"]


def check_strips(checks, folder):
    """Loss of shells against solids of small displacements, and those against large ones."""
    for words, foil, friction, travel in STRIPS:
        foil = {**PAIR, **foil}
        share, clamped = travel/foil["height"], foil["fixed_edge"] == "leading"
        (soft, small), (softer, large) = (moved_loop(LargeStrip(foil, "face", clamped, far), friction, travel, STEPS)
                                          for far in (False, True))
        middle = moved_loop(LargeStrip(foil, "mid", clamped, False), friction, travel, STEPS)[1]
        mid, face = (shells(folder, foil, friction, travel, surface) for surface in ("mid", "face"))
        words = f"{words}, {foil['bumps']} bumps"
        print(f"       {words}, travel {100*share:.1f} % of the height: mid, face and solids of small displacements are "
              f"off by {100*(mid/large - 1):+.1f}, {100*(face/large - 1):+.1f} and {100*(small/large - 1):+.1f} %")
        checks.below(f"{words}: faces against solids of small displacements", face/small - 1.0, 1.0e-2)
        checks.below(f"{words}: mid-surfaces against such solids", mid/middle - 1.0, 1.0e-2)
        checks.within(f"{words}: loss by displacements over travel by height", (large/small - 1.0)/share, -1.1, -0.7)
        checks.within(f"{words}: force by displacements over travel by height", (softer/soft - 1.0)/share, -0.5, -0.2)


def check_limit(checks, folder):
    """What is left between faces and solids goes with the travel; what is left of mid-surfaces does not."""
    words, foil, friction, travel = STRIPS[1]
    foil, off = {**PAIR, **foil}, {}
    for part in (1.0, 0.25):
        solid = moved_loop(LargeStrip(foil, "face"), friction, part*travel, STEPS)[1]
        off[part] = [shells(folder, foil, friction, part*travel, surface)/solid - 1.0 for surface in ("mid", "face")]
        print(f"       {words}, travel {1e6*part*travel:g} um: mid-surfaces are off by {100*off[part][0]:+.2f}, faces by "
              f"{100*off[part][1]:+.2f} %")
    checks.below(f"{words}, a quarter of the travel: faces are off by a quarter", off[0.25][1] - 0.25*off[1.0][1], 2.0e-3)
    checks.that(f"{words}, a quarter of the travel: faces are nearer", abs(off[0.25][1]) < 0.6*abs(off[0.25][0]))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_strips(checks, folder)
        check_limit(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
