#!/usr/bin/env python3
"""A shaft in two bearings: two independent programs (statics, modes, unbalance response), mirror, turns and moves of the whole,
a bearing by itself, ranks, a wrong file."""

import copy
import json
import math
import pathlib
import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, run_file, solve, write_case

REFERENCE = json.loads((pathlib.Path(__file__).parent/"reference/machine.json").read_text(encoding="utf-8"))
PLACES = ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")
FORCES = ("force_x", "force_y", "torque_x", "torque_y")
AGREE = 2.0e-5  # of the two programs with gfb
COARSE = (60, 6)


def machine_case(folder, row, mesh=(120, 16), order=2):
    """The case of a machine; its bearings' files are written."""
    machine = REFERENCE["machines"][row["machine"]]
    files = []
    for number, bearing in enumerate(machine["bearings"], 1):
        files.append(f"{row['machine']}_{number}.nml")
        write_case(folder, files[-1][:-4], {
            "scene": {"analysis": "linear_dynamics"},
            "bearing": {key: bearing[key] for key in ("radius", "length", "clearance", "leading_edge_angle")},
            "gas": {key: machine[key] for key in ("viscosity", "ambient_pressure")},
            "model": {"foil": "elastic_foundation", "foundation_stiffness": bearing["foundation_stiffness"], "film_order": order},
            "foil_damping": {"foundation_damping": bearing["foundation_damping"]},
            "mesh": {"circumferential_elements": mesh[0], "axial_elements": mesh[1]},
            "operation": {"speed_rpm": row["speed_rpm"], "load": (-20.0, 0.0)}, "dynamics": {"frequency_ratios": 1.0}})
    shaft, discs = machine["shaft"], machine["disks"]
    content = {
        "scene": {"analysis": "linear_dynamics"},
        "shaft": {"lengths": [one["length"] for one in shaft], "outer_diameters": [one["outer"] for one in shaft],
                  "inner_diameters": [one["inner"] for one in shaft], "youngs_modulus": shaft[0]["E"], "shear_modulus": shaft[0]["G"],
                  "density": shaft[0]["rho"], "shear_coefficient": shaft[0]["kappa"], "elements": 8},
        "discs": {"positions": [one["z"] for one in discs], "masses": [one["mass"] for one in discs],
                  "transverse_inertias": [one["It"] for one in discs], "polar_inertias": [one["Ip"] for one in discs]},
        "bearings": {"files": files, "positions": [one["z"] for one in machine["bearings"]]},
        "machine": {"speed_rpm": row["speed_rpm"], "gravity": tuple(machine["gravity"]),
                    "journal_tilts": row.get("journal_tilts", machine["journal_tilts"])},
        "dynamics": {"largest_frequency": 1.3*max(mode["A"][1] for mode in row["modes"])},
        "unbalance": {"positions": [row["unbalance"]["position"]], "values": [row["unbalance"]["value"]],
                      "angles": [row["unbalance"]["angle"]]}}
    loads = machine.get("loads", [])
    if loads:
        content["loads"] = {"positions": [one[0] for one in loads], "forces_x": [one[1] for one in loads],
                            "forces_y": [one[2] for one in loads]}
    return content


def numbers(answer, names, bearings=2):
    """Results of each bearing."""
    return numpy.array([[answer[f"{name}_{i}"] for name in names] for i in range(1, bearings + 1)])


