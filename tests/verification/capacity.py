#!/usr/bin/env python3
"""Limits: load capacity, lift-off speed and misalignment allowance, found from both sides and by bisection.

The other way to each of them are plain equilibrium runs, every one from nothing: bisection, or one run a millionth before the
limit and one a millionth beyond it.
"""

import copy
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

import numpy

from gfb_run import GFB, Bearing, Checks, observed_order, solve, summary_difference, write_case

SAME = 1.0e-6      # of two ways to a limit
GAP, GAP_4, GAP_5 = 3.0e-6, 4.0e-6, 5.0e-6  # [m]
PART = 0.01        # of the load, on asperities
FEW = 100          # factorizations of a limit of shells, its start with them
MESHES = (32, 64, 128)  # nodes around
POUNDS = 0.0254**3*1000.0*numpy.pi/30.0/4.4482216152605  # lbf/(in^3 krpm) over N s/m^3
GU2020 = Bearing(radius=0.01905, length=0.0381, clearance=31.8e-6, viscosity=1.95e-5, ambient_pressure=1.0135e5)
SPRINGS = {"foil": "elastic_foundation", "foundation_pressure": "axial_mean", "foundation_stiffness": 4.8e9}
FOILS = {
    "top_foil": {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing"},
    "bump_foil": {"bumps": 26, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "thickness": 0.102e-3,
                  "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing", "fixed_line": "half_flat"},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
}
BEARING_30 = {"radius": 15.0e-3, "length": 30.0e-3, "clearance": 25.0e-6}  # an engineer's, 30 mm
FOIL_30 = {"thickness": 0.1e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
BEAMS = {"model": {"foil": "beam"}, "mesh": (52, 4)} | FOILS
ROUGH = {"shaft_contact": {"roughness": 0.4e-6, "pressure": 5.0e7}}


def case(analysis, capacity=None, model=None, mesh=(60, 8), load=50.0, speed_rpm=30000.0, **groups):
    """A case of the bearing of [Gu2020] on springs, or on what `model` says."""
    content = {
        "scene": {"analysis": analysis},
        "bearing": {"radius": GU2020.radius, "length": GU2020.length, "clearance": GU2020.clearance},
        "gas": {"viscosity": GU2020.viscosity, "ambient_pressure": GU2020.ambient_pressure},
        "operation": {"speed_rpm": speed_rpm, "load": (-load, 0.0)},
        "model": model or SPRINGS,
        "mesh": {"circumferential_elements": mesh[0], "axial_elements": mesh[1]},
        "output": {"fields": "none"},
    }
    if capacity:
        content["capacity"] = capacity
    return content | copy.deepcopy(groups)


def bisect(inside, low, high):
    """The place between two at which a claim begins to fail, to a few thousandths."""
    while abs(high - low) > 4.0e-3*abs(high):
        middle = 0.5*(low + high)
        low, high = (middle, high) if inside(middle) else (low, middle)
    return 0.5*(low + high)


def on_both_sides(inside, place):
    """Whether a claim holds a little before a place, and not a little beyond it, away from zero."""
    return inside(place*(1.0 - SAME)) and not inside(place*(1.0 + SAME))


def gap_of(folder, **changes):
    """Smallest film of a plain equilibrium."""
    return solve(folder, "plain", case("equilibrium", **changes))["minimum_gap"]


def check_capacity(checks, folder):
    """Springs: from a light load, from one that is too heavy, by bisection; the coefficient."""
    limit, mesh = {"smallest_gap": GAP}, (40, 6)
    light = solve(folder, "light", case("load_capacity", limit, mesh=mesh))
    above = solve(folder, "heavy", case("load_capacity", limit, mesh=mesh, load=400.0))
    plain = bisect(lambda load: gap_of(folder, load=load, mesh=mesh) > GAP, 200.0, 400.0)
    found = light["load_capacity"]
    checks.below("capacity, springs: from above", above["load_capacity"]/found - 1.0, SAME)
    checks.below("capacity, springs: by bisection", plain/found - 1.0, 4.0e-3)
    checks.that("capacity, springs: plain equilibria on both sides",
                on_both_sides(lambda load: gap_of(folder, load=load, mesh=mesh) > GAP, found))
    checks.below("capacity, springs: film", light["minimum_gap"]/GAP - 1.0, SAME)
    checks.below("capacity, springs: it is the load", light["force_x"]/found + 1.0, SAME)
    checks.that("capacity, springs: summary and closing block begin with it", list(light.summary)[:3] == ["analysis", "converged",
                "load_capacity"] and re.search(r"answer\n-+\nload capacity +(\S+) N ", light.log) is not None)
    words = r"attitude angle +(\S+) deg   from film force \(in equilibrium the load\), at (\S+) deg, to the shaft's centre, -e, at (\S+) deg"
    told = re.search(words, light.log)
    angle, load, centre = map(float, told.groups()) if told else (0.0, 0.0, 999.0)
    checks.below("capacity, springs: attitude angle from the load's direction to that of the shaft's centre", centre - load - angle, 0.1)
    kept, broken = (solve(folder, "wanted", case("equilibrium", {"smallest_gap": gap}, mesh=mesh, load=0.8*found)) for gap in (GAP, 3.0*GAP))
    checks.that("capacity, springs: a film that is wanted changes no answer", kept["minimum_gap"] == broken["minimum_gap"] > GAP)
    checks.below("capacity, springs: its margin", max(abs(one["film_margin"]*gap/kept["minimum_gap"] - 1.0)
                                                      for one, gap in ((kept, GAP), (broken, 3.0*GAP))), 1.0e-12)
    checks.that("capacity, springs: a film that is too thin is warned of", "is thinner than smallest_gap of &capacity" in broken.log
                and "is thinner than" not in kept.log and "film margin" in kept.log)
    checks.that("capacity, springs: reached", light["limit_reached"] == above["limit_reached"] == "true")
    si = found/(GU2020.length*(2.0*GU2020.radius)**2*30000.0*numpy.pi/30.0)
    checks.below("coefficient in SI", light["load_capacity_coefficient_si"]/si - 1.0, 1.0e-12)
    checks.below("coefficient in lbf/(in^3 krpm)", light["load_capacity_coefficient"]/(si*POUNDS) - 1.0, 1.0e-12)


def check_beams(checks, folder):
    """The same on beams, from equilibria on both sides of it; one rank and two."""
    def content(load):
        return case("load_capacity", {"smallest_gap": GAP_4}, load=load, **BEAMS)

    light, above = (solve(folder, "beams", content(load)) for load in (50.0, 160.0))
    heavy = solve(folder, "beams", content(1500.0), status=2)
    found = light["load_capacity"]
    checks.that("capacity, beams: a load at which the shaft touches down is refused",
                "no equilibrium to begin with: the shaft touches down" in heavy.log)
    checks.below("capacity, beams: from above", above["load_capacity"]/found - 1.0, SAME)
    checks.that("capacity, beams: plain equilibria on both sides",
                on_both_sides(lambda load: gap_of(folder, load=load, **BEAMS) > GAP_4, found))
    checks.that("capacity, beams: reached", light["limit_reached"] == above["limit_reached"] == "true")
    two = solve(folder, "ranks", content(50.0), ranks=2)
    sizes = {name: 1.0e-5 for name in ("leading_edge_lift", "leading_edge_lift_edge", "trailing_edge_lift", "trailing_edge_lift_edge")}
    sizes |= {name: 1.0 for name in ("force_y", "torque_x", "torque_y", "torque_x_without_suction", "torque_y_without_suction")}
    worst, name = summary_difference(light, two, sizes)
    checks.below(f"1 and 2 ranks ({name})", worst, 1.0e-6)


def check_similarity(checks, folder):
    """Rigid: half the speed with twice the viscosity carries the same load, and has twice the coefficient."""
    limit = {"smallest_gap": GAP}
    one = solve(folder, "rigid", case("load_capacity", limit, {"foil": "rigid"}))
    other = solve(folder, "rigid", case("load_capacity", limit, {"foil": "rigid"}, speed_rpm=15000.0,
                                        gas={"viscosity": 2.0*GU2020.viscosity, "ambient_pressure": GU2020.ambient_pressure}))
    checks.below("rigid: capacity at the same bearing number", other["load_capacity"]/one["load_capacity"] - 1.0, SAME)
    checks.below("rigid: coefficient", other["load_capacity_coefficient"]/one["load_capacity_coefficient"] - 2.0, SAME)


def check_pads(checks, folder):
    """Three pads: plain equilibria on both sides, and the same capacity under a load turned from pad to pad."""
    def content(analysis, load, turn=0.0, **more):
        vector = (-load*numpy.cos(turn), -load*numpy.sin(turn))
        return case(analysis, more, pads={"count": 3, "preload": 5.0e-6}, operation={"speed_rpm": 30000.0, "load": vector})

    one, turned = (solve(folder, "pads", content("load_capacity", 20.0, turn, smallest_gap=GAP))["load_capacity"]
                   for turn in (0.0, 2.0*numpy.pi/3.0))
    checks.below("pads: turned by a third", turned/one - 1.0, SAME)
    checks.that("pads: plain equilibria on both sides", on_both_sides(
        lambda load: solve(folder, "plain", content("equilibrium", load))["minimum_gap"] > GAP, one))


def check_ends(checks, folder):
    """Where no limit is met: the largest load and its reason, which a branch followed round its fold has, too; no answer."""
    folds = BEAMS | {"mesh": (209, 4), "load": 196.0}
    end = solve(folder, "end", case("load_capacity", {"smallest_gap": 0.5e-6}, **folds))
    checks.that("fold: told", end["limit_reached"] == "false" and "not at the limit: the branch of answers ends in a fold" in end.log)
    checks.that("fold: a thicker film", end["minimum_gap"] > 0.5e-6)
    checks.that("fold: no sign of the determinant there", end["determinant_sign"] == 0)
    rounded = solve(folder, "round", case("equilibrium", sweep={"parameter": "load", "values": (196.0, 202.0), "turn_folds": True},
                                          **folds)).history()
    checks.below("fold: that of the branch followed round it", max(-rounded["force_x"])/end["load_capacity"] - 1.0, 1.0e-4)
    touched = solve(folder, "touched", case("load_capacity", {"smallest_gap": 1.0e-7}, {"foil": "rigid"}))
    checks.that("touch-down: told", touched["limit_reached"] == "false" and "not at the limit: the shaft touches down" in touched.log)
    for words, content in (
            ("at every load tried, down to", case("load_capacity", {"smallest_gap": 4.0e-5})),
            ("without any tilt about x", case("misalignment_allowance", {"smallest_gap": GAP}, load=500.0)),
            ("at every speed tried, up to", case("lift_off", {"contact_part": 1.0e-6}, {"foil": "rigid"},
                                                    shaft_contact={"roughness": 4.0e-6, "pressure": 5.0e7})),
            ("no equilibrium to begin with: the shaft touches down", case("load_capacity", {"smallest_gap": GAP}, {"foil": "rigid"},
                                                                         load=5.0e6))):
        log = solve(folder, "none", content, status=2).log
        checks.that(f"no limit: {words}", "no limit found: " in log and words in log)


def check_suction(checks, folder):
    """Where the film draws the free edge to the shaft the branch ends before the limit: the search says how, and a plain equilibrium
    at a load a tenth above names the reason."""
    def content(analysis, load, **groups):
        return case(analysis, model={"foil": "beam"}, mesh=(104, 4), speed_rpm=80000.0, bearing=BEARING_30, top_foil=FOIL_30,
                    bump_foil={**FOIL_30, "half_length": 1.4e-3, "height": 0.45e-3, "pitch": 3.6e-3, "bumps": 26},
                    contact=FOILS["contact"], operation={"speed_rpm": 80000.0, "load": (0.0, -load)}, **groups)

    reason = "the film draws the free edge of the top foil to the shaft"
    # With the rounding of another processor the branch is lost at 41.5 N.
    end = solve(folder, "drawn", content("load_capacity", 40.0, capacity={"smallest_gap": GAP_4}),
                environment={"OPENBLAS_CORETYPE": "Nehalem"})
    checks.that("suction: the limit is not reached, and the search says how its branch ends", end["limit_reached"] == "false"
                and re.search("not at the limit: .*(ends in a fold|the branch may go on)", end.log) is not None)
    over = solve(folder, "over", content("equilibrium", 1.1*end["load_capacity"]), status=2)
    checks.that("suction: told by an equilibrium beyond", reason in over.log)


def check_lift_off(checks, folder):
    """From a high speed, from a low one, plain equilibria on both sides."""
    def lifted(speed):
        answer = solve(folder, "plain", case("equilibrium", speed_rpm=speed, **ROUGH))
        return numpy.hypot(answer["solid_contact_force_x"], answer["solid_contact_force_y"]) < PART*50.0

    answers = [solve(folder, "lift", case("lift_off", {"contact_part": PART}, speed_rpm=speed, **ROUGH)) for speed in (30000.0, 1000.0)]
    high, low = (answer["lift_off_speed_rpm"] for answer in answers)
    checks.that("lift-off: summary and closing block begin with it", list(answers[0].summary)[2] == "lift_off_speed_rpm"
                and re.search(r"answer\n-+\nlift off speed +\S+ rpm ", answers[0].log) is not None)
    checks.below("lift-off: from below", low/high - 1.0, SAME)
    checks.that("lift-off: plain equilibria on both sides", on_both_sides(lambda speed: not lifted(speed), high))


def check_misalignment(checks, folder):
    """About both axes, from no tilt, from one that is too large and from the other sense; plain equilibria on both sides."""
    for number, axis in enumerate("xy"):
        def tilts(size, number=number):
            return {"operation": {"speed_rpm": 30000.0, "load": (-50.0, 0.0), "tilt": tuple(size*(i == number) for i in (0, 1))}}

        limit = {"smallest_gap": GAP, "tilt_axis": axis}
        found = solve(folder, "tilt", case("misalignment_allowance", limit))["misalignment_allowance"]
        above, other = (solve(folder, "tilt", case("misalignment_allowance", limit, **tilts(share*found)))["misalignment_allowance"]
                        for share in (1.2, -0.1))
        checks.below(f"misalignment about {axis}: from above", above/found - 1.0, SAME)
        checks.below(f"misalignment about {axis}: in the other sense", other/found + 1.0, SAME)
        checks.that(f"misalignment about {axis}: plain equilibria on both sides",
                    on_both_sides(lambda size, tilts=tilts: gap_of(folder, **tilts(size)) > GAP, found))


def shells(analysis, capacity, mesh, radius, length, clearance, bumps, load, speed_rpm, **operation):
    """Shells on a coarse mesh, with bumps all around."""
    content = case(analysis, capacity, {"foil": "shell"}, mesh, bearing={"radius": radius, "length": length, "clearance": clearance}, **FOILS)
    content["mesh"] |= {"arc_elements": 4, "flat_elements": 2}
    content["top_foil"]["fixed_edge"] = "leading"
    content["bump_foil"] |= {"bumps": bumps, "pitch": 0.997*2.0*numpy.pi*radius/bumps}
    return content | {"operation": {"speed_rpm": speed_rpm, "load": (-load, 0.0)} | operation}


def check_shells(checks, folder):
    """Contacts that open and close on the way cost some factorizations, not some hundred: lift-off on half the width, misalignment
    on the whole. Plain equilibria, each from nothing, lie on both sides."""
    journal = {"mesh": (104, 4), "radius": 19.0e-3, "length": 38.1e-3, "clearance": 31.8e-6, "bumps": 26, "load": 17.2}
    rough = {"roughness": 0.5e-6, "pressure": 1.0e7}

    def lifted(speed):
        answer = solve(folder, "plain", shells("equilibrium", None, speed_rpm=speed, **journal) | {"shaft_contact": rough})
        return numpy.hypot(answer["solid_contact_force_x"], answer["solid_contact_force_y"]) < PART*journal["load"]

    answer = solve(folder, "lift", shells("lift_off", {"contact_part": PART}, speed_rpm=15000.0, **journal) | {"shaft_contact": rough})
    checks.that("lift-off, shells: reached", answer["limit_reached"] == "true")
    checks.that(f"lift-off, shells: {answer['factorizations']:.0f} factorizations, once 524", answer["factorizations"] < FEW)
    checks.that("lift-off, shells: plain equilibria on both sides", on_both_sides(lambda speed: not lifted(speed), answer["lift_off_speed_rpm"]))

    journal = {"mesh": (140, 4), "radius": 25.4e-3, "length": 40.6e-3, "clearance": 42.0e-6, "bumps": 35, "load": 15.5, "speed_rpm": 20000.0}
    thin = 1.0e-6
    answer = solve(folder, "tilt", shells("misalignment_allowance", {"smallest_gap": thin, "tilt_axis": "x"}, **journal))
    found = answer["misalignment_allowance"]
    checks.that("misalignment, shells: reached", answer["limit_reached"] == "true")
    checks.that(f"misalignment, shells: {answer['factorizations']:.0f} factorizations, once 409", answer["factorizations"] < FEW)
    checks.that("misalignment, shells: plain equilibria on both sides", on_both_sides(
        lambda tilt: solve(folder, "plain", shells("equilibrium", None, tilt=(tilt, 0.0), **journal))["minimum_gap"] > thin, found))


def check_sweeps(checks, folder):
    """A point of a sweep is the limit of its own scene: over speed, over a key of the bearing and of &capacity."""
    for parameter, values, group in (("speed_rpm", (20000.0, 40000.0), "operation"), ("bearing%clearance", (2.5e-5, 3.5e-5), ""),
                                     ("capacity%smallest_gap", (2.0e-6, 4.0e-6), "")):
        sweep, mesh = {"sweep": {"parameter": parameter, "values": values}}, (40, 6)
        rows = solve(folder, "swept", case("load_capacity", {"smallest_gap": GAP}, mesh=mesh, **sweep)).history()
        group, _, key = (parameter if "%" in parameter else f"{group}%{parameter}").partition("%")
        content = case("load_capacity", {"smallest_gap": GAP}, mesh=mesh)
        content[group][key] = values[-1]
        alone = solve(folder, "alone", content)
        checks.below(f"over {parameter}: the last one is that of its own scene",
                     rows["load_capacity"][-1]/alone["load_capacity"] - 1.0, SAME)


def check_pieces(checks, folder):
    """A sweep by groups of ranks, and one that is stopped and resumed, have the limits of a sweep in one piece."""
    content = case("load_capacity", {"smallest_gap": GAP}, mesh=(80, 12),
                   sweep={"parameter": "speed_rpm", "values": (20000.0, 24000.0, 28000.0, 32000.0, 36000.0, 40000.0)})
    content["output"]["restart_every"] = 1
    whole = solve(folder, "pieces", content).history()
    for words, options, ranks in (("by groups", ["--groups", "2"], 2), ("resumed", ["--restart"], 1)):
        if words == "resumed":
            path = write_case(folder, "pieces", content)
            with subprocess.Popen([GFB, "--output", str(folder), str(path)], stdout=subprocess.PIPE, encoding="utf-8") as process:
                next(line for line in process.stdout if line.startswith("point 1 of"))
                process.send_signal(signal.SIGTERM)
                log = process.stdout.read()
            checks.that("stopped after a point", "--restart resumes from" in log)
        rows = solve(folder, "pieces", content, ranks=ranks, options=options).history()
        for name in "load_capacity", "limit_reached", "minimum_gap":
            checks.below(f"{words}: {name}", max(abs(rows[name]/whole[name] - 1.0)), SAME if ranks > 1 else 0.0)


def check_meshes(checks, folder):
    """The mesh's order, and the error that &accuracy states against a fine mesh."""
    found = {order: [solve(folder, "mesh", case("load_capacity", {"smallest_gap": GAP_5}, SPRINGS | {"film_order": order},
                                                mesh=(n//order, n//4//order)))["load_capacity"] for n in MESHES]
             for order in (1, 2)}
    fine = found[2][2]
    for order, values in found.items():
        print(f"load capacity, order {order}:", *(f"{value:.6g}" for value in values))
    checks.within("bilinear: order", observed_order(found[1][1] - fine, found[1][2] - fine), 1.5, 3.0)
    checks.within("biquadratic: order", observed_order(found[2][0] - fine, found[2][1] - fine), 3.0, 5.0)
    checks.below(f"both on {MESHES[2]} x {MESHES[2]//4}", found[1][2]/fine - 1.0, 1.0e-3)
    asked = solve(folder, "asked", case("load_capacity", {"smallest_gap": GAP_5}, mesh=(64, 16),
                                        accuracy={"quantity": "load_capacity", "target": 0.01}))
    error = asked["load_capacity"] - fine
    checks.that("the error that is stated is met", abs(error) <= 1.5*asked["load_capacity_error"])


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for check in (check_shells,) if "--long" in sys.argv else (
                check_capacity, check_beams, check_similarity, check_pads, check_ends, check_suction, check_lift_off, check_misalignment,
                check_sweeps, check_pieces, check_meshes):
            check(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
