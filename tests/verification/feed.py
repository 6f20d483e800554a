#!/usr/bin/env python3
"""Films that are fed under pressure: rows of two independent programs, closed forms, a disc with a sealed edge, limits of
the orifice, derivatives against differences, ranks, half and whole widths, one sector and all, a runner that hammers, holes
of foils fed by tubes and from the channel below, the lowest supply that lifts off.

`--long` has all rows of the reference, and meshes twice as fine."""

import json
import math
import pathlib
import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, solve

REFERENCE = {row["id"]: row for row in
             json.loads((pathlib.Path(__file__).parent/"reference"/"feed.json").read_text(encoding="utf-8"))["rows"]}
FEW = ("porous_ring_inertia", "porous_journal_eccentric", "porous_sectors", "line_ring_springs", "line_journal_backflow",
       "line_ring_hammer", "rim_journal_eccentric_turning", "rim_journal_pockets")
NAMES = {"axial_force": 1.0e-4, "force_x": 1.0e-4, "force_y": 1.0e-4, "torque_x": 3.0e-4, "torque_y": 3.0e-4,
         "supply_flow": 1.0e-4, "maximum_pressure": 3.0e-4, "hammer_frequency": 1.0e-3, "critical_mass": 1.0e-3}
AIR = {"viscosity": 1.85e-5, "ambient_pressure": 101325.0, "temperature": 293.15, "molar_mass": 0.0289647}
RING = {"kind": "thrust", "outer_radius": 0.02, "inner_radius": 0.005, "leading_edge_condition": "periodic"}
JOURNAL = {"radius": 0.015, "length": 0.03, "clearance": 1.5e-5, "leading_edge_condition": "periodic"}
HOLES = {"kind": "orifices", "supply_pressure": 6.0e5, "orifice_diameter": 3.0e-4, "orifices": 6, "row_positions": [-0.008, 0.008],
         "mouth_diameter": 1.0e-3}
COARSE = {"circumferential_elements": 48, "axial_elements": 8}
TIGHT = {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-12}


FOIL = {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 3.18e-5}
FOIL_HOLES = {"kind": "orifices", "supply_pressure": 3.0e5, "orifice_diameter": 2.0e-4, "orifices": 8, "row_positions": [-0.01, 0.01]}
TUBES = FOIL_HOLES | {"through": "top_foil", "tube_diameter": 2.0e-3}
CHANNEL = FOIL_HOLES | {"through": "channel", "channel_pressure": 2.5e5}


def referred(row, **more):
    """The groups of a row of the reference."""
    analysis = "linear_dynamics" if "dynamics" in row["input"] else "fixed_position"
    return {"scene": {"analysis": analysis}} | {name: dict(keys) for name, keys in row["input"].items()} | more


def fed(bearing, operation, feed, analysis="fixed_position", **more):
    """Groups of a bearing of air on a rigid sleeve."""
    return {"scene": {"analysis": analysis}, "bearing": dict(bearing), "gas": dict(AIR), "operation": {"speed_rpm": 0.0} | operation,
            "model": {"foil": "rigid"}, "feed": dict(feed)} | more


def on_plate(operation, feed, analysis="fixed_position", stiffness=4.0e8, modulus=2.14e11, **more):
    """Groups of the same on a plate that is bound to its springs: gas under a foil that only rests on bumps blows it on to the shaft."""
    return fed(FOIL, {"speed_rpm": 20000.0} | operation, feed, analysis, **more) | {
        "model": {"foil": "plate", "crest_stiffness": stiffness, "crest_springs": "two_sided"},
        "top_foil": {"thickness": 3.0e-4, "youngs_modulus": modulus, "poissons_ratio": 0.29, "fixed_edge": "trailing"},
        "bump_foil": {"pitch": 4.572e-3, "bumps": 26}}


