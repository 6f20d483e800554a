#!/usr/bin/env python3
"""A conical bearing: a journal's film, its closed form where it is narrow, and a thrust bearing's are its limits; stiffness is the slope."""

import math
import pathlib
import tempfile

import h5py
import numpy
from gfb_run import Checks, observed_order, solve

RADIUS, LENGTH, CLEARANCE, ANGLE = 0.02, 0.03, 2.0e-5, 0.35
VISCOSITY, AMBIENT = 1.85e-5, 1.0e5
HELD = {"eccentricity": (6.0e-6, -4.0e-6), "axial_eccentricity": 8.0e-6, "tilt": (1.5e-4, -1.0e-4)}
TIGHT = {"solver": {"residual_tolerance": 1.0e-12, "step_tolerance": 1.0e-12}}
SPRINGS = {"foil": "elastic_foundation", "foundation_stiffness": 2.0e10}


def cone(operation, analysis="fixed_position", half_angle=ANGLE, mesh=(48, 12), **groups):
    """The groups of a case; a group that is given beside takes the place of keys."""
    content = {"scene": {"analysis": analysis},
               "bearing": {"radius": RADIUS, "length": LENGTH, "clearance": CLEARANCE, "half_angle": half_angle},
               "pads": {"count": 3, "arc": 1.9, "first_leading_edge": 0.3},
               "gas": {"viscosity": VISCOSITY, "ambient_pressure": AMBIENT},
               "operation": {"speed_rpm": 30.0e3} | operation, "model": {"foil": "rigid"},
               "mesh": {"circumferential_elements": mesh[0], "axial_elements": mesh[1]}}
    for name, keys in (TIGHT | groups).items():
        content[name] = content.get(name, {}) | keys
    return content


def forces(answer):
    """The film's forces and torques, conjugate to the five positions of the sleeve."""
    return numpy.array([answer["force_x"], answer["force_y"], -answer["axial_force"], -answer["torque_x"], -answer["torque_y"]])


def check_journal(checks, folder):
    """A cone that opens by next to nothing is a journal."""
    held = {key: HELD[key] for key in ("eccentricity", "tilt")}
    flat, open_ = (solve(folder, name, cone(held, half_angle=angle)) for name, angle in (("flat", 0.0), ("open", 1.0e-12)))
    for name in ("force_x", "force_y", "torque_x", "torque_y", "friction_torque", "minimum_gap"):
        checks.below(f"half angle to 0, {name}: a journal's", open_[name]/flat[name] - 1.0, 1.0e-9)
    checks.that("a journal has no axial force", "axial_force" not in flat.summary and "axial_force" in open_.summary)


def check_thrust(checks, folder):
    """Opened to a plane a cone is a thrust bearing."""
    tilt, gap = (2.0e-4, -1.0e-4), 1.5e-5
    same = {"model": {"foil": "rigid", "film_order": 2}}
    groups = cone({"eccentricity": (0.0, 0.0), "tilt": tilt}, half_angle=0.5*math.pi - 1.0e-8, **same)
    groups["bearing"]["clearance"] = gap
    ring = cone({"axial_gap": gap, "tilt": tilt}, **same)
    ring["bearing"] = {"kind": "thrust", "outer_radius": RADIUS + 0.5*LENGTH, "inner_radius": RADIUS - 0.5*LENGTH}
    groups["mesh"]["edge_refinement"] = ring["mesh"]["edge_refinement"] = 1.0
    ring["mesh"]["radial_elements"] = ring["mesh"].pop("axial_elements")
    opened, plane = solve(folder, "opened", groups), solve(folder, "plane", ring)
    for name in ("axial_force", "torque_x", "torque_y", "friction_torque", "minimum_gap"):
        checks.below(f"half angle to 90 degrees, {name}: a thrust bearing's", opened[name]/plane[name] - 1.0, 1.0e-6)


