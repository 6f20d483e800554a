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


def check_other_speeds(checks, folder):
    """The response at the rows' other speeds, over the largest amplitude of each, as the rows' agreement has it. Next to a critical speed
    1e-5 of a mode are 2e-4 of the response: on 160 x 24."""
    for row in REFERENCE["linear"]:
        for one in row["unbalance"]["rows"]:
            if abs(one["speed_rpm"] - row["speed_rpm"]) <= 0.0:
                continue
            content = machine_case(folder, row, (160, 24))
            content["dynamics"] = {"response_speeds": [one["speed_rpm"]], "largest_frequency": 0.1*row["modes"][0]["A"][1]}
            answer = solve(folder, "machine", content)
            with h5py.File(f"{answer.stem}.h5", "r") as file:
                response = file["dynamics/response"][...].reshape(-1, 5)
            largest = max(amplitude for known in one["A"].values() for amplitude, _ in known)
            for place, known in one["A"].items():
                got = response[numpy.abs(response[:, 0] - float(place)).argmin()]
                ours = got[1::2]*numpy.exp(1j*got[2::2])
                theirs = numpy.array([amplitude*numpy.exp(1j*math.radians(phase)) for amplitude, phase in known])
                checks.below(f"{row['machine']}: response at {one['speed_rpm']:g} rpm, {place} m",
                             numpy.abs(ours - theirs).max()/largest, max(AGREE, one["agreement"]))


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


def check_critical(checks, folder):
    """A critical speed is where the response itself is largest, its factor that of the speeds at which it has 0.707 of that."""
    row = REFERENCE["linear"][0]
    content = machine_case(folder, row, COARSE, 1)
    content["dynamics"]["response_speeds"] = [9000.0, 6000.0, 7000.0, 8000.0]
    answer = solve(folder, "critical", content)
    critical, factor = answer["critical_speed_1"], answer["amplification_factor_1"]
    checks.that("one critical speed", "critical_speed_2" not in answer.summary)
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        sides = file["dynamics/critical_speed"][0, 3:5]
        checks.that("responses in the order of their speeds", list(file["dynamics/response_speed"][...].ravel().round(6)) == [6e3, 7e3, 8e3, 9e3])
    checks.below("amplification factor", factor/(critical/(sides[1] - sides[0])) - 1.0, 1.0e-12)
    content["dynamics"]["response_speeds"] = [sides[0], 0.998*critical, critical, 1.002*critical, sides[1]]
    again = solve(folder, "again", content)
    with h5py.File(f"{again.stem}.h5", "r") as file:
        axes = file["dynamics/response_axes"][...].reshape(5, -1, 4)[:, 2, 1]
    checks.that("the response is largest there", axes[2] > max(axes[1], axes[3]))
    checks.below("half the power below", axes[0]/axes[2] - math.sqrt(0.5), 1.0e-5)
    checks.below("half the power above", axes[4]/axes[2] - math.sqrt(0.5), 1.0e-5)
    checks.below("critical speed of other speeds", again["critical_speed_1"]/critical - 1.0, 1.0e-5)
    del content["dynamics"]["response_speeds"]
    content["sweep"] = {"parameter": "speed_rpm", "values": (6500.0, 8000.0, 9000.0)}
    checks.below("critical speed of a sweep", solve(folder, "swept", content)["critical_speed_1"]/critical - 1.0, 1.0e-5)
    del content["sweep"], content["unbalance"]
    content["dynamics"]["response_speeds"] = [6000.0]
    checks.that("speeds without unbalance", "needs &unbalance" in solve(folder, "wrong", content, status=1).complaint)


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
        checks.below(f"{words}: {words_of}", numpy.abs(ours[:, columns] - theirs[:, columns]).max()/size, 1.0e-11)


def check_balance(checks, base, content):
    """Forces and moments of all films carry the weight."""
    force = -numbers(base, FORCES)[:, :2].sum(axis=0)
    weight = base["mass"]*numpy.array(content["machine"]["gravity"])
    checks.below("forces", numpy.abs(force + weight).max()/numpy.abs(weight).max(), 1.0e-11)
    moments = numbers(base, FORCES)[:, 2:].sum(axis=0)
    lever = numpy.array(content["bearings"]["positions"]) - base["centre_of_mass"]
    by_force = -numbers(base, FORCES)[:, :2]*lever[:, None]
    moment = moments + (-by_force[:, 1].sum(), by_force[:, 0].sum())
    checks.below("moments about the centre of mass", numpy.abs(moment).max()/(numpy.abs(weight).max()*numpy.abs(lever).max()), 1.0e-11)


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


ROTOR = {"mass": 2.0, "transverse_inertia": 0.02, "polar_inertia": 7.0e-3, "bearing_distance": 0.15}
STIFFER = (5.0e12, 1.0e13, 2.0e13)  # moduli of a shaft, each twice the one before


def rigid_bearing():
    """A bearing of two equal ones, as the rows have them, on a coarse mesh over the whole width."""
    return {"scene": {"analysis": "linear_dynamics"},
            "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6, "leading_edge_angle": 0.0},
            "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101350.0},
            "model": {"foil": "elastic_foundation", "foundation_stiffness": 4.7e9, "half_width": "no"},
            "foil_damping": {"foundation_damping": 3.0e5}, "mesh": dict(zip(("circumferential_elements", "axial_elements"), COARSE)),
            "operation": {"speed_rpm": 13000.0, "load": (-19.62, 0.0)}, "dynamics": {"frequency_ratios": 1.0}}


