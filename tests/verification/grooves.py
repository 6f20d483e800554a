#!/usr/bin/env python3
"""Films with narrow grooves: rows of two independent programs, Muijderman's pumping, no grooves as a limit, shaft and sleeve as mirrors,
hammer, symmetries, derivatives against differences, motions in time, foils, feed, ranks, a run that goes on.

`--long` has all rows of the reference, meshes twice as fine, and shells."""

import json
import math
import pathlib
import random
import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, solve, summary_difference
from restart import SEED, check_kills
from transient import history

NUMBERS = json.loads((pathlib.Path(__file__).parent/"reference"/"groove.json").read_text(encoding="utf-8"))
REFERENCE = {row["name"].split()[0]: row for row in NUMBERS["narrow_groove"]}
FEW = ("J1", "J2", "J4", "J5", "T1", "T5", "F1")
FINER = "J7"            # no depth: damping of tilts of a plain film, 1.3e-3 off on the default mesh, 3e-4 on the finer one
IN_LAND = ("J3", "J4")  # where the highest mean pressure is not at the end of a band
TORQUE = 3.0e-4         # of torques about x and y: what is left of the pressure on both halves
AIR = {"viscosity": 1.85e-5, "ambient_pressure": 101325.0}
RADIUS, LENGTH, CLEARANCE, SPEED = 0.015, 0.03, 1.0e-5, 60000.0
OMEGA = SPEED*math.pi/30.0
JOURNAL = {"radius": RADIUS, "length": LENGTH, "clearance": CLEARANCE, "leading_edge_condition": "periodic"}
RING = {"kind": "thrust", "outer_radius": 0.025, "inner_radius": 0.01, "leading_edge_condition": "periodic"}
HERRINGBONE = {"on": "sleeve", "angle": math.radians(28.0), "depth": 1.2e-5, "ridge_part": 0.5, "band_begin": [-0.015, 0.003],
               "band_end": [-0.003, 0.015], "pumping": ["up", "down"]}
UNEQUAL = HERRINGBONE | {"angle": [0.4, 0.5], "band_begin": [-0.015, 0.005], "band_end": [-0.001, 0.015]}
SPIRAL = {"on": "shaft", "angle": math.radians(17.0), "depth": 1.4e-5, "band_begin": [0.014], "band_end": [0.025], "pumping": ["down"]}
COARSE = {"circumferential_elements": 24, "axial_elements": 4}
SMALL = {"circumferential_elements": 12, "axial_elements": 4}
TIGHT = {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-12}
WHOLE = {"foil": "rigid", "half_width": "no"}
PLACE = {"eccentricity": [4.0e-6, 1.0e-6]}
MEMBERS = ("shaft", "sleeve")


def grooved(grooves, operation, analysis="fixed_position", bearing=None, **more):
    """Groups of a rigid bearing with grooves; without them where they are None."""
    groups = {"scene": {"analysis": analysis}, "bearing": dict(bearing or JOURNAL), "gas": dict(AIR),
              "operation": {"speed_rpm": SPEED} | operation, "model": {"foil": "rigid"}, "solver": TIGHT}
    if grooves:
        groups["grooves"] = dict(grooves)
    return groups | more


