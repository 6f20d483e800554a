#!/usr/bin/env python3
"""What holds the shaft of a machine beside journal bearings with rigid sleeves: thrust bearings, one or two that face each other,
against a rigid body on coefficients of bearings by themselves, the mirror image, `axial_play`; and supports that give way."""

import copy
import math

import h5py
import numpy

from gfb_run import run_checks, run_file, solve, write_case

SPEED = 20000.0
OMEGA = SPEED*math.pi/30.0
GAS = {"viscosity": 1.9e-5, "ambient_pressure": 1.0e5}
JOURNAL, THRUST = "xy", "z"
PLACES = {JOURNAL: ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y"), THRUST: ("eccentricity_z", "tilt_x", "tilt_y")}
CLEARANCE = (20.0e-6, 25.0e-6)  # of the two journals
HOT = 310.0  # K, at which shafts begin
SAG = 3.0e-5  # m
RIGID = (2.0e13, 4.0e13)  # Pa: a shaft that hardly bends, and half as much


def with_heat(content, shaft):
    """A bearing's case with heat, the shaft at a temperature, or, where that is 0, insulated."""
    content["gas"] = {"viscosity_law": "sutherland", "ambient_pressure": 1.0e5}
    content["top_foil"] = {"thickness": 1.0e-4}
    content["thermal"] = {"sleeve_conductance": 0.5, "bump_conductance": 300.0} | (
        {"shaft": "given", "shaft_temperature": shaft} if shaft else {"shaft_conductance": 0.0})
    if content["bearing"].get("kind") != "thrust":
        content["thermal"] |= {"shaft_expansion": 1.2e-5, "sleeve_expansion": 1.2e-5}


def journal(folder, name="journal", clearance=CLEARANCE[0], heat=None, **operation):
    """The case of a journal bearing; without more at the machine's speed under some load."""
    content = {
        "scene": {"analysis": "linear_dynamics"}, "bearing": {"radius": 15.0e-3, "length": 25.0e-3, "clearance": clearance},
        "gas": GAS, "model": {"foil": "elastic_foundation", "foundation_stiffness": 5.0e9}, "foil_damping": {"foundation_damping": 2.0e5},
        "mesh": {"circumferential_elements": 36, "axial_elements": 6},
        "operation": {"speed_rpm": SPEED} | (operation or {"load": (-8.0, 0.0)}), "dynamics": {"frequency_ratios": 1.0}}
    if heat is not None:
        with_heat(content, heat)
    return write_case(folder, name, content).name


def thrust(folder, name="thrust", play=None, heat=None, **operation):
    """The case of a thrust bearing."""
    content = {
        "scene": {"analysis": "linear_dynamics"},
        "bearing": {"kind": "thrust", "outer_radius": 30.0e-3, "inner_radius": 15.0e-3} | ({"axial_play": play} if play else {}),
        "pads": {"count": 4, "arc": 1.3}, "ramp": {"part": 0.5, "height": 15.0e-6}, "gas": GAS,
        "model": {"foil": "elastic_foundation", "foundation_stiffness": 2.0e10, "foundation_pressure": "local"},
        "foil_damping": {"foundation_damping": 4.0e5}, "mesh": {"circumferential_elements": 8, "radial_elements": 5},
        "operation": {"speed_rpm": SPEED} | (operation or {"axial_load": 20.0}), "dynamics": {"frequency_ratios": 1.0}}
    if heat is not None:
        with_heat(content, heat)
    return write_case(folder, name, content).name


def machine(folder, heat=None, **bearings):
    """A shaft of 0.2 m with a disc in two unlike journal bearings, and what else is asked for."""
    files, positions = [journal(folder, heat=heat), journal(folder, "wider", CLEARANCE[1], heat)], [0.03, 0.17]
    if "thrust" in bearings:
        files += bearings["thrust"]
        positions += bearings["thrust_positions"]
    content = {
        "scene": {"analysis": "linear_dynamics"},
        "shaft": {"lengths": 0.2, "outer_diameters": 0.03, "youngs_modulus": 2.0e11, "poissons_ratio": 0.3, "density": 7800.0},
        "discs": {"positions": 0.12, "masses": 0.8, "polar_inertias": 6.0e-4},
        "bearings": {"files": files, "positions": positions}, "machine": {"speed_rpm": SPEED},
        "loads": {"positions": 0.2, "forces_y": 3.0, "moments_x": 0.02},
        "unbalance": {"positions": 0.12, "values": 2.0e-6, "angles": 0.3}, "dynamics": {"largest_frequency": 1.5*OMEGA}}
    content["bearings"] |= {key: value for key, value in bearings.items() if not key.startswith("thrust")}
    if "thrust" in bearings:
        content["machine"]["axial_load"] = 20.0
    return content


def place(answer, number, kind):
    """Where a bearing's sleeve is."""
    return numpy.array([answer[f"{name}_{number}"] for name in PLACES[kind]])


def array(answer, name):
    """An array of the result file."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        return file[name][...]


def modes(answer):
    """Growth and frequency of all modes."""
    return array(answer, "dynamics/mode_growth_rate").ravel() + 1j*array(answer, "dynamics/mode_frequency").ravel()


def farthest(first, second):
    """The largest distance of a mode of the first to the nearest of the second, over its size."""
    return max(numpy.abs(second - one).min()/abs(one) for one in first)


def alone(folder, number, answer, kind, heat=None):
    """A bearing by itself where it is in the machine, held, and, with heat, as warm: its answer and Z at the speed."""
    where = place(answer, number, kind)
    if heat is not None:
        heat = heat or answer[f"shaft_temperature_{number}"]
    if kind == THRUST:
        file = thrust(folder, "held", heat=heat, axial_gap=-where[0], tilt=tuple(where[1:]))
    else:
        file = journal(folder, "held", CLEARANCE[number - 1], heat, eccentricity=tuple(where[:2]), tilt=tuple(where[2:]))
    one = run_file(folder/file, folder)
    size = len(where)
    stiffness, damping = (array(one, f"dynamics/{name}").reshape(size, size) for name in ("stiffness", "damping"))
    return one, stiffness + 1j*OMEGA*damping


def rigid_response(folder, answer, content, kinds, supports, heat):
    """Response to unbalance of a rigid body, x, y, theta_x, theta_y of its centre of mass and z, on the bearings' own
    coefficients; sleeves move on their supports."""
    mass, polar, across = (answer[name] for name in ("mass", "polar_inertia", "transverse_inertia"))
    size = 5 + 2*len(supports)
    dynamic = numpy.zeros((size, size), dtype=complex)
    dynamic[:5, :5] = -OMEGA**2*numpy.diag((mass, mass, across, across, mass))
    dynamic[2, 3] += 1j*OMEGA**2*polar
    dynamic[3, 2] -= 1j*OMEGA**2*polar
    for number, (kind, position) in enumerate(zip(kinds, content["bearings"]["positions"], strict=True), 1):
        arm = position - answer["centre_of_mass"]
        moved = numpy.zeros((5, size))  # of the journal, x y z theta_x theta_y
        moved[0, [0, 3]] = 1.0, arm
        moved[1, [1, 2]] = 1.0, -arm
        moved[2, 4] = moved[3, 2] = moved[4, 3] = 1.0
        if number in supports:
            own = 5 + 2*list(supports).index(number) + numpy.arange(2)
            moved[[0, 1], own] = -1.0
            heavy, stiff, damps = supports[number]
            dynamic[own, own] += -OMEGA**2*heavy + 1j*OMEGA*damps + stiff
        moved = moved[[0, 1, 3, 4]] if kind == JOURNAL else moved[[2, 3, 4]]
        dynamic += moved.T @ alone(folder, number, answer, kind, heat)[1] @ moved
    push = numpy.zeros(size, dtype=complex)
    unbalance = content["unbalance"]
    one = unbalance["values"]*OMEGA**2*numpy.exp(1j*unbalance["angles"])
    arm = unbalance["positions"] - answer["centre_of_mass"]
    push[:4] = one, -1j*one, 1j*arm*one, arm*one
    moved = numpy.linalg.solve(dynamic, push)
    return {position: (moved[0] + (position - answer["centre_of_mass"])*moved[3], moved[1] - (position - answer["centre_of_mass"])*moved[2])
            for position in content["bearings"]["positions"]}


def differences(folder, content, kinds, supports, heat):
    """The machine's response to unbalance against that of a rigid body, at each bearing, x and y."""
    answer = solve(folder, "rigid", content)
    expected = rigid_response(folder, answer, content, kinds, supports, heat)
    table = array(answer, "dynamics/response")
    rows = [table[numpy.abs(table[:, 0] - position).argmin()] for position in expected]
    ours = numpy.array([row[[1, 3]]*numpy.exp(1j*row[[2, 4]]) for row in rows])
    return ours/numpy.array(list(expected.values())) - 1.0


def check_response(checks, folder, words, content, kinds, supports, heat=None):
    """The machine's response to unbalance is that of a rigid body, where its bending, over two moduli, is taken off."""
    both = []
    for modulus in RIGID:
        content = copy.deepcopy(content)
        content["shaft"]["youngs_modulus"] = modulus
        both.append(differences(folder, content, kinds, supports, heat))
    checks.below(f"{words}: response", numpy.abs(both[1]).max(), 1.0e-3)
    checks.below(f"{words}: response without bending", numpy.abs(2.0*both[1] - both[0]).max(), 1.0e-7)


def check_thrust(checks, folder):
    """One thrust bearing: its answer is that of the bearing by itself, forces and moments balance, the shaft answers as a rigid
    body, and the machine seen from its other end is the same."""
    content = machine(folder, thrust=[thrust(folder)], thrust_positions=[0.01])
    answer = solve(folder, "base", content)
    one, _ = alone(folder, 3, answer, THRUST)
    for name, own in (("force_z", "axial_force"), ("torque_x", "torque_x"), ("torque_y", "torque_y"), ("power_loss", "power_loss")):
        checks.below(f"alone: {name}", answer[f"{name}_3"]/one[own] - 1.0, 1.0e-9)
    checks.below("axial balance", answer["force_z_3"]/20.0 - 1.0, 1.0e-11)
    balance(checks, answer, content)
    without = solve(folder, "without", {**content, "bearings": {key: value[:2] for key, value in content["bearings"].items()},
                                        "machine": {"speed_rpm": SPEED}})
    along = array(answer, "dynamics/mode_shape_z")
    checks.that("one mode moves along the axis", numpy.sum(numpy.hypot(along[:, 0], along[:, 1]) > 0.5) == 1)
    checks.that("its tilt stiffness changes modes by more than 1 %", farthest(modes(without), modes(answer)) > 0.01)
    check_response(checks, folder, "thrust bearing", content, (JOURNAL, JOURNAL, THRUST), {})
    mirrored = copy.deepcopy(content)
    for group in ("discs", "unbalance", "loads"):
        mirrored[group]["positions"] = 0.2 - content[group]["positions"]
    mirrored["loads"]["moments_x"] *= -1.0
    mirrored["bearings"] |= {"positions": [0.2 - one for one in content["bearings"]["positions"]], "facing": [1, 1, -1]}
    mirrored["machine"]["axial_load"] = -20.0
    other = solve(folder, "mirrored", mirrored)
    checks.below("mirrored: thrust bearing", numpy.abs(place(other, 3, THRUST)/place(answer, 3, THRUST) - 1.0).max(), 1.0e-11)
    checks.below("mirrored: journal", numpy.abs(place(other, 1, JOURNAL)/place(answer, 1, JOURNAL) - (1.0, 1.0, -1.0, -1.0)).max(), 1.0e-11)
    checks.below("mirrored: modes", farthest(modes(other), modes(answer)), 1.0e-11)


def balance(checks, answer, content):
    """Forces and moments of all films carry weight and loads."""
    moment, force = numpy.zeros(2), numpy.zeros(2)
    for number, position in enumerate(content["bearings"]["positions"], 1):
        arm = position - answer["centre_of_mass"]
        on_shaft = -numpy.array([answer[f"force_{axis}_{number}"] for axis in "xy"]) if number < 3 else numpy.zeros(2)
        force += on_shaft
        moment += (answer[f"torque_x_{number}"] - arm*on_shaft[1], answer[f"torque_y_{number}"] + arm*on_shaft[0])
    loads = content["loads"]
    arm = loads["positions"] - answer["centre_of_mass"]
    weight = 9.81*answer["mass"]
    checks.below("forces", numpy.abs(force + (-weight, loads["forces_y"])).max()/weight, 1.0e-11)
    checks.below("moments", numpy.abs(moment + (loads["moments_x"] - arm*loads["forces_y"], 0.0)).max()/(0.1*weight), 1.0e-11)


def check_one_journal(checks, folder):
    """A shaft in one journal bearing, held against tilting by that and by a thrust bearing."""
    content = machine(folder, thrust=[thrust(folder)], thrust_positions=[0.01])
    content["bearings"] = {"files": ["journal.nml", "thrust.nml"], "positions": [0.1, 0.01]}
    del content["unbalance"], content["dynamics"]
    content["scene"]["analysis"] = "equilibrium"
    answer = solve(folder, "one", content)
    weight, loads = 9.81*answer["mass"], content["loads"]
    checks.below("one journal: force", (answer["force_x_1"] + weight)/weight, 1.0e-11)
    # Moments about the journal: of the weight, the load, and both films.
    arm = answer["centre_of_mass"] - 0.1
    checks.below("one journal: about x", (answer["torque_x_1"] + answer["torque_x_2"] + loads["moments_x"]
                                          - (0.2 - 0.1)*loads["forces_y"])/(0.1*weight), 1.0e-11)
    checks.below("one journal: about y", (answer["torque_y_1"] + answer["torque_y_2"] - arm*weight)/(0.1*weight), 1.0e-11)
    content["machine"]["journal_tilts"] = False
    checks.that("one journal without tilts", "one journal bearing holds no shaft" in solve(folder, "wrong", content, status=1).complaint)


def check_two_sides(checks, folder):
    """Two thrust bearings that face each other are one with `axial_play`; they share the runner's motions."""
    play = 30.0e-6
    double = machine(folder, thrust=[thrust(folder, "double", play)], thrust_positions=[0.01])
    single = machine(folder, thrust=[thrust(folder), thrust(folder)], thrust_positions=[0.01, 0.01], facing=[1, 1, 1, -1],
                     offset_z=[0.0, 0.0, 0.0, play])
    answers = [solve(folder, name, content) for name, content in (("double_side", double), ("two_sides", single))]
    checks.below("two sides: place", numpy.abs(place(answers[1], 3, THRUST)/place(answers[0], 3, THRUST) - 1.0).max(), 1.0e-11)
    checks.below("two sides: force", (answers[1]["force_z_3"] - answers[1]["force_z_4"])/answers[0]["force_z_3"] - 1.0, 1.0e-11)
    checks.below("two sides: modes", farthest(modes(answers[1]), modes(answers[0])), 1.0e-11)


def check_supports(checks, folder):
    """Sleeves on springs: very stiff ones are rigid; equal sags move the whole; the shaft answers as a rigid body in sleeves that
    move."""
    content = machine(folder)
    base = solve(folder, "base", content)
    stiff = copy.deepcopy(content)
    stiff["bearings"] |= {"support_stiffness_x": 1.0e16, "support_stiffness_y": 1.0e16, "support_mass": 0.1}
    answer = solve(folder, "stiff", stiff)
    checks.below("stiff supports: journal", numpy.abs(place(answer, 1, JOURNAL)/place(base, 1, JOURNAL) - 1.0).max(), 1.0e-8)
    checks.below("stiff supports: modes", farthest(modes(answer), modes(base)), 1.0e-8)
    even = {group: copy.deepcopy(content[group]) for group in ("shaft", "discs", "bearings", "machine")} | {
        "scene": {"analysis": "equilibrium"}}
    base = solve(folder, "free", even)
    even["bearings"] |= {"support_stiffness_x": [abs(base[f"force_x_{i}"])/SAG for i in (1, 2)], "support_stiffness_y": 1.0e16}
    answer = solve(folder, "even", even)
    checks.below("supports that sag alike: journal", numpy.abs(place(answer, 2, JOURNAL)/place(base, 2, JOURNAL) - 1.0).max(), 1.0e-11)
    sag = array(answer, "shaft/line")[:, 1] - array(base, "shaft/line")[:, 1]
    checks.below("supports that sag alike: the shaft", numpy.abs(sag/-SAG - 1.0).max(), 1.0e-11)
    soft = copy.deepcopy(content)
    soft["bearings"] |= {"support_mass": [0.0, 0.3], "support_stiffness_x": [0.0, 2.0e7], "support_stiffness_y": [0.0, 3.0e7],
                         "support_damping_x": [0.0, 4.0e3], "support_damping_y": [0.0, 2.0e3]}
    check_response(checks, folder, "support", soft, (JOURNAL, JOURNAL),
                   {2: (0.3, numpy.array((2.0e7, 3.0e7)), numpy.array((4.0e3, 2.0e3)))})


def hot_machine(folder):
    """Two journals and a thrust bearing on a shaft that conducts."""
    content = machine(folder, HOT, thrust=[thrust(folder, heat=HOT)], thrust_positions=[0.01])
    content["discs"] |= {"heat_conductances": 0.02, "heat_temperatures": 305.0}
    content["machine"] |= {"shaft_conductivity": 20.0, "shaft_end_conductance": (0.05, 0.1), "shaft_end_temperature": (300.0, 320.0)}
    return content


def check_heat(checks, folder):
    """Heat of three films in one shaft: energy closes, the shaft's temperatures are those of a rod with three sources, each bearing
    by itself at its temperature has the same answer, small motions are those of films as warm, and the mirror image is the same."""
    content = hot_machine(folder)
    answer = solve(folder, "hot", content)
    checks.below("energy", answer["energy_imbalance"], 1.0e-12)
    ranks = solve(folder, "ranks", content, ranks=2)
    checks.below("two ranks: modes", farthest(modes(ranks), modes(answer)), 1.0e-8)
    checks.below("two ranks: temperature", (ranks["shaft_temperature_3"] - answer["shaft_temperature_3"])/30.0, 1.0e-9)
    heat = [answer[f"heat_to_shaft_{i}"] for i in (1, 2, 3)]
    out = answer["heat_from_shaft_ends"] + answer["heat_from_discs"]
    checks.below("the shaft's heat", (sum(heat) - out)/answer["power_loss"], 1.0e-11)
    z, temperature = array(answer, "shaft/temperature").T
    across = 20.0*math.pi/4.0*0.03**2
    first = temperature[0]
    rod = first + z*0.05*(first - 300.0)/across
    for flow, position in zip(heat + [-answer["heat_from_discs"]], content["bearings"]["positions"] + [0.12], strict=True):
        rod -= numpy.maximum(z - position, 0.0)*flow/across
    checks.below("a rod with sources", numpy.abs(rod - temperature).max()/30.0, 1.0e-11)
    checks.below("its far end", across*(temperature[-1] - temperature[-2])/(z[-1] - z[-2])/(-0.1*(temperature[-1] - 320.0)) - 1.0, 1.0e-9)
    at_disc = temperature[numpy.abs(z - 0.12).argmin()]
    checks.below("its disc", answer["heat_from_discs"]/(0.02*(at_disc - 305.0)) - 1.0, 1.0e-11)
    checks.that("bearings are unlike", abs(answer["shaft_temperature_1"] - answer["shaft_temperature_2"]) > 0.1)
    for number, kind in ((2, JOURNAL), (3, THRUST)):
        one, _ = alone(folder, number, answer, kind, 0.0)
        checks.below(f"bearing {number} alone: heat", (one["heat_to_shaft"] - heat[number - 1])/answer["power_loss"], 1.0e-9)
        checks.below(f"bearing {number} alone: loss", one["power_loss"]/answer[f"power_loss_{number}"] - 1.0, 1.0e-9)
    check_response(checks, folder, "with heat", content, (JOURNAL, JOURNAL, THRUST), {}, 0.0)
    mirrored = copy.deepcopy(content)
    for group in ("discs", "unbalance", "loads"):
        mirrored[group]["positions"] = 0.2 - content[group]["positions"]
    mirrored["loads"]["moments_x"] *= -1.0
    mirrored["bearings"] |= {"positions": [0.2 - one for one in content["bearings"]["positions"]], "facing": [1, 1, -1]}
    mirrored["machine"] |= {"axial_load": -20.0} | {key: content["machine"][key][::-1]
                                                   for key in ("shaft_end_conductance", "shaft_end_temperature")}
    other = solve(folder, "mirrored", mirrored)
    checks.below("mirrored: temperatures", max(abs(other[f"shaft_temperature_{i}"] - answer[f"shaft_temperature_{i}"])
                                               for i in (1, 2, 3))/30.0, 1.0e-9)


def check_runaway(checks, folder):
    """A shaft that heat cannot leave: there is no equilibrium, and the run says how warm it was."""
    content = hot_machine(folder)
    for name in content["bearings"]["files"]:
        text = (folder/name).read_text(encoding="utf-8")
        (folder/name).write_text(text.replace("sleeve_conductance = 0.5", "sleeve_conductance = 0.002"), encoding="utf-8")
    del content["discs"]["heat_conductances"], content["discs"]["heat_temperatures"]
    del content["machine"]["shaft_end_conductance"], content["machine"]["shaft_end_temperature"]
    content["machine"]["speed_rpm"] = 3.0*SPEED
    answer = solve(folder, "runaway", content, status=2)
    checks.that("a shaft that heat cannot leave", "it may warm up without an end" in answer.log)


def check_apart(checks, folder):
    """Two equal bearings on a shaft that hardly conducts and is insulated: each is as on an insulated shaft alone."""
    content = machine(folder, HOT)
    content["bearings"]["files"] = [journal(folder, heat=HOT)]*2
    content["machine"]["shaft_conductivity"] = 1.0e-9
    del content["unbalance"], content["dynamics"]
    content["scene"]["analysis"] = "equilibrium"
    answer = solve(folder, "apart", content)
    where = place(answer, 1, JOURNAL)
    one = run_file(folder/journal(folder, "held", CLEARANCE[0], 0.0, eccentricity=tuple(where[:2]), tilt=tuple(where[2:])), folder)
    checks.below("far apart: temperature of the shaft", (one["shaft_temperature"] - answer["shaft_temperature_1"])/30.0, 1.0e-7)
    checks.below("far apart: loss", one["power_loss"]/answer["power_loss_1"] - 1.0, 1.0e-8)
    checks.below("far apart: energy", answer["energy_imbalance"], 1.0e-11)


def check_wrong(checks, folder):
    """Mistakes are named with their rule."""
    content = machine(folder, thrust=[thrust(folder)], thrust_positions=[0.01])
    for words, group, key, value in (
            ("a thrust bearing needs axial_load", "machine", "axial_load", None),
            ("it must press the runner on the pads of bearing 3, which face +z", "machine", "axial_load", -1.0),
            ("must be 1 or -1", "bearings", "facing", [1, 1, 0.5]),
            ("needs support_stiffness_x and", "bearings", "support_mass", 0.1),
            ("must be given where support_stiffness_x is", "bearings", "support_stiffness_x", 1.0e7),
            ("no journal bearing holds the shaft across", "bearings", "files", ["thrust.nml"]*3)):
        wrong = copy.deepcopy(content)
        wrong[group][key] = value
        if value is None:
            del wrong[group][key]
        checks.that(words, words in solve(folder, "wrong", wrong, status=1).complaint)
    soft = copy.deepcopy(content)
    soft["bearings"] |= {"support_stiffness_x": 1.0e7, "support_stiffness_y": 1.0e7}
    checks.that("a thrust bearing on a support", "must be 0 there" in solve(folder, "wrong", soft, status=1).complaint)
    facing = copy.deepcopy(content)
    facing["bearings"] |= {"files": content["bearings"]["files"] + ["thrust.nml"], "positions": [0.03, 0.17, 0.01, 0.01],
                           "facing": [1, 1, 1, -1]}
    checks.that("no play", "leaves 0 m in all for the gaps" in solve(folder, "wrong", facing, status=1).complaint)
    outside = machine(folder)
    outside["bearings"]["positions"] = [0.012, 0.17]
    checks.that("beyond the end", "reaches beyond an end of the shaft" in solve(folder, "wrong", outside, status=1).complaint)
    hot = hot_machine(folder)
    hot["bearings"]["files"][0] = journal(folder, "own", heat=0.0)
    checks.that("a shaft of its own", "the bearing has no shaft of its own" in solve(folder, "wrong", hot, status=1).complaint)
    for words, changed in (("shaft_end_temperature is required with", {"shaft_end_temperature": None}),
                           ("needs shaft_conductivity", {"shaft_conductivity": None}),
                           ("is required with shaft_film_conductance", {"shaft_film_conductance": 10.0})):
        wrong = hot_machine(folder)
        del wrong["discs"]["heat_conductances"], wrong["discs"]["heat_temperatures"]
        wrong["machine"] = {key: value for key, value in (wrong["machine"] | changed).items() if value is not None}
        checks.that(words, words.split(" ", 1)[1] in solve(folder, "wrong", wrong, status=1).complaint)
    cold = machine(folder)
    cold["machine"]["shaft_conductivity"] = 20.0
    checks.that("no heat", "no bearing has &thermal" in solve(folder, "wrong", cold, status=1).complaint)
    without = machine(folder)
    without["machine"]["axial_load"] = 1.0
    checks.that("nothing carries axial_load", "no thrust bearing" in solve(folder, "wrong", without, status=1).complaint)


if __name__ == "__main__":
    run_checks((check_thrust, check_one_journal, check_two_sides, check_supports, check_heat, check_apart, check_wrong), (check_runaway,))