def coefficients(answer, motions):
    """Stiffness and damping, [frequency, row, column], of the motions that the reference has."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        found = [file[f"dynamics/{name}"][...] for name in ("stiffness", "damping")]
    return [matrix[:, :motions, :motions] for matrix in found]


def check_reference(checks, folder, names, finer=1):
    for name in names:
        row = REFERENCE[name]
        wanted = row["output"]
        more = {}
        if finer > 1:
            sectors = "kind" in row["input"]["bearing"] and row["input"]["bearing"]["kind"] == "thrust"
            more = {"mesh": {"circumferential_elements": 64 if sectors else 240, ("radial" if sectors else "axial") + "_elements": 32}}
        answer = solve(folder, f"{name}_{finer}", referred(row, **more))
        rim, back = name.startswith("rim"), name.endswith("backflow")
        for quantity, limit in NAMES.items():
            if quantity not in wanted:
                continue
            size = math.hypot(wanted["force_x"], wanted.get("force_y", 0.0)) if quantity.startswith("force") else abs(wanted[quantity])
            if quantity.startswith("torque"):
                size = math.hypot(wanted["torque_x"], wanted["torque_y"])
            if rim and quantity != "supply_flow":
                limit = 2.0e-3
            if back or rim and quantity == "supply_flow":
                limit = 1.0e-3 if back else 3.0e-4
            checks.below(f"{name}: {quantity}", (answer[quantity] - wanted[quantity])/size, limit)
        for quantity, short in (("mouth_pressure", "mouth_pressure"), ("orifice_flow", "orifice_flow")):
            for i, value in enumerate(wanted.get(quantity, [])):
                checks.below(f"{name}: {short}_{i + 1}", answer[f"{short}_{i + 1}"]/value - 1.0, 3.0e-4)
        if "stiffness" not in wanted:
            continue
        motions = len(wanted["stiffness"][0])
        for quantity, limit, found in zip(("stiffness", "damping"), (3.0e-4, 1.0e-3), coefficients(answer, motions), strict=True):
            there = numpy.array(wanted[quantity])
            size = numpy.abs(there.diagonal(axis1=1, axis2=2)).max(axis=0)
            checks.below(f"{name}: {quantity}", float((numpy.abs(found - there)/numpy.sqrt(numpy.outer(size, size))).max()),
                         2.0e-3 if rim else limit)


def bessel_0(x):
    """I_0 by its series."""
    term, total, k = 1.0, 1.0, 1
    while term > 1.0e-17*total:
        term *= (0.5*x/k)**2
        total += term
        k += 1
    return total


def check_disc(checks, folder):
    """A porous disc is a ring with a sealed inner edge and a small hole: P = Ps^2 - (Ps^2 - Pa^2) I0(f r)/I0(f Ro)."""
    supply, outer, gap, permeability, thickness = 701325.0, 0.018415, 5.0e-6, 1.44e-15, 4.5e-3
    wall = {"kind": "porous", "supply_pressure": supply, "permeability": permeability, "wall_thickness": thickness}
    answer = solve(folder, "disc", fed({"kind": "thrust", "outer_radius": outer, "inner_radius": 2.0e-4, "inner_edge": "sealed",
                                        "leading_edge_condition": "periodic"}, {"axial_gap": gap}, wall))
    rate = math.sqrt(12.0*permeability/(thickness*gap**3))
    pressure = lambda r: math.sqrt(supply**2 - (supply**2 - 101325.0**2)*bessel_0(rate*r)/bessel_0(rate*outer))  # noqa: E731
    nodes, weights = numpy.polynomial.legendre.leggauss(60)
    radii, weights = 0.5*outer*(nodes + 1.0), 0.5*outer*weights
    force = sum(w*2.0*math.pi*r*(pressure(r) - 101325.0) for r, w in zip(radii, weights, strict=True))
    energy = 8.314462618/0.0289647*293.15
    flow = sum(w*2.0*math.pi*r*permeability*(supply**2 - pressure(r)**2)/(2.0*1.85e-5*energy*thickness)
               for r, w in zip(radii, weights, strict=True))
    checks.below("porous disc: force over Bessel's", answer["axial_force"]/force - 1.0, 1.0e-3)
    checks.below("porous disc: flow over Bessel's", answer["supply_flow"]/flow - 1.0, 1.0e-3)


def check_nothing_fed(checks, folder):
    """A supply at ambient pressure feeds nothing at rest: the film is as good as not there."""
    for feed in (HOLES | {"supply_pressure": 101325.0},
                 {"kind": "porous", "supply_pressure": 101325.0, "permeability": 2.0e-15, "wall_thickness": 4.0e-3}):
        answer = solve(folder, f"nothing_{feed['kind']}", fed(JOURNAL, {"eccentricity": [4.0e-6, 0.0]}, feed, mesh=COARSE))
        for quantity in ("maximum_pressure", "minimum_pressure"):
            checks.below(f"nothing fed, {feed['kind']}: {quantity}", answer[quantity]/101325.0 - 1.0, 1.0e-12)


def check_symmetries(checks, folder):
    """Half and whole, one sector and all of them, a row turned by a pitch, ranks."""
    groups = fed(JOURNAL, {"eccentricity": [5.0e-6, 2.0e-6], "speed_rpm": 20000.0}, HOLES, mesh=COARSE, solver=TIGHT)
    half = solve(folder, "half", groups)
    whole = solve(folder, "whole", groups | {"model": {"foil": "rigid", "half_width": "no"}})
    turned = solve(folder, "turned", groups | {"feed": HOLES | {"first_orifice_angle": math.pi/6.0 + math.pi/3.0}})
    several = solve(folder, "several", groups, ranks=3)
    for quantity in ("force_x", "force_y", "supply_flow", "orifice_flow_1", "mouth_pressure_8"):
        checks.below(f"half and whole: {quantity}", whole[quantity]/half[quantity] - 1.0, 1.0e-10)
        checks.below(f"three ranks: {quantity}", several[quantity]/half[quantity] - 1.0, 1.0e-11)
    checks.below("numbered from another orifice", turned["orifice_flow_1"]/half["orifice_flow_2"] - 1.0, 1.0e-5)
    sectors = fed({"kind": "thrust", "outer_radius": 0.03, "inner_radius": 0.015}, {"axial_gap": 1.0e-5, "speed_rpm": 20000.0},
                  HOLES | {"orifices": 2, "row_positions": [0.022]}, pads={"count": 4, "arc": 1.4}, solver=TIGHT,
                  mesh={"circumferential_elements": 16, "radial_elements": 8})
    one = solve(folder, "one_sector", sectors)
    every = solve(folder, "all_sectors", sectors | {"operation": sectors["operation"] | {"tilt": [1.0e-13, 0.0]}})
    for quantity in ("axial_force", "supply_flow", "orifice_flow_2"):
        checks.below(f"one sector and all: {quantity}", every[quantity]/one[quantity] - 1.0, 1.0e-8)
    checks.below("sectors solved", every["pads_solved"] - 4, 0.5)


def check_limits(checks, folder):
    """A series orifice is a curtain where the gap is thin and a hole where it is wide; more and smaller holes become a line."""
    for gap, limit in ((1.0e-6, "curtain"), (1.0e-4, "hole")):
        ring = {"kind": "thrust", "outer_radius": 0.03, "inner_radius": 0.01, "leading_edge_condition": "periodic"}
        holes = HOLES | {"row_positions": [0.018], "spread": "line", "orifice_diameter": 1.0e-3 if limit == "curtain" else 1.0e-4}
        flows = [solve(folder, f"{limit}_{restriction}", fed(ring, {"axial_gap": gap}, holes | {"restriction": restriction}))["supply_flow"]
                 for restriction in ("series", limit)]
        checks.below(f"series as {limit}", flows[0]/flows[1] - 1.0, 2.0e-3)
    gaps = []
    for number in (12, 24, 48):
        feed = HOLES | {"restriction": "hole", "orifices": number, "mouth_diameter": 2.0e-4, "row_positions": [0.0],
                        "orifice_diameter": 4.0e-4/math.sqrt(number)}
        groups = fed(JOURNAL, {"eccentricity": [0.0, 0.0]}, feed, mesh=COARSE)
        flow = solve(folder, f"holes_{number}", groups)["supply_flow"]
        line = solve(folder, f"line_{number}", groups | {"feed": feed | {"spread": "line"}})["supply_flow"]
        gaps.append(abs(flow/line - 1.0))
    checks.below("24 holes are nearer to a line than 12", gaps[1]/gaps[0], 0.7)
    checks.below("48 are nearer still", gaps[2]/gaps[1], 0.7)


def check_slopes(checks, folder):
    """K at rest is the slope of the force; derivatives by keys of the supply are differences of answers."""
    def held(e, **more):
        return fed(JOURNAL, {"eccentricity": [e, 0.0]}, HOLES, mesh=COARSE, solver=TIGHT, **more)
    vibration = solve(folder, "slope", held(5.0e-6) | {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequencies": [1.0e-3]}})
    step = 1.0e-9
    up, down = (solve(folder, f"slope_{sign}", held(5.0e-6 + sign*step))["force_x"] for sign in (1, -1))
    checks.below("K at rest over the slope of the force", -vibration["stiffness_xx"]*2.0*step/(up - down) - 1.0, 1.0e-6)
    loaded = fed(JOURNAL, {"load": [-40.0, 0.0], "speed_rpm": 20000.0}, HOLES, "equilibrium", mesh=COARSE, solver=TIGHT)
    answer = solve(folder, "derived", loaded | {"sensitivity": {"quantity": "minimum_gap", "parameters": ", ".join(
        f"feed%{key}" for key in ("supply_pressure", "discharge_coefficient", "orifice_diameter"))}})
    for key, value in (("supply_pressure", 6.0e5), ("discharge_coefficient", 0.8), ("orifice_diameter", 3.0e-4)):
        moved = [solve(folder, f"derived_{sign}", loaded | {"feed": HOLES | {key: value*(1.0 + sign*1.0e-4)}})["minimum_gap"]
                 for sign in (1, -1)]
        checks.below(f"minimum_gap by {key} over its difference",
                     answer[f"d_minimum_gap_d_feed_{key}"]*2.0e-4*value/(moved[0] - moved[1]) - 1.0, 1.0e-5)


def check_hammer(checks, folder):
    """A runner just below and just above the critical mass dies out and grows, as the two programs have it."""
    row = REFERENCE["line_ring_hammer"]
    for rotor in row["output"]["rotor"]:
        answer = solve(folder, f"runner_{rotor['mass']}", referred(row, rotor={"mass": rotor["mass"]}, dynamics={"frequencies": [1000.0]}))
        checks.below(f"runner of {rotor['mass']} kg: frequency", answer["axial_frequency"]/rotor["axial_frequency"] - 1.0, 1.0e-3)
        checks.below(f"runner of {rotor['mass']} kg: growth", (answer["growth_rate"] - rotor["growth_rate"])/rotor["axial_frequency"], 1.0e-3)


def check_floating(checks, folder):
    """At rest the supply alone carries: the force of a held shaft is the load with which the shaft finds that place."""
    held = solve(folder, "held", fed(JOURNAL, {"eccentricity": [6.0e-6, 0.0]}, HOLES, mesh=COARSE, solver=TIGHT))
    free = solve(folder, "free", fed(JOURNAL, {"load": [held["force_x"], 0.0]}, HOLES, "equilibrium", mesh=COARSE, solver=TIGHT))
    checks.below("place under that load", free["eccentricity_x"]/6.0e-6 - 1.0, 1.0e-8)


def check_nothing_below(checks, folder):
    """A channel at ambient pressure is none, to the last bit."""
    for foil in ("plate", "beam"):
        groups = on_plate({"eccentricity": [1.0e-5, 0.0]}, FOIL_HOLES | {"supply_pressure": 101325.0, "through": "top_foil"}, mesh=COARSE)
        if foil == "beam":
            groups["model"] = {"foil": "beam"}
            groups["bump_foil"] |= {"thickness": 1.0e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "half_length": 1.778e-3, "height": 5.0e-4}
        tubes = solve(folder, f"{foil}_tubes", groups)
        channel = solve(folder, f"{foil}_channel", groups | {"feed": groups["feed"] | {"through": "channel"}})
        checks.that(f"{foil}: a channel at ambient pressure is none",
                    all(tubes[name] == channel[name] for name in ("force_x", "force_y", "minimum_gap", "supply_flow", "maximum_pressure")))


def check_stiff_foil(checks, folder):
    """A hole of a foil that does not give is one of the sleeve: on elements a mouth's radius long, which leave a mesh as it is."""
    mouths = {"mouth_diameter": 4.0e-3, "row_positions": [-9.525e-3, 9.525e-3]}
    mesh = {"circumferential_elements": 208, "axial_elements": 32, "edge_refinement": 1.0}
    operation = {"eccentricity": [1.0e-5, 3.0e-6], "speed_rpm": 2000.0}
    sleeve = solve(folder, "hole_of_sleeve", fed(FOIL, operation, FOIL_HOLES | mouths, mesh=mesh, solver=TIGHT))
    for feed in (TUBES, CHANNEL | {"channel_pressure": 3.0e5}):
        groups = on_plate(operation, feed | mouths, stiffness=1.0e17, modulus=1.0e17, mesh=mesh, solver=TIGHT)
        groups["top_foil"]["thickness"] = 9.0e-4
        groups["bump_foil"]["pitch"] = 2.0*math.pi*FOIL["radius"]/26.0*(1.0 - 1.0e-9)
        foil = solve(folder, f"hole_of_foil_{feed['through']}", groups)
        for quantity in ("force_x", "force_y", "supply_flow", "orifice_flow_1"):
            checks.below(f"stiff foil, {feed['through']}: {quantity} over the rigid one", foil[quantity]/sleeve[quantity] - 1.0, 1.0e-6)