def referred(row, finer):
    """The groups of a row of the reference."""
    case = row["case"]
    bands = [region for region in case["regions"] if region[2] is not None]
    journal = case["kind"] == "journal"
    grooves = {"on": case["on"], "angle": [math.radians(abs(band[2])) for band in bands], "depth": case["depth"],
               "ridge_part": case["ridge_part"], "band_begin": [band[0] for band in bands], "band_end": [band[1] for band in bands],
               "pumping": ["up" if (band[2] > 0.0) == (case["on"] == "sleeve") else "down" for band in bands]}
    if journal:
        bearing = {key: case[key] for key in ("radius", "length", "clearance")}
        operation = {"eccentricity": case["q"][:2], "tilt": case["q"][2:]}
    else:
        bearing = {"kind": "thrust"} | {key: case[key] for key in ("outer_radius", "inner_radius")}
        operation = {"axial_gap": case["axial_gap"], "tilt": case["q"][1:]}
    if not any(operation["tilt"]):
        del operation["tilt"]
    model = {"foil": "rigid"}
    if "foundation_stiffness" in case:
        model = {"foil": "elastic_foundation", "foundation_stiffness": case["foundation_stiffness"], "foundation_pressure": "local"}
    more = {}
    if finer > 1:
        more = {"mesh": {"circumferential_elements": 96 if journal else 64, ("axial" if journal else "radial") + "_elements": 24}}
    return {"scene": {"analysis": "linear_dynamics"}, "bearing": bearing | {"leading_edge_condition": "periodic"},
            "gas": {key: case[key] for key in AIR}, "operation": operation | {"speed_rpm": case["speed_rpm"]}, "model": model,
            "grooves": grooves, "dynamics": {"frequency_ratios": ratios_of(row)}, **more}


def ratios_of(row):
    """Ratios of the frequencies at which a row has stiffness and damping."""
    return [float(name[2:]) for name in row["A"] if name.startswith("K@")]