def check_row(checks, folder, row):
    """Statics, modes and response of a machine as two programs have them."""
    name = f"{row['machine']}{'' if row.get('journal_tilts', True) else ', without tilts'}"
    answer = solve(folder, "machine", machine_case(folder, row))
    expected = numpy.array(row["eccentricity_and_tilt"]["A"])
    for columns, words in ((slice(0, 2), "eccentricity"), (slice(2, 4), "tilt")):
        size = numpy.abs(expected[:, columns]).max()
        if size > 0.0:
            agreement = row["eccentricity_and_tilt"]["agreement_" + words] or 0.0
            checks.below(f"{name}: {words}", numpy.abs(numbers(answer, PLACES)[:, columns] - expected[:, columns]).max()/size,
                         max(AGREE, agreement))
    load = numpy.array(row["film_on_shaft"]["A"])
    force = numbers(answer, FORCES)
    checks.below(f"{name}: forces", numpy.abs(-force[:, :2] - load[:, :2]).max()/numpy.abs(load[:, :2]).max(), AGREE)
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        rate = file["dynamics/mode_growth_rate"][...].ravel() + 1j*file["dynamics/mode_frequency"][...].ravel()
        response = file["dynamics/response"][...]
    for mode in row["modes"]:
        known = complex(*mode["A"])
        checks.below(f"{name}: mode {known:.5g} 1/s", numpy.abs(rate - known).min()/abs(known), max(AGREE, mode["agreement"]))
    for one in row["unbalance"]["rows"]:
        if abs(one["speed_rpm"] - row["speed_rpm"]) > 0.0:
            continue
        for place, known in one["A"].items():
            got = response[numpy.abs(response[:, 0] - float(place)).argmin()]
            for k, (amplitude, phase) in enumerate(known):
                ours = got[1 + 2*k]*numpy.exp(1j*got[2 + 2*k])
                theirs = amplitude*numpy.exp(1j*math.radians(phase))
                checks.below(f"{name}: response at {place} m, {'xy'[k]}", abs(ours - theirs)/abs(theirs), max(AGREE, one["agreement"]))


def check_reference(checks, folder):
    """The machine with a disc off its middle."""
    check_row(checks, folder, REFERENCE["linear"][0])


def check_all_references(checks, folder):
    """Journals that count as parallel, a slender shaft, a light hollow one that whirls."""
    for row in REFERENCE["linear"][1:]:
        check_row(checks, folder, row)


def check_onset(checks, folder):
    """The speed at which a machine begins to whirl, and a sweep's rows: those of its points alone."""
    row = REFERENCE["linear"][2]
    known = row["onset"]["A"]["speed_rpm"]
    content = machine_case(folder, row | {"speed_rpm": 0.95*known})
    content["dynamics"]["largest_frequency"] = 1.5*row["onset"]["A"]["whirl"]
    content["sweep"] = {"parameter": "speed_rpm", "values": (0.95*known, 1.04*known)}
    answer = solve(folder, "sweep", content)
    checks.below("onset", answer["onset_speed_rpm"]/known - 1.0, AGREE)
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        growth = file["dynamics/mode_growth_rate"][:, 0]
    checks.that("the growth changes its sign", growth[0] < 0.0 < growth[1])
    alone = copy.deepcopy(content)
    del alone["sweep"]
    alone["machine"]["speed_rpm"] = 1.04*known
    there = solve(folder, "alone", alone)
    for name in ("growth_rate", "whirl_frequency", "eccentricity_x_1", "tilt_y_2"):
        checks.below(f"a sweep's last point: {name}", answer[name]/there[name] - 1.0, 1.0e-7)


def coarse(folder):
    """A machine on a coarse mesh, at rest in its equilibrium."""
    content = machine_case(folder, REFERENCE["linear"][0], COARSE, 1)
    content["scene"]["analysis"] = "equilibrium"
    return {group: keys for group, keys in content.items() if group not in ("dynamics", "unbalance")}


