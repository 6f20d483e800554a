#!/usr/bin/env python3
"""Heat of film, foils and walls: an independent solution, the isothermal film, energy that closes, half the width, ranks, pads
turned around, vibrations and motions at temperatures that stay, foils that soften.

`--long` has the other scenes of the reference, biquadratic elements and a load capacity, and nothing else."""

import json
import math
import pathlib

import numpy

from gfb_run import largest_difference, observed_order, run_checks, solve
from small_motions import RADIUS, harmonic
from transient import TIGHT, history

REFERENCE = json.loads((pathlib.Path(__file__).parent/"reference"/"thermal.json").read_text(encoding="utf-8"))["scenes"]
BY_NAME = {scene["name"]: scene for scene in REFERENCE}
FEW = ("walls_given", "load_growth", "cooled", "shaft_fin")
TURN = 2.0*math.pi/3.0
# Errors of the reference itself, which it gives: an inlet with weak walls, flows over the leading edge.
OWN = {"force": 0.0, "torque": 0.0, "temperature": 1.0e-4, "heat": 0.0, "flow": 3.0e-4}
TAKEN = ("force_x", "eccentricity_x", "friction_torque", "heat_to_shaft", "heat_to_top_foil", "heat_by_gas",
         "film_temperature", "shaft_temperature", "inlet_temperature", "running_clearance", "mass_flow_leading_edge")


def changed(groups, **more):
    """The groups with further keys."""
    return {name: groups.get(name, {}) | more.get(name, {}) for name in groups | more}