def matrices(answer, motions):
    """Stiffness and damping, [frequency, row, column], of the motions that are asked for."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        return [file[f"dynamics/{name}"][...].reshape(-1, *file[f"dynamics/{name}"].shape[-2:])[:, :motions, :motions]
                for name in ("stiffness", "damping")]


def check_reference(checks, folder, names, finer=1):
    """Forces, torque, pumping, flows, stiffness, damping and critical mass of rows of the reference."""
    for name in names:
        row = REFERENCE[name]
        wanted, journal = row["A"], row["case"]["kind"] == "journal"
        answer = solve(folder, f"{name}_{finer}", referred(row, finer))
        force = max(math.hypot(wanted["force_x"], wanted["force_y"]) if journal else wanted["axial_force"], 1.0)
        torque = max(math.hypot(wanted["torque_x"], wanted["torque_y"]), 1.0e-2*force*row["case"].get("length", 0.01))
        flow = max(abs(wanted["flow_low"]), 1.0e-3)
        sizes = {"force_x": force, "force_y": force, "axial_force": force, "torque_x": torque, "torque_y": torque,
                 "friction_torque": wanted["friction_torque"], "flow_low": flow, "flow_high": flow}
        words = f"{name}, {finer} times as fine" if finer > 1 else name
        for quantity, size in sizes.items():
            if quantity in wanted:
                limit = TORQUE if quantity in ("torque_x", "torque_y") and finer == 1 else 2.0e-4
                checks.below(f"{words}: {quantity}", (answer[quantity] - wanted[quantity])/size, limit)
        highest = max(wanted["pressure_at_region_ends"])
        if name in IN_LAND:
            checks.within(f"{words}: pumped_pressure", answer["pumped_pressure"]/highest, 1.0, 1.05)
        else:
            checks.below(f"{words}: pumped_pressure", answer["pumped_pressure"]/highest - 1.0, 2.0e-4)
        motions = len(wanted[f"K@{ratios_of(row)[0]}"])
        half = motions//2 if journal else 1
        for quantity, found in zip("KC", matrices(answer, motions), strict=True):
            there = numpy.array([wanted[f"{quantity}@{ratio}"] for ratio in ratios_of(row)])
            size = [numpy.abs(there[:, kind, kind]).max() for kind in (slice(0, half), slice(half, motions))]
            size = numpy.sqrt(numpy.array([size[0]]*half + [size[1]]*(motions - half)))
            checks.below(f"{words}: {quantity}", float((numpy.abs(found - there)/numpy.outer(size, size)).max()), 1.0e-3)
        if wanted.get("critical_mass"):
            checks.below(f"{words}: critical mass", answer["critical_mass"]/wanted["critical_mass"] - 1.0, 1.0e-3)
            checks.below(f"{words}: whirl ratio", answer["whirl_ratio"]/wanted["whirl_ratio"] - 1.0, 1.0e-3)
        elif "critical_mass" in wanted:
            checks.that(f"{words}: no critical mass", "critical_mass" not in answer.summary)


def muijderman(angle, gap, depth, ridge_part):
    """His g1 with the ratios of gaps and of widths that he has, of grooves without ends."""
    ratio, width, slope = gap/(gap + depth), ridge_part/(1.0 - ridge_part), 1.0/math.tan(angle)
    cube = ratio**3
    return width*ratio**2*slope*(1.0 - ratio)*(1.0 - cube)/((1.0 + width*cube)*(width + cube) + cube*slope**2*(1.0 + width)**2)


def check_pumping(checks, folder):
    """Concentric, nothing flows: the pressure rises by 6 mu V g1/h^2 along a band, whichever member has the grooves."""
    checks.below("Muijderman's g1 of 28 deg, as deep as the gap, half ridges", muijderman(math.radians(28.0), 1.0, 1.0, 0.5)/0.0677955 - 1.0,
                 1.0e-6)
    for member in MEMBERS:
        for angle, depth, part in ((28.0, 1.2e-5, 0.5), (15.0, 2.5e-5, 0.35)):
            grooves = HERRINGBONE | {"on": member, "angle": math.radians(angle), "depth": depth, "ridge_part": part}
            answer = solve(folder, "pumping", grooved(grooves, {"eccentricity": [0.0, 0.0]}, mesh=SMALL))
            slope = 6.0*AIR["viscosity"]*OMEGA*RADIUS*muijderman(math.radians(angle), CLEARANCE, depth, part)/CLEARANCE**2
            checks.below(f"pumped pressure, {member}, {angle} deg", answer["pumped_pressure"]/(slope*0.012) - 1.0, 1.0e-10)
            for end in ("low", "high"):
                checks.below(f"nothing flows, {member}, {angle} deg: flow_{end}", answer[f"flow_{end}"]/(101325.0*OMEGA*RADIUS*CLEARANCE*RADIUS),
                             1.0e-13)
    turned = HERRINGBONE | {"pumping": ["down", "up"], "depth": 3.0e-6}
    answer = solve(folder, "sucking", grooved(turned, {"eccentricity": [0.0, 0.0]}, mesh=SMALL))
    slope = 6.0*AIR["viscosity"]*OMEGA*RADIUS*muijderman(math.radians(28.0), CLEARANCE, 3.0e-6, 0.5)/CLEARANCE**2
    checks.below("pumping to the ends sucks the middle empty", (answer["minimum_pressure"] - 101325.0)/(-slope*0.012) - 1.0, 1.0e-10)


def check_limits(checks, folder):
    """Grooves without depth are none; few grooves change as much as there are of them."""
    plain = solve(folder, "plain", grooved(None, PLACE, mesh=COARSE, model=WHOLE | {"film_order": 2}))
    sizes = {"force_x": 90.0, "force_y": 90.0, "friction_torque": plain["friction_torque"], "maximum_pressure": plain["maximum_pressure"]}
    even = HERRINGBONE | {"band_begin": [-0.015, 0.0], "band_end": [0.0, 0.015]}  # the mesh has these rows without grooves, too
    for member in MEMBERS:
        def changed(**more):
            answer = solve(folder, "limit", grooved(even | {"on": member} | more, PLACE, mesh=COARSE, model=WHOLE))
            return {quantity: (answer[quantity] - plain[quantity])/size for quantity, size in sizes.items()}
        for quantity, difference in changed(depth=0.0).items():
            checks.below(f"no depth, {member}: {quantity}", difference, 1.0e-13)
        one, two, four = (changed(ridge_part=1.0 - part) for part in (2.5e-5, 5.0e-5, 1.0e-4))
        for quantity in sizes:
            bend, wider = two[quantity]/one[quantity] - 2.0, four[quantity]/two[quantity] - 2.0
            checks.below(f"few grooves, {member}: {quantity} is linear", bend, 1.0e-3)
            checks.within(f"few grooves, {member}: and bends with their share", wider/bend, 1.9, 2.1)


def check_symmetries(checks, folder):
    """A bearing that is mirrored, one that is turned, half and whole, ranks; what flows in flows out."""
    tilt = numpy.array([5.0e-5, -8.0e-5])
    for member in MEMBERS:
        grooves = UNEQUAL | {"on": member}
        mirrored = {"band_begin": [-end for end in reversed(UNEQUAL["band_end"])], "angle": list(reversed(UNEQUAL["angle"])),
                    "band_end": [-begin for begin in reversed(UNEQUAL["band_begin"])], "pumping": ["up", "down"]}
        one = solve(folder, "one", grooved(grooves, PLACE | {"tilt": list(tilt)}, mesh=COARSE))
        other = solve(folder, "other", grooved(grooves | mirrored, PLACE | {"tilt": list(-tilt)}, mesh=COARSE))
        several = solve(folder, "several", grooved(grooves, PLACE | {"tilt": list(tilt)}, mesh=COARSE), ranks=3)
        force, torque = math.hypot(one["force_x"], one["force_y"]), math.hypot(one["torque_x"], one["torque_y"])
        for quantity, back, size in (("force_x", 1.0, force), ("force_y", 1.0, force), ("torque_x", -1.0, torque), ("torque_y", -1.0, torque),
                                     ("friction_torque", 1.0, one["friction_torque"]), ("pumped_pressure", 1.0, one["pumped_pressure"])):
            checks.below(f"mirrored about z = 0, {member}: {quantity}", (other[quantity] - back*one[quantity])/size, 1.0e-12)
            checks.below(f"three ranks, {member}: {quantity}", (several[quantity] - one[quantity])/size, 1.0e-12)
        checks.below(f"mirrored about z = 0, {member}: flows change their ends", (other["flow_low"] - one["flow_high"])/one["flow_low"], 1.0e-12)
        checks.that(f"lengths that differ make gas flow, {member}", abs(one["flow_low"]) > 1.0e-3)
        checks.below(f"what flows in flows out, {member}", (one["flow_low"] + one["flow_high"])/one["flow_low"], 1.0e-12)
        turn = 5*2.0*math.pi/COARSE["circumferential_elements"]
        turning = numpy.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
        turned = solve(folder, "turned", grooved(grooves, {"eccentricity": list(turning @ PLACE["eccentricity"]), "tilt": list(turning @ tilt)},
                                                 mesh=COARSE))
        for quantity in ("force", "torque"):
            before, after = (numpy.array([answer[f"{quantity}_x"], answer[f"{quantity}_y"]]) for answer in (one, turned))
            checks.below(f"turned, {member}: {quantity}", numpy.linalg.norm(turning @ before - after)/numpy.linalg.norm(before), 1.0e-12)
        grooves = HERRINGBONE | {"on": member}
        half, whole = (solve(folder, width, grooved(grooves, PLACE, mesh=COARSE, model=WHOLE | {"half_width": width})) for width in ("yes", "no"))
        checks.below(f"half and whole, {member}", summary_difference(half, whole, {
            "torque_x": 1.0, "torque_y": 1.0, "flow_low": 1.0, "flow_high": 1.0, "torque_x_without_suction": 1.0,
            "torque_y_without_suction": 1.0} | {"nodes": 1.0e30, "elements": 1.0e30})[0], 1.0e-12)
    ring = solve(folder, "ring", grooved(SPIRAL, {"axial_gap": 8.0e-6, "tilt": [1.0e-4, -1.5e-4]}, bearing=RING))
    checks.below("what flows into a ring flows out", (ring["flow_low"] + ring["flow_high"])/ring["flow_low"], 1.0e-12)


def vibrating(folder, grooves, operation, frequencies, mesh):
    """Complex stiffness x, y of a journal, [frequency, row, column]."""
    answer = solve(folder, "vibrating", grooved(grooves, operation, "linear_dynamics", mesh=mesh, dynamics={"frequencies": list(frequencies)}))
    stiffness, damping = matrices(answer, 2)
    return stiffness + 1j*numpy.array(frequencies)[:, None, None]*damping


def check_slopes(checks, folder):
    """K at rest is the slope of the force."""
    step, at_rest = 1.0e-9, 1.0e-3
    for order in (2, 1):
        model = {"foil": "rigid", "film_order": order}
        for member in MEMBERS:
            grooves = HERRINGBONE | {"on": member}
            stiffness, _ = matrices(solve(folder, "slope", grooved(grooves, PLACE, "linear_dynamics", mesh=SMALL, model=model,
                                                                   dynamics={"frequencies": [at_rest]})), 2)
            for axis in range(2):
                moved = numpy.array(PLACE["eccentricity"])[:, None] + step*numpy.array([1.0, -1.0])*(numpy.arange(2) == axis)[:, None]
                up, down = (solve(folder, f"slope_{i}", grooved(grooves, {"eccentricity": list(moved[:, i])}, mesh=SMALL, model=model))
                            for i in range(2))
                slope = numpy.array([up[f"force_{one}"] - down[f"force_{one}"] for one in "xy"])/(2.0*step)
                checks.below(f"K at rest, film of order {order}, {member}, {'xy'[axis]}",
                             numpy.abs(stiffness[0, :, axis] + slope).max()/numpy.abs(slope).max(), 1.0e-7)


def check_mirror(checks, folder):
    """Concentric: a whirl on the shaft's grooves is the conjugate of the sleeve's that lags the shaft as far."""
    ratios = numpy.array([0.1, 0.35, 0.5, 0.65, 0.9])
    mesh = {"circumferential_elements": 48, "axial_elements": 8}
    shaft, sleeve = (vibrating(folder, HERRINGBONE | {"on": member}, {"eccentricity": [0.0, 0.0]}, OMEGA*ratios, mesh) for member in MEMBERS)
    whirl = [one[:, 0, 0] - 1j*one[:, 0, 1] for one in (shaft, sleeve)]
    checks.below("shaft at w, sleeve at Omega - w", float(numpy.abs(whirl[0] - whirl[1][::-1].conj()).max()/numpy.abs(whirl[0]).max()), 1.0e-5)
    checks.that("and they are not the same", abs(whirl[0][1] - whirl[1][1]) > 0.1*abs(whirl[0][1]))
    shallow = HERRINGBONE | {"depth": 6.0e-6, "band_begin": [-0.015, 0.009], "band_end": [-0.009, 0.015]}
    masses = [solve(folder, f"mass_{member}", grooved(shallow | {"on": member}, {"eccentricity": [0.0, 0.0]},
                                                      "linear_dynamics", mesh=mesh, dynamics={"frequency_ratios": [0.5]})) for member in MEMBERS]
    ratio = masses[1]["whirl_ratio"]
    checks.below("whirl ratios of both add up to one", masses[0]["whirl_ratio"] + ratio - 1.0, 1.0e-5)
    checks.below("critical masses, shaft over sleeve", masses[0]["critical_mass"]/masses[1]["critical_mass"]/(ratio/(1.0 - ratio))**2 - 1.0, 1.0e-4)


def check_hammer(checks, folder):
    """Along the axis of a ring both members are alike; its load is the force of the gap that it finds, and a runner hammers where damping ends."""
    loaded = {"axial_load": 60.0, "axial_gap": 1.0e-5}
    shaft, sleeve = (solve(folder, f"loaded_{member}", grooved(SPIRAL | {"on": member}, loaded, "linear_dynamics", bearing=RING,
                                                               dynamics={"frequency_ratios": [0.5]})) for member in MEMBERS)
    held = solve(folder, "held", grooved(SPIRAL, {"axial_gap": shaft["axial_gap"]}, bearing=RING))
    checks.below("force of the gap that a load finds", held["axial_force"]/60.0 - 1.0, 1.0e-9)
    for quantity in ("axial_gap", "pumped_pressure", "friction_torque", "stiffness_zz", "damping_zz", "critical_mass"):
        checks.below(f"shaft and sleeve along the axis: {quantity}", sleeve[quantity]/shaft[quantity] - 1.0, 1.0e-9)
    frequency = shaft["hammer_frequency"]
    stiffness, damping = matrices(solve(folder, "hammering", grooved(SPIRAL, loaded, "linear_dynamics", bearing=RING,
                                                                     dynamics={"frequencies": [0.9*frequency, frequency, 1.1*frequency]})), 1)
    checks.below("critical mass over K/w^2", shaft["critical_mass"]*frequency**2/stiffness[1, 0, 0] - 1.0, 1.0e-6)
    checks.below("no damping at its frequency", frequency*damping[1, 0, 0]/stiffness[1, 0, 0], 1.0e-6)
    checks.that("driven below it, damped above", damping[0, 0, 0] < 0.0 < damping[2, 0, 0])


def check_in_time(checks, folder):
    """The force on a small circle in time is K + i w C times it."""
    frequency, radius = 0.4*OMEGA, 1.0e-9
    for member in MEMBERS:
        grooves = HERRINGBONE | {"on": member}
        matrix = vibrating(folder, grooves, PLACE, [frequency], SMALL)[0]
        rows = history(solve(folder, "circle", grooved(grooves, PLACE, "transient", mesh=SMALL, transient={
            "turns": 10.0, "steps_per_turn": 60, "orbit_radius": radius, "orbit_frequency": frequency})))
        kept = rows["time"] > rows["time"][-1] - 2.0*2.0*math.pi/frequency*(1.0 - 1.0e-6)
        wave = numpy.exp(-1j*frequency*rows["time"][kept])
        force = numpy.array([2.0*(wave*(rows[f"force_{axis}"][kept] - rows[f"force_{axis}"][0])).mean() for axis in "xy"])
        expected = -matrix @ numpy.array([radius, -1j*radius])
        checks.below(f"force on a circle, {member}", numpy.linalg.norm(force - expected)/numpy.linalg.norm(expected), 1.0e-3)


def check_keys(checks, folder):
    """Derivatives by the keys of the grooves against differences of answers; a sweep's points are answers of their own."""
    keys = {"angle": (0.4, "angle(1)"), "depth": (1.2e-5, "depth"), "ridge_part": (0.5, "ridge_part")}
    quantities = ("force_x", "friction_torque", "minimum_gap")
    for analysis, operation, found in (("fixed_position", PLACE, quantities[:2]), ("equilibrium", {"load": [-60.0, 10.0]}, quantities[1:])):
        def held(**more):
            return grooved(HERRINGBONE | {"on": "shaft", "angle": 0.4} | more, operation, analysis, mesh=SMALL)  # noqa: B023 (called here)
        answer = solve(folder, "derived", held() | {"sensitivity": {
            "quantity": list(found), "parameters": [f"grooves%{name}" for _, name in keys.values()]}})
        for key, (value, name) in keys.items():
            step = 1.0e-4*value
            up, down = (solve(folder, f"derived_{sign}", held(**{key: value + sign*step})) for sign in (1, -1))
            for quantity in found:
                derivative = answer[f"d_{quantity}_d_grooves_{name.replace('(', '_').replace(')', '')}"]
                checks.below(f"{quantity} by {key} over its difference", derivative*2.0*step/(up[quantity] - down[quantity]) - 1.0, 1.0e-5)
    depths = [1.2e-5, 0.8e-5, 0.4e-5]
    swept = solve(folder, "swept", held() | {"sweep": {"parameter": "grooves%depth", "values": depths}})
    with h5py.File(f"{swept.stem}.h5", "r") as file:
        gaps = file["history/minimum_gap"][...]
    for depth, gap in zip(depths, gaps, strict=True):
        alone = solve(folder, "alone", held(depth=depth))["minimum_gap"]
        checks.below(f"a sweep at a depth of {depth}", gap/alone - 1.0, 1.0e-10)