def check_narrow(checks, folder):
    """A narrow cone under a slow film over half a turn: dp/ds^2 = 12 mu U h'/(R h^3), whose integral has a closed form."""
    length, speed, ecc, shift = 4.0e-4, 20.0, 8.0e-6, 6.0e-6
    groups = cone({"eccentricity": (ecc, 0.0), "axial_eccentricity": shift, "speed_rpm": speed*30.0/math.pi}, mesh=(256, 16))
    groups["bearing"]["length"] = length
    groups["pads"] = {"count": 1, "arc": math.pi, "first_leading_edge": 0.0}
    groups["model"] = {"foil": "rigid", "film_order": 2}
    answer = solve(folder, "narrow", groups)
    widest, thinnest = (CLEARANCE - shift*math.sin(ANGLE) + sign*ecc*math.cos(ANGLE) for sign in (1.0, -1.0))
    pressed = VISCOSITY*speed*RADIUS*length**3/4.0*(1.0/thinnest**2 - 1.0/widest**2)  # integral of p - p_a over the surface
    checks.below("narrow cone: axial force by hand", answer["axial_force"]/(pressed*math.sin(ANGLE)) - 1.0, 2.0e-3)
    angle = math.pi*(numpy.arange(20000) + 0.5)/20000.0
    gap = CLEARANCE - shift*math.sin(ANGLE) + ecc*math.cos(ANGLE)*numpy.cos(angle)
    density = VISCOSITY*speed*RADIUS*length**3/2.0*ecc*math.cos(ANGLE)*numpy.sin(angle)/gap**3
    across = [float(numpy.mean(density*part))*math.pi*math.cos(ANGLE) for part in (numpy.cos(angle), numpy.sin(angle))]
    for name, wanted in zip(("force_x", "force_y"), across, strict=True):
        checks.below(f"narrow cone: {name} by hand", answer[name]/wanted - 1.0, 2.0e-3)


def moved(coordinate, step):
    """The held position with one of its five coordinates moved."""
    place = [*HELD["eccentricity"], HELD["axial_eccentricity"], *HELD["tilt"]]
    place[coordinate] += step
    return {"eccentricity": tuple(place[:2]), "axial_eccentricity": place[2], "tilt": tuple(place[3:])}


def check_stiffness(checks, folder):
    """All 25 entries of slow vibrations against differences of forces."""
    for title, model in (("rigid", {"foil": "rigid"}), ("springs", SPRINGS)):
        answer = solve(folder, f"vibrates_{title}", cone(HELD, "linear_dynamics", model=model, dynamics={"frequencies": (1.0e-3,)}))
        with h5py.File(f"{answer.stem}.h5", "r") as file:
            stiffness = numpy.reshape(file["dynamics/stiffness"][...], (-1, 5, 5))[0]
        sizes = numpy.array([1.0, 1.0, 1.0, RADIUS, RADIUS])  # of a force over a torque
        largest = numpy.abs(stiffness/numpy.outer(sizes, sizes)).max()
        for i in range(5):
            step = 1.0e-9/sizes[i]
            above, below = (forces(solve(folder, f"moved_{title}_{i}_{way}", cone(moved(i, way*step), model=model))) for way in (1, -1))
            slope = -(above - below)/(2.0*step)
            miss = numpy.abs((slope - stiffness[:, i])/sizes/sizes[i]).max()/largest
            checks.below(f"{title}: stiffness against motion {i + 1}", float(miss), 1.0e-6)
        for entry, (row, column) in {"xx": (0, 0), "xy": (0, 1), "zz": (2, 2)}.items():
            checks.below(f"{title}: stiffness_{entry}", answer[f"stiffness_{entry}"]/stiffness[row, column] - 1.0, 1.0e-12)


