#!/usr/bin/env python3
"""Thrust bearings with both foils as shells: condensed against full, one pad against all, stiffness against differences of forces,
derivatives against differences of answers, strips side by side, the crests' forces against the film's, ranks, restart.

Their strips alone are held against solids in tests/unit/model/structure/sector_strip_test.pf."""

import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, solve
from thrust import PADS, TIGHT, coefficients, thrust

TOP = {"thickness": 1.5e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29}
BUMPS = {"bumps": 4, "half_length": 1.5e-3, "height": 5.0e-4, "thickness": 1.0e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29}
RUBS = {"friction_top": 0.1, "friction_sleeve": 0.1}
SMOOTH = {"friction_top": 0.0, "friction_sleeve": 0.0}
MESH = {"circumferential_elements": 12, "radial_elements": 4, "arc_elements": 8, "flat_elements": 2}
LOAD = {"axial_load": 100.0}
DERIVED = ("axial_gap", "maximum_top_foil_stress", "maximum_bump_foil_stress")


def shells(operation, analysis="equilibrium", model=None, contact=None, bumps=None, **more):
    """Groups of a small thrust bearing with shells."""
    groups = {"ramp": {"part": 0.2, "height": 2.0e-5}, "top_foil": TOP, "bump_foil": BUMPS | (bumps or {}),
              "contact": contact or RUBS, "mesh": MESH} | TIGHT
    for group, keys in more.items():
        groups[group] = groups.get(group, {}) | keys
    return thrust(operation, analysis, {"foil": "shell"} | (model or {}), **groups)


def largest(first, second):
    """Difference of matrices over the size of their entries."""
    size = numpy.sqrt(numpy.abs(numpy.outer(first[0].diagonal(), first[0].diagonal())))
    return float((numpy.abs(first - second)/size).max())


def check_same(checks, folder):
    """Condensed and full, one pad and all of them, one rank and two: the same answers."""
    names = ("axial_gap", "friction_torque", "minimum_gap", "maximum_deflection", "line_force_2")
    dynamics = {"dynamics": {"frequency_ratios": 0.5}}
    one = solve(folder, "one", shells(LOAD, "linear_dynamics", **dynamics))
    every = solve(folder, "every", shells(LOAD | {"tilt": (1.0e-30, 0.0)}, "linear_dynamics", **dynamics))
    full = solve(folder, "full", shells(LOAD, "linear_dynamics", {"reduction": "none"}, **dynamics))
    two = solve(folder, "two", shells(LOAD, "linear_dynamics", **dynamics), ranks=2)
    checks.that("an aligned runner: one pad is solved, of a tilted one all", (one["pads_solved"], every["pads_solved"]) == (1, PADS))
    for title, other in (("condensed against full", full), ("one pad against all", every), ("two ranks", two)):
        for name in names:
            checks.below(f"{title}: {name}", one[name]/other[name] - 1.0, 1.0e-8)
        for name, first, second in zip(("K", "C"), coefficients(one), coefficients(other), strict=True):
            checks.below(f"{title}: {name}", largest(first, second), 1.0e-7)
    for surface, size in (("top_foil", every["maximum_deflection"]), ("bump_foil", every["maximum_deflection"])):
        with h5py.File(f"{one.stem}.{surface}_5.vtkhdf", "r") as file, h5py.File(f"{every.stem}.{surface}_5.vtkhdf", "r") as other:
            for name, of in (("Points", 0.05), ("PointData/displacement", size)):
                away = numpy.abs(file[f"VTKHDF/{name}"][...] - other[f"VTKHDF/{name}"][...]).max()
                checks.below(f"one pad against all: {name} of {surface} 5", float(away)/of, 1.0e-8)
    return one