def check_invariants(checks, folder):
    """What must not matter: the end from which is counted, where the machine stands, and which way it is turned."""
    content = coarse(folder)
    base = solve(folder, "base", content)
    whole = sum(content["shaft"]["lengths"])
    mirrored = copy.deepcopy(content)
    for keys in ("lengths", "outer_diameters", "inner_diameters"):
        mirrored["shaft"][keys] = mirrored["shaft"][keys][::-1]
    for group in ("discs", "bearings"):
        for key, value in mirrored[group].items():
            mirrored[group][key] = [whole - one for one in value][::-1] if key == "positions" else value[::-1]
    other = solve(folder, "mirrored", mirrored)
    turned = numbers(other, PLACES)[::-1]*(1.0, 1.0, -1.0, -1.0)
    compare(checks, "mirrored", turned, numbers(base, PLACES))
    moved = copy.deepcopy(content)
    shift, turn = (3.0e-6, -2.0e-6), (4.0e-5, -3.0e-5)
    places = content["bearings"]["positions"]
    moved["bearings"] |= {"offset_x": [shift[0] + turn[1]*z for z in places], "offset_y": [shift[1] - turn[0]*z for z in places],
                          "misalignment_x": turn[0], "misalignment_y": turn[1]}
    compare(checks, "all sleeves moved and turned as one body", numbers(solve(folder, "moved", moved), PLACES), numbers(base, PLACES))
    check_turned(checks, folder, content)
    compare(checks, "two ranks", numbers(solve(folder, "ranks", content, ranks=2), PLACES), numbers(base, PLACES))
    light = copy.deepcopy(content)
    light["machine"]["gravity"] = (0.0, 0.0)
    checks.below("without weight", numpy.abs(numbers(solve(folder, "light", light), PLACES)[:, :2]).max(), 1.0e-12)
    check_balance(checks, base, content)
    check_shaft(checks, base, content)
    check_alone(checks, folder, base, content)


def check_turned(checks, folder, content):
    """Three equal pads a bearing: a third of a turn changes nothing but directions."""
    for name in content["bearings"]["files"]:
        text = (folder/name).read_text(encoding="utf-8")
        (folder/f"pads_{name}").write_text(text.replace("leading_edge_angle = 0.1", "leading_edge_angle = 0.0") +
                                           "&pads\ncount = 3\narc = 2.0\npreload = 0.1\n/\n", encoding="utf-8")
    padded = copy.deepcopy(content)
    padded["bearings"]["files"] = [f"pads_{name}" for name in content["bearings"]["files"]]
    down, angle = 0.4*content["machine"]["gravity"][0], 2.0*math.pi/3.0  # three pads carry less
    places = []
    for gravity in ((down, 0.0), (down*math.cos(angle), down*math.sin(angle))):
        padded["machine"]["gravity"] = gravity
        places.append(numbers(solve(folder, "turned", padded), PLACES))
    back = numpy.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    compare(checks, "turned about the axis", numpy.hstack((places[1][:, :2] @ back.T, places[1][:, 2:] @ back.T)), places[0])


def compare(checks, words, ours, theirs):
    """Places of all journals, over the largest of their kind."""
    for words_of, columns in (("eccentricity", slice(0, 2)), ("tilt", slice(2, 4))):
        size = numpy.abs(theirs[:, columns]).max()
        checks.below(f"{words}: {words_of}", numpy.abs(ours[:, columns] - theirs[:, columns]).max()/size, 1.0e-8)


def check_balance(checks, base, content):
    """Forces and moments of all films carry the weight."""
    force = -numbers(base, FORCES)[:, :2].sum(axis=0)
    weight = base["mass"]*numpy.array(content["machine"]["gravity"])
    checks.below("forces", numpy.abs(force + weight).max()/numpy.abs(weight).max(), 1.0e-8)
    moments = numbers(base, FORCES)[:, 2:].sum(axis=0)
    lever = numpy.array(content["bearings"]["positions"]) - base["centre_of_mass"]
    by_force = -numbers(base, FORCES)[:, :2]*lever[:, None]
    moment = moments + (-by_force[:, 1].sum(), by_force[:, 0].sum())
    checks.below("moments about the centre of mass", numpy.abs(moment).max()/(numpy.abs(weight).max()*numpy.abs(lever).max()), 1.0e-7)


