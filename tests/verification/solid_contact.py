#!/usr/bin/env python3
"""A shaft that touches: its closed form at rest, lift-off, touch-down with an answer, and the same on any ranks.

At rest the film is at ambient pressure. In a full ring the asperities of a shaft at eccentricity e carry
W = 2 pi R L p_0 exp(-C/s) I_1(e/s) and brake with mu 2 pi R^2 L p_0 exp(-C/s) I_0(e/s), s their mean height.
"""

import math
import pathlib
import tempfile

import numpy

from gfb_run import Bearing, Checks, largest_difference, natural_sizes, observed_order, run, summary_difference

RING = Bearing(leading_edge_condition="periodic")
PAD = Bearing()
ROUGH = {"roughness": 1.0e-6, "pressure": 5.0e7, "friction": 0.12}
GROUPS = {"shaft_contact": ROUGH}
MEAN = {"foundation_stiffness": 2.0e10, "foundation_pressure": "axial_mean"}
GU2020 = Bearing(radius=0.01905, length=0.0381, clearance=31.8e-6, viscosity=1.95e-5, ambient_pressure=1.0135e5)
FOILS = {
    "top_foil": {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29},
    "bump_foil": {"bumps": 26, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "width": 38.1e-3,
                  "thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
}


def bessel(order, x, points=4096):
    """I_n(x) by its integral; the trapezoidal rule is exact to round-off there."""
    angle = 2.0*math.pi*numpy.arange(points)/points
    return float(numpy.mean(numpy.exp(x*numpy.cos(angle))*numpy.cos(order*angle)))


def closed_form(bearing, e):
    """Force and friction torque of a shaft at rest."""
    pressure = ROUGH["pressure"]*math.exp(-bearing.clearance/ROUGH["roughness"])
    area = 2.0*math.pi*bearing.radius*bearing.length
    return (area*pressure*bessel(1, e/ROUGH["roughness"]),
            ROUGH["friction"]*bearing.radius*area*pressure*bessel(0, e/ROUGH["roughness"]))


def check_position(checks, folder):
    """Held at rest: the closed form, with the mesh's square; the largest pressure at the thinnest film."""
    e = 14.5e-6
    force, torque = closed_form(RING, e)
    for order, least, most in (1, 1.8, 2.5), (2, 3.5, 9.0):
        errors = []
        for elements in 32, 64, 128:
            answer = run(folder, "held", RING, mesh=(elements//order, 8//order), eccentricity=(e, 0.0),
                         groups=GROUPS | {"model": {"film_order": order}})
            errors.append(answer["force_x"]/-force - 1.0)
        checks.below(f"order {order}: force of the finest mesh", errors[-1], 1.0e-3)
        for coarse, fine in zip(errors, errors[1:]):
            checks.within(f"order {order}: order of the force", observed_order(coarse, fine), least, most)
        checks.below(f"order {order}: friction torque", answer["friction_torque"]/torque - 1.0, 1.0e-4)
        checks.below(f"order {order}: all of both is solid", abs(answer["solid_contact_force_x"]/answer["force_x"] - 1.0)
                     + abs(answer["solid_contact_torque"]/answer["friction_torque"] - 1.0), 1.0e-9)
    checks.below("no power at rest", answer["power_loss"], 0.0)
    peak = ROUGH["pressure"]*math.exp(-answer["minimum_gap"]/ROUGH["roughness"])
    checks.below("largest solid pressure", answer["maximum_solid_contact_pressure"]/peak - 1.0, 1.0e-9)
    film = answer.film_arrays()
    wanted = ROUGH["pressure"]*numpy.exp(-film["gap"]/ROUGH["roughness"])
    checks.below("field of the solid pressure", largest_difference(film["solid_contact_pressure"], wanted), 1.0e-9)


def check_rest(checks, folder):
    """A load at rest finds its eccentricity, opposite to itself, also in one that fills almost the clearance."""
    for e, direction in (14.5e-6, 0.4), (19.0e-6, 3.5):
        force, torque = closed_form(RING, e)
        load = force*numpy.array([math.cos(direction), math.sin(direction)])
        answer = run(folder, "rest", RING, mesh=(160, 8), load=tuple(load), groups=GROUPS)
        found = answer.eccentricity
        # 1/3 per mille of force are 1/3 per mille of s in the position
        checks.below(f"{force:.4g} N at rest: position", numpy.abs(found + e*load/force).max()/ROUGH["roughness"], 2.0e-3)
        checks.below(f"{force:.4g} N at rest: balance", numpy.abs(answer.force - load).max()/force, 1.0e-6)
        checks.below(f"{force:.4g} N at rest: torque", answer["friction_torque"]/torque - 1.0, 2.0e-3)


def check_lift_off(checks, folder):
    """Down to rest: force = load all the way; what touches and brakes is the film first, then the asperities."""
    load = (-60.0, 20.0)
    speeds = (60000.0, 30000.0, 10000.0, 3000.0, 1000.0, 300.0, 0.0)
    answer = run(folder, "stop", PAD, mesh=(64, 8), load=load, speed_rpm=speeds[0],
                 groups=GROUPS | {"sweep": {"parameter": "speed_rpm", "values": speeds}})
    rows = answer.history()
    wrong = numpy.hypot(rows["force_x"] - load[0], rows["force_y"] - load[1])/math.hypot(*load)
    checks.below("sweep to rest: balance", float(wrong.max()), 1.0e-6)
    share = -(rows["solid_contact_force_x"]*load[0] + rows["solid_contact_force_y"]*load[1])/-math.hypot(*load)**2
    checks.that("sweep to rest: the share of the asperities grows", bool(numpy.all(numpy.diff(share) > 0.0)))
    checks.below("lifted off: share of the asperities", float(share[0]), 1.0e-3)
    checks.below("at rest: share of the film", float(share[-1] - 1.0), 1.0e-6)
    checks.that("friction has its least between", 0 < int(numpy.argmin(rows["friction_torque"])) < len(speeds) - 1)
    once = run(folder, "again", PAD, mesh=(64, 8), load=load, speed_rpm=300.0, groups=GROUPS)
    checks.below("the same from nothing", abs(once["minimum_gap"]/rows["minimum_gap"][5] - 1.0), 1.0e-6)
    held = run(folder, "held", PAD, mesh=(64, 8), eccentricity=tuple(once.eccentricity), speed_rpm=300.0)
    carried = once.force - held.force - [once["solid_contact_force_x"], once["solid_contact_force_y"]]
    checks.below("film plus asperities is the force", numpy.abs(carried).max()/math.hypot(*load), 1.0e-6)
    braked = once["friction_torque"] - held["friction_torque"] - once["solid_contact_torque"]
    checks.below("and the friction torque", braked/once["friction_torque"], 1.0e-6)
    checks.that("names are there where they are asked for", "solid_contact_torque" not in held.summary)


def check_touch_down(checks, folder):
    """A load far beyond the film: refused without the group, an answer with it."""
    for words, foil, groups in ("rigid", "rigid", {}), ("springs", "elastic_foundation", {"model": MEAN}):
        for size in 3.0e3, 1.5e4:  # asperities under no gap carry 22 kN
            base = {"mesh": (64, 8), "load": (-size, 0.3*size), "foil": foil, "speed_rpm": 200.0}
            if foil == "rigid":
                run(folder, "bare", PAD, status=2, groups=groups, **base)
            answer = run(folder, "touch", PAD, groups=groups | GROUPS, **base)
            wrong = numpy.abs(answer.force - numpy.array(base["load"])).max()/size
            checks.below(f"{words}, {size:g} N: balance", wrong, 1.0e-6)
            checks.that(f"{words}, {size:g} N: the asperities carry", abs(answer["solid_contact_force_x"]) > 0.5*size)
            checks.that(f"{words}, {size:g} N: a gap", answer["minimum_gap"] > 0.0)


def check_slopes(checks, folder):
    """The torque's derivatives by a tilt are those of its differences."""
    step, middle = 1.0e-6, 5.0e-5
    for words, foil, groups in ("rigid", "rigid", {}), ("springs", "elastic_foundation", {"model": MEAN}):
        for held in False, True:
            sweep = {"parameter": "tilt_x", "values": (middle - step, middle, middle + step), "hold_position": held}
            answer = run(folder, "slopes", PAD, mesh=(64, 8), load=(-200.0, 30.0), speed_rpm=1000.0, foil=foil,
                         groups=groups | GROUPS | {"sweep": sweep})
            rows = answer.history()
            for axis in "xy":
                slope = (rows[f"torque_{axis}"][2] - rows[f"torque_{axis}"][0])/(2.0*step)
                checks.below(f"{words}, {'held' if held else 'floating'}: slope of torque_{axis}",
                             rows[f"angular_stiffness_{axis}x"][1]/slope - 1.0, 1.0e-4)


def check_foils(checks, folder):
    """Foils under a shaft at rest, and far beyond what the film carries: balance, and a gap."""
    cases = (("beam", (78, 4), (-60.0, 20.0), 0.0), ("beam", (78, 4), (-3000.0, 100.0), 1000.0),
             ("shell", (52, 4), (-60.0, 20.0), 0.0), ("shell", (52, 4), (-500.0, 50.0), 500.0))
    for foil, mesh, load, speed in cases:
        answer = run(folder, "foils", GU2020, mesh=mesh, load=load, speed_rpm=speed, foil=foil, groups=FOILS | GROUPS)
        words = f"{foil}, {load[0]:g} N, {speed:g} rpm"
        wrong = numpy.abs(answer.force - numpy.array(load)).max()/math.hypot(*load)
        checks.below(f"{words}: balance", wrong, 1.0e-6)
        share = answer["solid_contact_force_x"]/load[0]
        checks.within(f"{words}: share of the asperities", share, 0.99, 1.0 + 1.0e-6)
        checks.that(f"{words}: a gap", answer["minimum_gap"] > 0.0)


def check_ranks(checks, folder):
    """One rank and two."""
    cases = {"rigid, tilted": (PAD, {"mesh": (64, 8), "load": (-80.0, 10.0), "speed_rpm": 500.0, "tilt": (1.0e-4, 5.0e-5)},
                               {}),
             "springs": (PAD, {"mesh": (64, 8), "load": (-300.0, 10.0), "speed_rpm": 500.0, "foil": "elastic_foundation"},
                         {"model": MEAN}),
             "beams": (GU2020, {"mesh": (78, 4), "load": (-100.0, 20.0), "speed_rpm": 1000.0, "foil": "beam"}, FOILS)}
    for words, (bearing, case, groups) in cases.items():
        answers = [run(folder, "ranks", bearing, ranks=ranks, groups=groups | GROUPS, **case) for ranks in (1, 2)]
        sizes = natural_sizes(bearing) | {f"{edge}_edge_lift{where}": bearing.clearance
                                          for edge in ("leading", "trailing") for where in ("", "_edge")}
        worst, name = summary_difference(*answers, sizes)
        checks.below(f"{words}: 1 and 2 ranks ({name})", worst, 1.0e-8)
        wrong = numpy.abs(answers[0].force - numpy.array(case["load"])).max()/math.hypot(*case["load"])
        checks.below(f"{words}: balance", wrong, 1.0e-6)
        checks.that(f"{words}: it touches", answers[0]["maximum_solid_contact_pressure"] > 1.0e4)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for check in check_position, check_rest, check_lift_off, check_touch_down, check_slopes, check_foils, \
                check_ranks:
            check(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