def deflection(answer):
    """Mean of the foil's deflection over the film's nodes, away from the shaft [m]."""
    with h5py.File(f"{answer.stem}.film.vtkhdf") as file:
        return float(file["VTKHDF/PointData/deflection"][...].mean())


def check_foil(checks, folder, feed, without):
    """Half and whole, ranks, the foil comes to the shaft, K at rest is the slope of the force, derivatives by keys."""
    word = feed["through"]

    def held(e, analysis="fixed_position", **changed):
        return on_plate({"eccentricity": [e, 2.0e-6]}, feed | changed, analysis, mesh=COARSE, solver=TIGHT)

    half = solve(folder, f"{word}_half", held(1.0e-5))
    several = solve(folder, f"{word}_ranks", held(1.0e-5), ranks=3)
    for quantity in ("force_x", "force_y", "supply_flow", "minimum_gap"):
        checks.below(f"{word}, three ranks: {quantity}", several[quantity]/half[quantity] - 1.0, 1.0e-11)
    checks.that(f"{word}: the foil comes to the shaft", deflection(half) < deflection(solve(folder, f"{word}_without", held(1.0e-5, **without))))
    middle = held(1.0e-5, "linear_dynamics", row_positions=[0.0]) | {"dynamics": {"frequencies": [1000.0]}}
    parts = [coefficients(solve(folder, f"{word}_{half}", middle | {"model": middle["model"] | {"half_width": half}}), 2) for half in ("yes", "no")]
    for name, one, all_of_it in zip(("stiffness", "damping"), *parts, strict=True):
        checks.below(f"{word}, half and whole: {name}", float(numpy.abs(one - all_of_it).max()/numpy.abs(all_of_it).max()), 1.0e-9)
    vibration = solve(folder, f"{word}_slope", held(1.0e-5, "linear_dynamics") | {"dynamics": {"frequencies": [1.0e-3]}})
    step = 1.0e-9
    up, down = (solve(folder, f"{word}_slope_{sign}", held(1.0e-5 + sign*step))["force_x"] for sign in (1, -1))
    checks.below(f"{word}: K at rest over the slope of the force", -vibration["stiffness_xx"]*2.0*step/(up - down) - 1.0, 1.0e-6)
    loaded = on_plate({"load": [-40.0, 0.0]}, feed, "equilibrium", mesh=COARSE, solver=TIGHT)
    keys = [key for key in ("supply_pressure", "tube_diameter", "channel_pressure") if key in feed]
    answer = solve(folder, f"{word}_derived", loaded | {"sensitivity": {
        "quantity": "minimum_gap", "parameters": ", ".join(f"feed%{key}" for key in keys)}})
    for key in keys:
        moved = [solve(folder, f"{word}_derived_{sign}", loaded | {"feed": feed | {key: feed[key]*(1.0 + sign*1.0e-4)}})["minimum_gap"]
                 for sign in (1, -1)]
        found, size = answer[f"d_minimum_gap_d_feed_{key}"]*2.0e-4*feed[key], 1.0e-4*answer["minimum_gap"]
        checks.below(f"{word}: minimum_gap by {key} and its difference", (found - moved[0] + moved[1])/size, 1.0e-5)