def check_shaft(checks, base, content):
    """Along the shaft: shear jumps at a bearing by what it carries, at a disc by its weight; free ends; the line for ParaView."""
    with h5py.File(f"{base.stem}.h5", "r") as file:
        rows, table = file["shaft/sections"][...], file["shaft/bearings"][...]
    force = -numbers(base, FORCES)
    size = numpy.abs(force[:, :2]).max()
    acting = [(z, *forces) for z, forces in zip(content["bearings"]["positions"], force[:, :2])]
    acting += [(z, mass*content["machine"]["gravity"][0], mass*content["machine"]["gravity"][1])
               for z, mass in zip(content["discs"]["positions"], content["discs"]["masses"])]
    for z, *acts in acting:
        left, right = (rows[k::2][numpy.abs(rows[k::2, 0] - z) < 1.0e-9] for k in (1, 0))
        checks.below(f"shear jumps at {z} m", numpy.abs(left[:, 4:6] - right[:, 4:6] - acts).max()/size, 1.0e-8)
    checks.below("free ends", numpy.abs(rows[[0, -1], 2:6]).max()/size, 1.0e-8)
    checks.that("its bearings", table[:, 0].tolist() == list(content["bearings"]["positions"]) and (table[:, 3] < 1.0e-4).all())
    with h5py.File(f"{base.stem}.shaft.vtkhdf", "r") as file:
        checks.that("a line of pieces", set(file["VTKHDF/Types"][...]) == {3} and len(file["VTKHDF/Points"]) == len(rows))
        checks.below("stress in both files", numpy.abs(file["VTKHDF/PointData/bending_stress"][...].ravel() - rows[:, 6]).max(), 1.0e-6)


def check_alone(checks, folder, base, content):
    """A bearing by itself at the place that it has in the machine."""
    text = (folder/content["bearings"]["files"][0]).read_text(encoding="utf-8")
    place = [base[f"{name}_1"] for name in PLACES]
    groups = text[:text.index("&operation")].replace("linear_dynamics", "fixed_position")
    groups = groups[:groups.index("&foil_damping")] + groups[groups.index("&mesh"):]
    (folder/"alone.nml").write_text(groups + "&operation\n" + f"speed_rpm = {content['machine']['speed_rpm']}\n"
                                    f"eccentricity = {place[0]!r}, {place[1]!r}\ntilt = {place[2]!r}, {place[3]!r}\n/\n",
                                    encoding="utf-8")
    alone = run_file(folder/"alone.nml", folder)
    for name in ("force_x", "force_y", "torque_y"):
        checks.below(f"alone: {name}", alone[name]/base[f"{name}_1"] - 1.0, 1.0e-8)


def check_wrong(checks, folder):
    """Mistakes are named with their rule."""
    content = coarse(folder)
    for words, group, key, value in (("beyond the end of the shaft", "discs", "positions", [0.9]), ("does not exist", "bearings", "files",
                                     ["none.nml", "M1_2.nml"]), ("must be less than the outer", "shaft", "inner_diameters", 0.05),
                                     ("one value for all", "shaft", "density", [7850.0, 7800.0]),
                                     ("twice the transverse", "discs", "transverse_inertias", [0.001])):
        wrong = copy.deepcopy(content)
        wrong[group][key] = value
        answer = solve(folder, "wrong", wrong, status=1)
        checks.that(f"{group}%{key}: {words}", words in answer.complaint)
    swept = content | {"sweep": {"parameter": "load", "values": (1.0, 2.0)}}
    checks.that("a sweep of loads", "must be 'speed_rpm' beside &shaft" in solve(folder, "wrong", swept, status=1).complaint)
    near = copy.deepcopy(content)
    near["bearings"]["positions"] = [0.02, 0.04]
    checks.that("bearings that overlap", "overlaps that of positions(1)" in solve(folder, "wrong", near, status=1).complaint)
    thin = copy.deepcopy(content)
    thin["shaft"]["outer_diameters"][0] = 0.036
    checks.that("a journal of another diameter", "has a diameter of 0.036 m" in solve(folder, "thin", thin, options=("--check",)).log)
    answer = solve(folder, "wrong", content | {"mesh": {"axial_elements": 4}}, status=1)
    checks.that("&mesh of the machine", "belongs into the files of the bearings" in answer.complaint)
    answer = solve(folder, "wrong", {group: keys for group, keys in content.items() if group != "shaft"}, status=1)
    checks.that("&machine without &shaft", "needs &shaft" in answer.complaint)


def main():
    """Runs all checks."""
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        for check in ((check_all_references, check_onset) if "--long" in sys.argv else (check_reference, check_invariants, check_wrong)):
            check(checks, pathlib.Path(name))
    checks.close()


if __name__ == "__main__":
    main()