def check_turned(checks, folder):
    """Bearing, position and tilt turned about the axis: forces turn, the axial one stays."""
    angle = 0.7
    turn = numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    there = {"eccentricity": tuple(turn @ HELD["eccentricity"]), "axial_eccentricity": HELD["axial_eccentricity"],
             "tilt": tuple(turn @ HELD["tilt"])}
    first = solve(folder, "as_it_is", cone(HELD))
    other = solve(folder, "turned", cone(there, pads={"first_leading_edge": 0.3 + angle}))
    wanted, found = forces(first), forces(other)
    for part in (slice(0, 2), slice(3, 5)):
        wanted[part] = turn @ wanted[part]
        checks.below(f"turned by {angle} rad: forces {part.start + 1} and {part.stop}",
                     float(numpy.abs(found[part] - wanted[part]).max()/numpy.abs(wanted[part]).max()), 1.0e-10)
    checks.below("turned: axial force", found[2]/wanted[2] - 1.0, 1.0e-10)
    checks.below("turned: friction", other["friction_torque"]/first["friction_torque"] - 1.0, 1.0e-11)


def check_mesh(checks, folder):
    """Bilinear elements: the error falls with their size squared."""
    answers = [forces(solve(folder, f"mesh_{n}", cone(HELD, mesh=(24*n, 8*n), model={"foil": "rigid", "film_scheme": "galerkin",
                                                                                       "film_order": 1}))) for n in (1, 2, 4)]
    for i, name in ((0, "force_x"), (2, "axial_force"), (3, "torque_x")):
        order = observed_order(answers[0][i] - answers[1][i], answers[1][i] - answers[2][i])
        checks.within(f"order of {name}", order, 1.8, 2.3)


def check_equilibrium(checks, folder):
    """Loads are balanced, held there the film pushes back as much; two ranks; a sweep; heat closes its balance."""
    loads = {"load": (0.0, -10.0), "axial_load": 20.0}
    wedge = {"pads": {"preload": 0.4}}
    for title, model in (("rigid", {"foil": "rigid"}), ("springs", SPRINGS)):
        found = solve(folder, f"loaded_{title}", cone(loads, "equilibrium", model=model, **wedge))
        checks.below(f"{title}: axial force in equilibrium", found["axial_force"]/20.0 - 1.0, 1.0e-8)
        checks.below(f"{title}: radial force", math.hypot(found["force_x"], found["force_y"] + 10.0)/10.0, 1.0e-8)
        place = {"eccentricity": (found["eccentricity_x"], found["eccentricity_y"]), "axial_eccentricity": found["axial_eccentricity"]}
        held = solve(folder, f"held_{title}", cone(place, model=model, **wedge))
        checks.below(f"{title}: held where it was found", held["axial_force"]/20.0 - 1.0, 1.0e-6)
        two = solve(folder, f"ranks_{title}", cone(loads, "equilibrium", model=model, **wedge), ranks=2)
        checks.below(f"{title}: two ranks", two["axial_eccentricity"]/found["axial_eccentricity"] - 1.0, 1.0e-8)
    swept = solve(folder, "swept", cone(loads, "equilibrium", sweep={"parameter": "axial_load", "values": (20.0, 15.0, 25.0)}, **wedge))
    last = solve(folder, "last", cone(loads | {"axial_load": 25.0}, "equilibrium", **wedge))
    checks.below("a sweep of axial_load ends at its last value", swept["axial_eccentricity"]/last["axial_eccentricity"] - 1.0, 1.0e-7)
    hot = solve(folder, "hot", cone(loads, "equilibrium", thermal={"ambient_temperature": 300.0, "shaft_conductance": 0.5,
                                                                   "sleeve_conductance": 2.0, "top_foil": "given",
                                                                   "top_foil_temperature": 310.0}, **wedge))
    checks.below("heat: its balance", hot["energy_imbalance"], 1.0e-6)
    checks.that("heat: the film is warmer than the gas around", hot["film_temperature"] > 300.0)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for check in (check_journal, check_thrust, check_narrow, check_stiffness, check_turned, check_mesh, check_equilibrium):
            check(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