def check_foils(checks, folder):
    """Tubes that push and a channel that is filled."""
    check_foil(checks, folder, TUBES, {"tube_diameter": 0.0})
    check_foil(checks, folder, CHANNEL, {"channel_pressure": 101325.0})

    def filled(supply, **more):
        """A channel that the supply fills with all of its pressure."""
        feed = FOIL_HOLES | {"through": "channel", "supply_pressure": supply}
        return on_plate({"load": [-40.0, 0.0]}, feed, "equilibrium", mesh=COARSE, solver=TIGHT, **more)

    answer = solve(folder, "filled", filled(3.0e5, sensitivity={"quantity": "minimum_gap", "parameters": "feed%supply_pressure"}))
    up, down = (solve(folder, f"filled_{sign}", filled(3.0e5*(1.0 + sign*1.0e-4)))["minimum_gap"] for sign in (1, -1))
    checks.below("channel of the supply's pressure: minimum_gap by it over its difference",
                 answer["d_minimum_gap_d_feed_supply_pressure"]*6.0e1/(up - down) - 1.0, 1.0e-6)


def check_lift_off(checks, folder):
    """The lowest supply pressure: an equilibrium at it has the film asked for, at rest and at speed, from above and below."""
    wanted = 8.0e-6
    for name, groups in (("journal", fed(JOURNAL, {"load": [-20.0, 0.0]}, HOLES, "lift_off", mesh=COARSE, solver=TIGHT)),
                         ("foil", on_plate({"load": [-40.0, 0.0], "speed_rpm": 2000.0}, CHANNEL | {"channel_pressure": 3.0e5}, "lift_off",
                                           mesh=COARSE, solver=TIGHT))):
        groups["capacity"] = {"lift_off_by": "supply_pressure", "smallest_gap": wanted}
        first = groups["feed"]["supply_pressure"]
        limit = solve(folder, f"lift_{name}", groups)
        lowest = limit["lift_off_supply_pressure"]
        scale = (lowest - 101325.0)/(first - 101325.0)  # that of the channel goes with it
        low = {key: 101325.0 + scale*(value - 101325.0) for key, value in groups["feed"].items() if key.endswith("_pressure")}
        there = {key: value for key, value in groups.items() if key != "capacity"} | {"scene": {"analysis": "equilibrium"}, "feed": groups["feed"] | low}
        answer = solve(folder, f"lift_{name}_there", there)
        checks.that(f"lift-off of the {name}: the limit is reached", limit["limit_reached"] == "true" and lowest < first)
        for quantity, value in (("minimum_gap", wanted), ("supply_flow", limit["supply_flow"]), ("supply_power", limit["supply_power"])):
            checks.below(f"lift-off of the {name}: {quantity} of an equilibrium there", answer[quantity]/value - 1.0, 1.0e-7)
        checks.that(f"lift-off of the {name}: choked orifices", answer["choked_orifices"] == limit["choked_orifices"])
        below = solve(folder, f"lift_{name}_below", groups | {"feed": groups["feed"] | {
            key: 101325.0 + 0.9*(value - 101325.0) for key, value in low.items()}})
        checks.below(f"lift-off of the {name}: from below", below["lift_off_supply_pressure"]/lowest - 1.0, 1.0e-7)
    wall = {"kind": "porous", "supply_pressure": 6.0e5, "permeability": 2.0e-15, "wall_thickness": 4.0e-3}
    ring = fed(RING, {"axial_load": 150.0, "axial_gap": 6.0e-6}, wall, "lift_off", solver=TIGHT)
    limit = solve(folder, "lift_ring", ring | {"capacity": {"lift_off_by": "supply_pressure", "smallest_gap": 6.0e-6}})
    held = solve(folder, "lift_ring_held", fed(RING, {"axial_gap": 6.0e-6}, wall | {"supply_pressure": limit["lift_off_supply_pressure"]}, solver=TIGHT))
    checks.below("lift-off of a porous ring: what it carries at that gap and supply", held["axial_force"]/150.0 - 1.0, 1.0e-8)


def main():
    checks = Checks()
    long = "--long" in sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_reference(checks, folder, REFERENCE if long else FEW)
        if long:
            check_reference(checks, folder, [name for name in REFERENCE if not name.startswith("rim")], 2)
        check_disc(checks, folder)
        check_nothing_fed(checks, folder)
        check_symmetries(checks, folder)
        check_limits(checks, folder)
        check_slopes(checks, folder)
        check_hammer(checks, folder)
        check_floating(checks, folder)
        check_nothing_below(checks, folder)
        check_stiff_foil(checks, folder)
        check_foils(checks, folder)
        check_lift_off(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