def check_forces(checks, one):
    """The film presses the top foil, which hangs on crests and its fixed edge; the friction states are where contacts are."""
    carried = PADS*sum(one[f"line_force_{number}"] for number in range(1, 5))
    checks.that(f"crests carry {100.0*carried/one['axial_force']:.0f} % of the film's force, the fixed edge the rest",
                0.6 < carried/one["axial_force"] < 1.0)
    with h5py.File(f"{one.stem}.h5", "r") as file:
        radius, along = file["contact/top/position_z"][...], file["contact/top/position_x"][...]
        line, force = file["contact/top/line"][...], file["contact/top/normal_force"][-1]
    checks.below("contacts lie between the radii", max(radius.max()/0.05, 0.025/radius.min()) - 1.0, 1.0e-12)
    angle = along/radius
    spread = max(numpy.ptp(angle[line == number]) for number in range(1, 5))
    checks.below("a crest is a ray", float(spread), 1.0e-12)
    # By the trapezoidal rule, as the contacts stand for their shares of a line.
    whole = 0.0
    for number in range(1, 5):
        at, here = radius[line == number], force[line == number]
        whole += float(numpy.sum(0.5*(here[1:] + here[:-1])*numpy.diff(at)))
    checks.below("forces of the contacts against those of the crests", PADS*whole/carried - 1.0, 1.0e-9)


def check_stiffness(checks, folder):
    """At rest stiffness is the rate of the forces, where nothing rubs or opens."""
    held = {"axial_gap": 1.2e-5, "tilt": (2.0e-5, -1.0e-5)}
    answer = solve(folder, "slow", shells(held, "linear_dynamics", contact=SMOOTH, dynamics={"frequencies": 1.0e-3}))
    found = coefficients(answer)[0][0]
    steps = {"axial_gap": 1.0e-9, "tilt_x": 2.0e-8, "tilt_y": 2.0e-8}
    for column, (name, step) in enumerate(steps.items()):
        sides = []
        for sign in (1.0, -1.0):
            tilt = list(held["tilt"])
            gap = held["axial_gap"]
            if column == 0:
                gap += sign*step
            else:
                tilt[column - 1] += sign*step
            moved = solve(folder, "moved", shells({"axial_gap": gap, "tilt": tuple(tilt)}, "fixed_position", contact=SMOOTH))
            sides.append(numpy.array([moved["axial_force"], moved["torque_x"], moved["torque_y"]]))
        rate = (-1.0 if column == 0 else 1.0)*(sides[0] - sides[1])/(2.0*step)  # the sleeve moves by minus the gap
        size = numpy.sqrt(numpy.abs(found.diagonal()*found[column, column]))
        checks.below(f"stiffness by {name} against differences", float((numpy.abs(found[:, column] - rate)/size).max()), 1.0e-7)


def check_derivatives(checks, folder):
    """Derivatives by keys of both foils against differences of answers, without friction, whose slip remembers."""
    named = {"bump_foil%thickness": 1.0e-4, "bump_foil%half_length": 1.5e-3, "bump_foil%height": 5.0e-4, "top_foil%thickness": 1.5e-4}
    derived = solve(folder, "derived", shells(LOAD, contact=SMOOTH, sensitivity={"quantity": DERIVED, "parameters": tuple(named)}))
    for key, value in named.items():
        group, name = key.split("%")
        step = 1.0e-3*value
        ahead, behind = (solve(folder, "moved", shells(LOAD, contact=SMOOTH, **{group: (TOP if group == "top_foil" else BUMPS)
                                                                                | {name: value + sign*step}})) for sign in (1.0, -1.0))
        for quantity in DERIVED:
            rate = (ahead[quantity] - behind[quantity])/(2.0*step)
            checks.below(f"{quantity} by {key} against differences", derived[f"d_{quantity}_d_{group}_{name}"]/rate - 1.0, 1.0e-4)


def check_strips(checks, folder):
    """Strips that nearly touch deflect where each repeats at its own mean radius; strips and edges of all kinds have answers."""
    cut = {"strips": 2, "cut_width": 1.0e-3}
    full, condensed = (solve(folder, "cut", shells(LOAD, model={"reduction": way}, bumps=cut | {"fixed_edge": "leading"}))
                       for way in ("none", "guyan"))
    for name in ("axial_gap", "minimum_gap", "line_force_1"):
        checks.below(f"two strips, condensed against full: {name}", condensed[name]/full[name] - 1.0, 1.0e-8)
    turned = solve(folder, "turned", shells(LOAD, bumps=cut | {"fixed_edge": "leading"}, pads={"first_leading_edge": 1.0}))
    checks.below("pads that begin elsewhere: axial_gap", turned["axial_gap"]/condensed["axial_gap"] - 1.0, 1.0e-9)