def check_feed(checks, folder):
    """Gas that is fed beside grooves leaves at the ends."""
    supply = {"supply_pressure": 4.0e5}
    gas = AIR | {"temperature": 293.15, "molar_mass": 0.0289647}
    energy = 8.314462618/gas["molar_mass"]*gas["temperature"]
    for name, feed in (("porous", {"kind": "porous", "permeability": 2.0e-15, "wall_thickness": 4.0e-3}),
                       ("orifices", {"kind": "orifices", "orifices": 6, "orifice_diameter": 2.0e-4, "mouth_diameter": 1.0e-3,
                                     "row_positions": [0.001]})):
        answer = solve(folder, name, grooved(UNEQUAL | {"on": "shaft"}, PLACE, mesh={"circumferential_elements": 36, "axial_elements": 6},
                                             feed=feed | supply, gas=gas))
        checks.below(f"{name}: what is fed flows out", (answer["flow_low"] + answer["flow_high"])/(energy*answer["supply_flow"]) - 1.0, 1.0e-10)
        checks.that(f"{name}: and much of it", energy*answer["supply_flow"] > 0.1*abs(answer["flow_low"]))


def check_foils(checks, folder, foils):
    """Grooves on the shaft over foils: an answer, no other on three ranks, and none that the grooves do not change."""
    metal = {"thickness": 1.0e-4, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "leading"}
    mesh = {"circumferential_elements": 32, "axial_elements": 4, "arc_elements": 4, "flat_elements": 2}
    bands = {"band_begin": [-0.006, 0.0015], "band_end": [-0.0015, 0.006], "on": "shaft"}
    for foil in foils:
        groups = {"scene": {"analysis": "equilibrium"}, "bearing": {"radius": 6.0e-3, "length": 12.0e-3, "clearance": 15.0e-6},
                  "gas": AIR, "operation": {"speed_rpm": SPEED, "load": [-3.0, 0.5]}, "model": {"foil": foil}, "top_foil": metal,
                  "bump_foil": metal | {"half_length": 1.8e-3, "height": 0.5e-3, "bumps": 8},
                  "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}, "mesh": mesh}
        smooth = solve(folder, f"smooth_{foil}", groups)
        answer, several = (solve(folder, f"{foil}_{ranks}", groups | {"grooves": HERRINGBONE | bands}, ranks=ranks) for ranks in (1, 3))
        for quantity in ("minimum_gap", "eccentricity_x", "friction_torque", "pumped_pressure"):
            checks.below(f"{foil}, three ranks: {quantity}", several[quantity]/answer[quantity] - 1.0, 1.0e-8)
        checks.that(f"{foil}: it is the load that is carried", abs(answer["force_x"] + 3.0) < 1.0e-6)
        checks.that(f"{foil}: grooves change the film", abs(answer["minimum_gap"]/smooth["minimum_gap"] - 1.0) > 0.01)


def scaled(row, model):
    """Groups of a case that has no units but those of its radius, gap and ambient pressure."""
    radius, gap, ambient = 0.02, 1.0e-5, AIR["ambient_pressure"]
    speed = row["Lam"]*ambient*gap**2/(6.0*AIR["viscosity"]*radius**2)*30.0/math.pi
    grooves = {"on": "sleeve", "angle": math.radians(row["angle"]), "depth": row["depth"]*gap, "ridge_part": row["ridge_part"],
               "count": row["N"], "model": model}
    if row["kind"] == "journal":
        half = row["B"]*radius
        bearing = {"radius": radius, "length": 2.0*half, "clearance": gap, "leading_edge_condition": "periodic"}
        grooves |= {"band_begin": [-half, 0.0], "band_end": [0.0, half], "pumping": ["up", "down"]}
        return grooved(grooves, {"speed_rpm": speed, "eccentricity": [row["eps"]*gap, 0.0]}, bearing=bearing), ambient, radius
    bearing = {"kind": "thrust", "outer_radius": radius, "inner_radius": row["R_i"]*radius, "leading_edge_condition": "periodic"}
    grooves |= {"band_begin": [row["land_to"]*radius], "band_end": [radius], "pumping": ["down"]}
    return grooved(grooves, {"speed_rpm": speed, "axial_gap": gap}, bearing=bearing), ambient, radius


def check_resolved(checks, folder, rows):
    """Grooves that are meshed: pressure and force of two programs, whose corners are singular, too; half and whole, ranks."""
    for i, row in enumerate(rows):
        groups, ambient, radius = scaled(row, "resolved")
        answer = solve(folder, f"resolved_{i}", groups)
        values = row["values"]
        size = math.hypot(values.get("force_x", 0.0), values.get("force_y", 0.0))
        for quantity, value in values.items():
            name = f"resolved, {row['kind']}, {row['N']} grooves: {quantity}"
            if quantity == "mid_pressure":
                checks.below(name, (answer["pumped_pressure"]/ambient + 1.0)/value - 1.0, 2.0e-3)
            else:
                found = answer[quantity]/(ambient*radius**2)
                checks.below(name, (found - value)/(size or value), max(2.0e-3, row["agreement"]))
    grooves = HERRINGBONE | {"count": 10, "model": "resolved"}
    mesh = {"circumferential_elements": 60, "axial_elements": 16}
    half = solve(folder, "resolved_half", grooved(grooves, PLACE, mesh=mesh))
    whole = solve(folder, "resolved_whole", grooved(grooves, PLACE, mesh=mesh, model=WHOLE))
    several = solve(folder, "resolved_ranks", grooved(grooves, PLACE, mesh=mesh), ranks=3)
    for quantity in ("force_x", "force_y", "pumped_pressure", "friction_torque"):
        checks.below(f"resolved, half and whole: {quantity}", whole[quantity]/half[quantity] - 1.0, 1.0e-11)
        checks.below(f"resolved, three ranks: {quantity}", several[quantity]/half[quantity] - 1.0, 1.0e-11)


def check_ends(checks, folder):
    """Loss of load by the ends of a ring's band against grooves that two programs resolved, 24 and 48 of them."""
    ring = next(row for row in NUMBERS["resolved"] if row["kind"] == "ring")
    for row in NUMBERS["end_layers"]["load_loss_of_T1"]:
        if row["Lam"] != 10 or row["N"] < 24:
            continue
        force = [solve(folder, f"ends_{model}_{row['N']}", scaled(ring | {"Lam": row["Lam"], "N": row["N"]}, model)[0])["axial_force"]
                 for model in ("narrow", "narrow_with_ends")]
        checks.below(f"ends, {row['N']} grooves: loss of load", (1.0 - force[1]/force[0])/row["resolved"] - 1.0,
                     0.03 if row["N"] == 24 else 0.015)


def check_restart(checks, folder):
    """A sweep over the speed that is killed goes on to the same digits."""
    check_kills(checks, folder, "grooves", grooved(
        UNEQUAL | {"on": "shaft"}, {"load": [-60.0, 10.0]}, "equilibrium", output={"restart_every": 1},
        sweep={"parameter": "speed_rpm", "values": [60000.0, 55000.0, 50000.0, 45000.0, 40000.0, 35000.0]}), random.Random(SEED))


def main():
    checks = Checks()
    long = "--long" in sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_reference(checks, folder, [name for name in REFERENCE if name != FINER] if long else FEW)
        if long:
            check_reference(checks, folder, REFERENCE, 2)
        check_pumping(checks, folder)
        check_limits(checks, folder)
        check_symmetries(checks, folder)
        check_slopes(checks, folder)
        check_mirror(checks, folder)
        check_hammer(checks, folder)
        check_in_time(checks, folder)
        check_keys(checks, folder)
        check_feed(checks, folder)
        check_foils(checks, folder, ("beam", "shell") if long else ("beam",))
        resolved = NUMBERS["resolved"]
        check_resolved(checks, folder, resolved if long else [row for row in resolved if row["N"] == 12 and row["kind"] == "journal"])
        check_ends(checks, folder)
        check_restart(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