def on_mesh(scene, around, across, order=1):
    """The groups of a scene of the reference on a mesh with so many nodes."""
    return changed(scene["groups"], mesh={"circumferential_elements": around//order, "axial_elements": across//order},
                   model={"film_order": order})


def errors(scene, answer):
    """Of forces and positions, torque and flows, temperatures and heats: as the reference's page measures them."""
    wanted = scene["answers"]
    force = math.hypot(wanted["force_x"], wanted["force_y"])
    clearance = scene["groups"]["bearing"]["clearance"]
    found = {"force": 0.0, "torque": 0.0, "temperature": 0.0, "heat": 0.0, "flow": 0.0}
    for name, value in wanted.items():
        difference = abs(answer[name] - value)
        if name.startswith("force"):
            kind, size = "force", force
        elif name.startswith("eccentricity") or name == "running_clearance":
            kind, size = "force", clearance
        elif name.startswith("heat"):
            kind, size = "heat", wanted["power_loss"]
        elif "temperature" in name:
            kind, size = "temperature", scene["rise"]
        elif name.startswith("mass_flow"):
            kind, size = "flow", wanted["mass_flow_leading_edge"]
        else:
            kind, size = "torque", abs(value)
        found[kind] = max(found[kind], difference/size)
    return found


def check_reference(checks, folder, names, order):
    limits = {"force": 2.0e-3, "torque": 5.0e-4, "temperature": 5.0e-4, "heat": 1.0e-3, "flow": 1.0e-3}
    for name in names:
        scene = BY_NAME[name]
        answer = solve(folder, name, on_mesh(scene, 240, 32, order))
        for kind, error in errors(scene, answer).items():
            checks.below(f"{name}, order {order}: {kind}", error, limits[kind]*(0.2 if order == 2 and kind != "flow" else 1.0) + OWN[kind])
        checks.below(f"{name}: energy", answer["energy_imbalance"], 1.0e-9)


def check_order(checks, folder):
    """Errors of the shaft's temperature and the heats fall with the square of the size of elements."""
    scene = BY_NAME["load"]
    coarse, fine = (errors(scene, solve(folder, "order", on_mesh(scene, *mesh))) for mesh in ((60, 8), (120, 16)))
    for kind in ("force", "temperature", "heat"):
        order = observed_order(coarse[kind], fine[kind])
        checks.that(f"order of {kind}: {order:.2f} (at least 1.8)", order > 1.8)


def check_isothermal(checks, folder):
    """Walls at the temperature of the gas, and a gas that conducts without limit."""
    groups = changed(on_mesh(BY_NAME["walls_given"], 120, 16), thermal={
        "prandtl": 1.0e-12, "shaft_temperature": 293.15, "top_foil_temperature": 293.15}, gas={"temperature": 293.15})
    cold = {name: {key: value for key, value in keys.items() if key != "molar_mass"} for name, keys in groups.items()
            if name != "thermal"}
    hot, plain = solve(folder, "hot", groups), solve(folder, "plain", cold)
    for name in ("force_x", "force_y", "friction_torque", "maximum_pressure"):
        checks.below(f"isothermal: {name}", hot[name]/plain[name] - 1.0, 1.0e-9)


def check_couette(checks, folder):
    """A thin film between walls of the gas' temperature is mu V2/12 k hotter."""
    groups = changed(on_mesh(BY_NAME["walls_given"], 120, 16),
                     bearing={"clearance": 8.0e-6}, operation={"eccentricity": (0.0, 0.0)},
                     gas={"viscosity_law": "constant", "viscosity": 1.85e-5},
                     thermal={"shaft_temperature": 293.15, "top_foil_temperature": 293.15})
    speed = groups["operation"]["speed_rpm"]*math.pi/30.0*groups["bearing"]["radius"]
    rise = 0.71*speed**2/(12.0*1005.0)
    answer = solve(folder, "couette", groups)
    checks.below("thin film: its rise less mu V2/12 k [K]", answer["film_temperature"] - 293.15 - rise, 1.0e-3)


def check_same(checks, folder):
    """Half the width, two ranks, pads turned by a third of a turn."""
    groups = on_mesh(BY_NAME["load_growth"], 96, 12)
    half = solve(folder, "half", groups)
    for words, other in (("whole width", solve(folder, "whole", changed(groups, model={"half_width": "no"}))),
                         ("two ranks", solve(folder, "ranks", groups, 2))):
        checks.below(words, largest_difference([other[name]/half[name] for name in TAKEN], [1.0]*len(TAKEN)), 1.0e-9)
    pads = changed(groups, pads={"count": 3, "arc": 2.0, "preload": 0.2}, operation={"load": (-20.0, 0.0)})
    first = solve(folder, "pads", pads)
    turned = solve(folder, "turned", changed(pads, operation={"load": (-20.0*math.cos(TURN), -20.0*math.sin(TURN))}))
    for name in ("power_loss", "shaft_temperature", "inlet_temperature", "heat_by_gas", "minimum_gap"):
        checks.below(f"load turned by a pad: {name}", turned[name]/first[name] - 1.0, 1.0e-9)
    checks.below("pads: the heat of each adds up",
                 sum(first[f"heat_to_top_foil_{pad}"] for pad in (1, 2, 3))/first["heat_to_top_foil"] - 1.0, 1.0e-12)
    checks.below("pads: energy", first["energy_imbalance"], 1.0e-9)


def matrix_of(answer, name):
    """Of the translations, at the first frequency."""
    return numpy.array([[answer[f"{name}_{row}{column}"] for column in "xy"] for row in "xy"])


def check_motion(checks, folder):
    """Vibrations: of no heat that counts those without it; slow ones what forces at other places are, between walls that are held;
    a small circle over time as the linear theory has it."""
    moved = changed(on_mesh(BY_NAME["walls_given"], 60, 8), solver=TIGHT)
    slow = changed(moved, scene={"analysis": "linear_dynamics"}, dynamics={"frequency_ratios": 1.0e-4})
    stiffness = matrix_of(solve(folder, "slow", slow), "stiffness")
    step = 1.0e-8
    place = numpy.array(moved["operation"]["eccentricity"])
    differences = numpy.zeros((2, 2))
    for axis in range(2):
        for sign in (1.0, -1.0):
            there = place + sign*step*numpy.eye(2)[axis]
            answer = solve(folder, "moved", changed(moved, operation={"eccentricity": tuple(there)}))
            differences[:, axis] -= sign*numpy.array([answer["force_x"], answer["force_y"]])/(2.0*step)
    checks.below("slow vibrations between given walls", largest_difference(stiffness, differences), 2.0e-3)
    groups = changed(on_mesh(BY_NAME["load_growth"], 60, 8), solver=TIGHT)
    speed = groups["operation"]["speed_rpm"]*math.pi/30.0
    vibrating = solve(folder, "vibrating", changed(groups, scene={"analysis": "linear_dynamics"}, dynamics={"frequencies": 1.5*speed}))
    impedance = matrix_of(vibrating, "stiffness") + 1.5j*speed*matrix_of(vibrating, "damping")
    held = {name: keys for name, keys in groups.items() if name != "operation"} | {"operation": {
        "speed_rpm": groups["operation"]["speed_rpm"], "eccentricity": (vibrating["eccentricity_x"], vibrating["eccentricity_y"])}}
    circle = solve(folder, "circle", changed(held, scene={"analysis": "transient"}, transient={
        "turns": 8, "steps_per_turn": 100, "orbit_radius": RADIUS, "orbit_frequency": 1.5*speed}))
    force = harmonic(history(circle), "force", 1.5*speed, 4.0)
    wanted = -impedance @ numpy.array([RADIUS, -1j*RADIUS])
    checks.below("force on a circle over time", numpy.linalg.norm(force - wanted)/numpy.linalg.norm(wanted), 1.0e-3)
    checks.below("temperatures at its end are those of its beginning", circle["shaft_temperature"]/vibrating["shaft_temperature"] - 1.0,
                 1.0e-9)


def foils_at(moduli, foil, **more):
    """Walls and top foil at temperatures that are given, foils with given moduli of top foil and bumps."""
    metal = {"thickness": 1.02e-4, "poissons_ratio": 0.29}
    groups = changed(on_mesh(BY_NAME["walls_given"], 104, 4))
    groups["thermal"] = {"shaft": "given", "shaft_temperature": 400.0, "top_foil": "given", "top_foil_temperature": 420.0,
                         "sleeve": "given", "sleeve_temperature": 350.0, "bump_conductance": 190.0}
    groups["model"] = foil
    groups["scene"] = {"analysis": "equilibrium"}
    groups["operation"] = {"speed_rpm": 30000.0, "load": (-20.0, 0.0)}
    groups["top_foil"] = {"thickness": 1.02e-4}
    groups["bump_foil"] = metal | {"youngs_modulus": moduli[1], "half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3, "bumps": 26}
    if foil["foil"] in ("beam", "shell"):
        groups["top_foil"] = metal | {"youngs_modulus": moduli[0], "fixed_edge": "trailing", "density": 8280.0, "free_radius": 1.91e-2}
        groups["bump_foil"] |= {"fixed_edge": "trailing", "density": 8280.0}
        groups["contact"] = {"friction_top": 0.1, "friction_sleeve": 0.1, "normal_stiffness": 1.0e12, "stick_length": 1.0e-7}
        groups["mesh"] |= {"arc_elements": 4, "flat_elements": 1}
        if "dynamics" in more:
            groups["foil_damping"] = {"foil_mass": "on"}
    return changed(groups, solver=TIGHT, **more)


def check_modulus(checks, folder):
    """Foils whose modulus follows their temperature: as with the modulus that they have there, of every model, moving, too; energy
    closes; half the width, two ranks."""
    modulus, ratios = 214.0e9, (0.86, 0.9 + 0.1*15.0/107.0)  # at 420 K, at 385 K
    table = {"modulus_temperatures": (293.0, 400.0, 600.0), "modulus_ratios": (1.0, 0.9, 0.5)}
    vibrating = {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequency_ratios": 1.0, "loss_factor": 0.1}}
    for name, foil, more in (("springs", {"foil": "elastic_foundation"}, vibrating), ("beams", {"foil": "beam"}, {}),
                             ("local springs", {"foil": "elastic_foundation", "foundation_pressure": "local"}, vibrating),
                             ("shells", {"foil": "shell"}, vibrating)):
        typed = solve(folder, "typed", foils_at([modulus*ratio for ratio in ratios], foil, **more))
        follows = solve(folder, "follows", changed(foils_at((modulus, modulus), foil, **more), thermal=table))
        names = ("eccentricity_x", "eccentricity_y", "minimum_gap", "friction_torque", "heat_to_shaft")
        names += ("stiffness_xx", "stiffness_xy", "damping_xx", "damping_yy") if more else ()
        checks.below(f"{name} that soften, against their modulus typed", largest_difference(
            [follows[key]/typed[key] for key in names], [1.0]*len(names)), 1.0e-9)
        checks.below(f"{name}: what is left of the bumps' modulus", follows["modulus_ratio_bumps"]/ratios[1] - 1.0, 1.0e-12)
    walls = {key: value for key, value in BY_NAME["load_growth"]["groups"]["thermal"].items()}
    groups = foils_at((modulus, modulus), {"foil": "shell"})
    groups["thermal"] = walls | {"modulus_slope": -5.0e-3, "reference_temperature": 293.15}
    half = solve(folder, "half", groups)
    checks.below("shells that soften: energy", half["energy_imbalance"], 1.0e-9)
    for words, other in (("whole width", solve(folder, "whole", changed(groups, model={"half_width": "no"}))),
                         ("two ranks", solve(folder, "ranks", groups, 2))):
        keys = ("eccentricity_x", "minimum_gap", "shaft_temperature", "modulus_ratio_top_foil", "modulus_ratio_bumps")
        checks.below(f"shells that soften: {words}", largest_difference([other[key]/half[key] for key in keys], [1.0]*len(keys)), 1.0e-8)


def check_accuracy(checks, folder):
    """The error that meshes tell of a heat, against the reference."""
    scene = BY_NAME["load_growth"]
    answer = solve(folder, "accuracy", changed(scene["groups"], accuracy={"quantity": "heat_to_shaft", "target": 1.0e-2}))
    error = abs(answer["heat_to_shaft"] - scene["answers"]["heat_to_shaft"])
    checks.that(f"error of a heat {error:.2e} W, told {answer['heat_to_shaft_error']:.2e} W", error < answer["heat_to_shaft_error"] < 0.1)


def check_capacity(checks, folder):
    """Beams with heat: the second load that is tried lies beyond the limit, and no path leads back from there."""
    metal = {"thickness": 1.02e-4, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
    groups = changed(BY_NAME["load_growth"]["groups"], mesh={"circumferential_elements": 240, "axial_elements": 4})
    groups |= {"model": {"foil": "beam"}, "top_foil": metal, "operation": {"speed_rpm": 20000.0, "load": (-60.0, 0.0)}, "bump_foil": metal | {
        "half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3, "bumps": 26}}
    groups["thermal"] |= {"shaft_conductance": 0.3, "sleeve_conductance": 1.0, "bump_conductance": 190.0, "shaft_density": 7850.0}
    limit = solve(folder, "capacity", changed(groups, scene={"analysis": "load_capacity"}, capacity={"smallest_gap": 1.0e-6}))
    between = solve(folder, "between", changed(groups, operation={"load": (-150.0, 0.0)}))
    checks.that(f"film of {between['minimum_gap']:.2e} m at 150 N", between["minimum_gap"] > 1.0e-6)
    checks.that(f"load capacity {limit['load_capacity']:.2f} N, at the limit", limit["limit_reached"] and limit["load_capacity"] > 150.0)


def check_no_way_out(checks, folder):
    """Where walls and gas cannot take what the film makes, that is said without a search; at a lower speed there is an answer."""
    groups = {"scene": {"analysis": "fixed_position"}, "bearing": {"radius": 0.01905, "length": 0.0381, "clearance": 31.8e-6},
              "gas": {"ambient_pressure": 1.0135e5, "viscosity_law": "sutherland"}, "model": {"foil": "rigid"},
              "operation": {"speed_rpm": 30000.0, "eccentricity": (1.5e-5, 5.0e-6)}, "top_foil": {"thickness": 1.0e-4},
              "thermal": {"ambient_temperature": 293.15, "shaft_conductance": 0.0, "sleeve": "given", "sleeve_temperature": 293.15,
                          "bump_conductance": 1.0, "carry_over": 0.0}, "mesh": {"circumferential_elements": 60, "axial_elements": 8}}
    answer = solve(folder, "no_way", groups, status=2)
    checks.that("no steady temperature, said with what is made and what leaves", "no steady temperature below 2000 K (thermal runaway)" in answer.log
                and " W of heat and gas and walls take " in answer.log and answer["factorizations"] < 10)
    solve(folder, "way", changed(groups, operation={"speed_rpm": 12000.0}))


def check_refusal(checks, folder):
    """A runaway of three rigid pads is told as one, with how far heat led, at a few answers' cost; the last state is an answer."""
    groups = {"scene": {"analysis": "equilibrium"}, "bearing": {"radius": 0.024, "length": 0.0302, "clearance": 5.95e-5},
              "gas": {"ambient_pressure": 3.0e5, "viscosity_law": "sutherland"}, "model": {"foil": "rigid"},
              "operation": {"speed_rpm": 134000.0, "load": (528.0, 24.0)}, "top_foil": {"thickness": 1.0e-4},
              "pads": {"count": 3, "arc": 1.9, "preload": 0.21}, "mesh": {"circumferential_elements": 64, "axial_elements": 16},
              "thermal": {"ambient_temperature": 500.0, "shaft_conductance": 1.4, "sleeve_conductance": 7.26, "bump_conductance": 279.0,
                          "shaft_expansion": 1.03e-5, "sleeve_expansion": 1.45e-5}}
    refused = solve(folder, "runaway", groups, status=2)
    spent = refused["factorizations"]
    checks.that(f"a runaway after {spent:.0f} factorizations", "(thermal runaway)" in refused.log and "last state " in refused.log
                and "shaft " in refused.log.split("last state ")[1] and spent < 250)
    answer = solve(folder, "slower", changed(groups, operation={"speed_rpm": 60000.0, "load": (200.0, 10.0)}))
    checks.that(f"beside {answer['factorizations']:.0f} of an answer", answer["factorizations"] < 40)
    checks.that("it is the temperature that runs away", "beyond it the temperature (thermal runaway) moves on by itself" in refused.log)
    checks.below("what preload leaves of the clearance", (answer["running_clearance"] - 0.21*5.95e-5)/answer["running_play"] - 1.0, 1.0e-12)


def check_few(checks, folder):
    """The reference's main rows on bilinear films."""
    check_reference(checks, folder, FEW, 1)


def check_many(checks, folder):
    """Its other rows, and all on biquadratic films."""
    check_reference(checks, folder, [name for name in BY_NAME if name not in FEW], 1)
    check_reference(checks, folder, BY_NAME, 2)


def main():
    run_checks((check_few, check_order, check_isothermal, check_couette, check_same, check_motion, check_accuracy,
                check_no_way_out, check_refusal),
               (check_many, check_capacity, check_modulus))


if __name__ == "__main__":
    main()