def check_straight(checks, folder):
    """Straight strips: condensed against full, one pad against all, two ranks; far from the axis they are curved ones, with 1/r^2."""
    straight = {"strip_form": "straight", "strips": 2, "cut_width": 1.0e-3}
    one = solve(folder, "one", shells(LOAD, "linear_dynamics", bumps=straight, dynamics={"frequency_ratios": 0.5}))
    for title, other in (
            ("condensed against full", solve(folder, "full", shells(LOAD, "linear_dynamics", {"reduction": "none"}, bumps=straight,
                                                                    dynamics={"frequency_ratios": 0.5}))),
            ("one pad against all", solve(folder, "every", shells(LOAD | {"tilt": (1.0e-30, 0.0)}, "linear_dynamics", bumps=straight,
                                                                  dynamics={"frequency_ratios": 0.5}))),
            ("two ranks", solve(folder, "two", shells(LOAD, "linear_dynamics", bumps=straight, dynamics={"frequency_ratios": 0.5}), ranks=2))):
        for name in ("axial_gap", "minimum_gap", "maximum_deflection", "line_force_3"):
            checks.below(f"straight strips, {title}: {name}", one[name]/other[name] - 1.0, 1.0e-8)
        checks.below(f"straight strips, {title}: K", largest(coefficients(one)[0], coefficients(other)[0]), 1.0e-7)
    away, radii = [], (1.0, 2.0)
    for radius in radii:
        both = [solve(folder, "far", shells(
            {"axial_gap": 1.2e-5, "speed_rpm": 40000.0*0.0375/radius}, "fixed_position", bumps={"strip_form": form}, mesh=MESH | {"align_crests": False},
            bearing={"outer_radius": radius + 0.0125, "inner_radius": radius - 0.0125}, pads={"count": 1, "arc": 0.03/radius}))
                for form in ("straight", "curved")]
        away.append(abs(both[0]["axial_force"]/both[1]["axial_force"] - 1.0))
    checks.below(f"straight against curved, mean radius {radii[1]:g} m: axial force", away[1], 5.0e-4)
    checks.below("the difference falls nearly as the square of the curvature", numpy.log2(away[0]/away[1]) - 2.0, 0.2)


def check_soft_start(checks, folder):
    """A tilted runner from nothing over foils that no film presses yet: soft two-way contacts lead to speed, which are then released.
    With hard ones, which every least film decides anew, the search is lost on the way for some hundred factorizations."""
    answer = solve(folder, "soft", {
        "scene": {"analysis": "equilibrium"},
        "bearing": {"kind": "thrust", "outer_radius": 42.7e-3, "inner_radius": 21.2e-3},
        "pads": {"count": 3, "arc": 1.93},
        "ramp": {"part": 0.328, "height": 17.2e-6},
        "gas": {"viscosity": 2.76e-5, "ambient_pressure": 101300.0},
        "operation": {"speed_rpm": 25850.0, "axial_load": 198.0, "tilt": (-1.75e-5, 2.45e-5)},
        "model": {"foil": "shell"},
        "top_foil": {"thickness": 0.11e-3, "youngs_modulus": 187.0e9, "poissons_ratio": 0.3},
        "bump_foil": {"bumps": 11, "pitch": 3.766e-3, "half_length": 1.586e-3, "height": 0.533e-3, "thickness": 0.125e-3,
                      "youngs_modulus": 210.0e9, "poissons_ratio": 0.29},
        "contact": {"friction_top": 0.252, "friction_sleeve": 0.223, "contact_surface": "mid"},
        "mesh": {"circumferential_elements": 17, "radial_elements": 4, "arc_elements": 4, "flat_elements": 2},
        "solver": {"maximum_factorizations": 150},
        "output": {"fields": "none"},
    })
    checks.below("soft start: the film carries the load", answer["axial_force"]/198.0 - 1.0, 1.0e-8)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        if "--long" in sys.argv:
            check_soft_start(checks, folder)
            checks.close()
        one = check_same(checks, folder)
        check_forces(checks, one)
        check_stiffness(checks, folder)
        check_derivatives(checks, folder)
        check_strips(checks, folder)
        check_straight(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