def stiff_machine(folder, modulus, highest, density=1000.0):
    """The rotor as a shaft with a disc, both together of its mass and inertias."""
    write_case(folder, "equal", rigid_bearing())
    radius, whole = 19.05e-3, 0.19
    mass = density*math.pi*radius**2*whole
    return {"scene": {"analysis": "linear_dynamics"},
            "shaft": {"lengths": [0.02, 0.075, 0.075, 0.02], "outer_diameters": 2.0*radius, "youngs_modulus": modulus,
                      "poissons_ratio": 0.3, "density": density, "elements": 1},
            "discs": {"positions": 0.095, "masses": 2.0*ROTOR["mass"] - mass, "polar_inertias": ROTOR["polar_inertia"] - mass*radius**2/2.0,
                      "transverse_inertias": ROTOR["transverse_inertia"] - mass*(radius**2/4.0 + whole**2/12.0)},
            "bearings": {"files": ["equal.nml", "equal.nml"], "positions": [0.02, 0.17]},
            "machine": {"speed_rpm": 13000.0, "gravity": (-9.81, 0.0)}, "dynamics": {"largest_frequency": highest}}


def to_rigid(values):
    """Values of three shafts, each twice as stiff as the one before, extrapolated to a rigid one: their error goes with compliance."""
    return (values[0] - 6.0*values[1] + 8.0*values[2])/3.0


def modes_of(answer):
    """Rates of the modes that vibrate."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        rate = file["dynamics/mode_growth_rate"][...].ravel() + 1j*file["dynamics/mode_frequency"][...].ravel()
    return rate[rate.imag > 0.0]


def check_rigid(checks, folder):
    """A rigid rotor on two equal bearings is the limit of a machine: all six of its modes, of both kinds, and its place."""
    rotor = solve(folder, "rotor", rigid_bearing() | {"rotor": ROTOR})
    known = modes_of(rotor)
    machines, found = [], []
    for modulus in STIFFER:
        machines.append(solve(folder, "stiff", stiff_machine(folder, modulus, 1200.0)))
        found.append(modes_of(machines[-1]))
    checks.that("as many modes", all(len(rates) == len(known) for rates in found))
    for one in known:
        limit = to_rigid([rates[numpy.abs(rates - one).argmin()] for rates in found])
        checks.below(f"rigid limit, mode {one:.5g} 1/s", abs(limit/one - 1.0), 2.0e-9)
    checks.below("rigid limit, eccentricity", to_rigid([one["eccentricity_x_1"] for one in machines])/rotor["eccentricity_x"] - 1.0, 1.0e-10)


def check_rigid_onset(checks, folder):
    """The same limit of the onset of whirl."""
    sweep = {"sweep": {"parameter": "speed_rpm", "values": (12600.0, 13600.0)}}
    known = solve(folder, "rotor", rigid_bearing() | {"rotor": ROTOR} | sweep)["onset_speed_rpm"]
    found = [solve(folder, "stiff", stiff_machine(folder, modulus, 800.0) | sweep)["onset_speed_rpm"] for modulus in STIFFER]
    checks.below("rigid limit, onset", to_rigid(found)/known - 1.0, 5.0e-8)


def check_start(checks, folder):
    """Where levers lead to no equilibrium it is come to from a higher speed; what is doubtful is a warning."""
    content = coarse(folder)
    content["machine"] |= {"speed_rpm": 2500.0, "gravity": (-20.0, 0.0)}
    answer = solve(folder, "slow", content)
    checks.that("from a higher speed", "from a higher speed" in answer.log)
    checks.that("down to its own, where the film is thinner", answer["minimum_gap_2"] < 0.1e-6)
    check_balance(checks, answer, content)
    content["machine"]["speed_rpm"] = 300.0
    checks.that("a machine that touches down", "touches down" in solve(folder, "slower", content, status=2).log)
    short = machine_case(folder, REFERENCE["linear"][0], COARSE, 1)
    short["shaft"]["elements"] = 1
    short["dynamics"]["largest_frequency"] = 2.0e4
    checks.that("few elements", "elements, 4 are needed" in solve(folder, "short", short, options=("--check",)).log)
    alone = coarse(folder)
    alone["bearings"] = {"files": alone["bearings"]["files"][:1], "positions": [0.2]}
    checks.that("one bearing", "one bearing alone holds the shaft" in solve(folder, "alone", alone, options=("--check",)).log)
    alone["machine"]["gravity"] = (0.0, 0.0)
    checks.that("nothing that loads", "neither weight nor loads" in solve(folder, "alone", alone, options=("--check",)).log)


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
        for check in ((check_all_references, check_other_speeds, check_onset, check_rigid_onset) if "--long" in sys.argv else
                      (check_reference, check_critical, check_rigid, check_start, check_invariants, check_wrong)):
            check(checks, pathlib.Path(name))
    checks.close()


if __name__ == "__main__":
    main()
