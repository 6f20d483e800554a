#!/usr/bin/env python3
"""A machine over time: a small push dies out as its modes do, nothing moves at rest, a run that was killed
goes on bit for bit, ranks agree; with --long orbits and a run-up of two independent programs."""

import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

from gfb_run import Checks, run_file, solve, write_case
import machine_parts
from machine import REFERENCE, machine_case

COARSE, MIDDLE = (40, 4), (60, 8)
SETTLED = 0.015  # when what is damped most has died out [s]
AXES = ("x", "y")
CLEARANCE, HALF_WIDTH, WEIGHT = 31.8e-6, 19.05e-3, 44.0  # of M1 [m], [m], [N]


def moving_case(folder, name, speed_rpm, transient, unbalance=None, mesh=COARSE, stations=()):
    """A machine of the reference over time."""
    row = next(one for one in REFERENCE["linear"] if one["machine"] == name)
    content = machine_case(folder, row | {"speed_rpm": speed_rpm, "journal_tilts": True}, mesh)
    content["scene"] = {"analysis": "transient"}
    del content["dynamics"], content["unbalance"]
    if unbalance:
        content["unbalance"] = {"positions": [unbalance["position"]], "values": [unbalance["value"]], "angles": [unbalance["angle"]]}
    if stations:
        content["machine"]["stations"] = list(stations)
    content["transient"] = transient
    return content


def lines(stem):
    """Columns over time."""
    with h5py.File(f"{stem}.h5", "r") as file:
        return {name: file["transient"][name][...].ravel() for name in file["transient"]}


def linear(folder, name, speed_rpm, mesh=COARSE):
    """Rates of all modes."""
    row = next(one for one in REFERENCE["linear"] if one["machine"] == name)
    answer = solve(folder, "linear", machine_case(folder, row | {"speed_rpm": speed_rpm, "journal_tilts": True}, mesh))
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        return file["dynamics/mode_growth_rate"][...].ravel() + 1j*file["dynamics/mode_frequency"][...].ravel()


def fitted(time_of, motion, rates):
    """The rate of the first mode with which all of them fit a motion best, by Gauss and Newton."""
    def basis(first):
        columns = [numpy.exp(rate*time_of) for rate in (first, *rates[1:])]
        return numpy.array([part for one in columns for part in (one.real, one.imag)] + [numpy.ones_like(time_of)]).T

    def left(first):
        matrix = basis(first)
        return motion - matrix@numpy.linalg.lstsq(matrix, motion, rcond=None)[0]

    first = rates[0]
    for _ in range(8):
        small = 1.0e-4*abs(first)
        slope = numpy.array([(left(first + step) - left(first - step))/(2.0*small) for step in (small, 1j*small)])
        change = numpy.linalg.lstsq(slope.reshape(2, -1).T, -left(first).ravel(), rcond=None)[0]
        first += complex(*change)
    return first, numpy.linalg.norm(left(first))/numpy.linalg.norm(motion - motion.mean(axis=0))


def check_push(checks, folder):
    """A push of a thousandth of the clearance dies out with the least damped mode; with the mean of two lengths of steps."""
    speed = 10000.0
    rates = linear(folder, "M1", speed)
    found = []
    for steps in (80, 160):
        content = moving_case(folder, "M1", speed, {"turns": 9.0, "steps_per_turn": steps, "pulse": (0.0, 2.0e-5), "pulse_position": 0.24,
                                                    "pulse_length": 1.0e-3})
        answer = solve(folder, f"push_{steps}", content)
        table = lines(answer.stem)
        late = table["time"] > SETTLED
        motion = numpy.array([table[f"{axis}_{place}"][late] for place in ("bearing_1", "disc_1", "bearing_2") for axis in AXES]).T
        rate, left = fitted(table["time"][late], motion/numpy.abs(motion).max(axis=0), rates)
        found.append(rate)
        checks.below(f"{steps} steps: what is left of a push beside its modes", left, 5.0e-3)
    extrapolated = (4.0*found[1] - found[0])/3.0
    checks.below("growth and frequency of a push", abs(extrapolated - rates[0])/abs(rates[0]), 1.0e-4)
    checks.within("error over that with steps half as long", abs(found[0] - rates[0])/abs(found[1] - rates[0]), 3.4, 4.6)


def check_rest(checks, folder):
    """Nothing moves where nothing drives it; steps by the error are few."""
    content = moving_case(folder, "M1", 10000.0, {"turns": 2.0})
    content["bearings"]["misalignment_x"] = [2.0e-5, 0.0]
    answer = solve(folder, "rest", content)
    for place in ("bearing_1", "disc_1", "bearing_2"):
        for axis in AXES:
            checks.below(f"rest: {axis} of {place}", answer[f"orbit_{axis}_{place}"]/CLEARANCE, 3.0e-8)


def check_restart(checks, folder):
    """A run that was killed goes on to the same bits; another bearing is refused."""
    content = moving_case(folder, "M1", 10000.0, {"turns": 0.6, "steps_per_turn": 50}, REFERENCE["orbit"][0]["unbalance"])
    content["output"] = {"restart_every": 5}
    whole = lines(solve(folder, "whole", content).stem)
    file = write_case(folder, "killed", content)
    there = folder/"killed.restart.h5"
    with subprocess.Popen([os.environ["GFB"], file.name], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
        while not there.exists() and run.poll() is None:
            time.sleep(0.002)
        run.kill()
    checks.that("a restart file is there", there.exists())
    run = run_file(file, folder, options=("--restart",))
    checks.that("resumed: said", "restart: resumed from time" in run.log)
    again = lines(folder/"killed")
    counts = ("newton_iterations", "factorizations")  # a resumed run has those of its own start
    differ = [column for column in whole if column not in counts and not numpy.array_equal(whole[column], again[column])]
    checks.that(f"resumed: columns that differ {differ}", not differ)
    with h5py.File(folder/"killed.h5", "r") as file:
        units = {name: data.attrs["unit"] for name, data in file["transient"].items()}
    strange = {name: unit for name, unit in units.items() if unit not in ("s", "1", "rad/s", "m", "rad", "N", "N m", "Pa")}
    checks.that(f"units that nobody knows: {strange}", not strange)


def check_all_kinds(checks, folder):
    """Nothing moves, whatever holds the shaft: a thrust bearing, films with heat, a sleeve on springs."""
    supports = {"support_mass": [0.0, 0.3], "support_stiffness_x": [0.0, 2.0e7], "support_stiffness_y": [0.0, 3.0e7]}
    for name, content in (("thrust", machine_parts.hot_machine(folder)), ("support", machine_parts.machine(folder, None, **supports))):
        still = {group: keys for group, keys in content.items() if group not in ("dynamics", "unbalance")}
        still |= {"scene": {"analysis": "transient"}, "transient": {"turns": 0.3, "steps_per_turn": 40}}
        answer = solve(folder, f"still_{name}", still)
        for axis in AXES:
            checks.below(f"{name}: {axis} at rest", answer[f"orbit_{axis}_bearing_2"]/CLEARANCE, 3.0e-8)
    pushed = still | {"transient": still["transient"] | {"pulse": (1.0e-3, 0.0), "pulse_length": 5.0e-4}}
    checks.that("support: a push moves it", solve(folder, "pushed", pushed)["orbit_x_bearing_2"] > 1.0e-3*CLEARANCE)


def check_foils(checks, folder):
    """Foils as beams that rub and have mass: nothing moves at rest; an unbalance does move it."""
    steel = {"youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "density": 8440.0, "thickness": 101.6e-6, "fixed_edge": "trailing"}
    write_case(folder, "beams", {
        "scene": {"analysis": "linear_dynamics"}, "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
        "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101350.0}, "model": {"foil": "beam"}, "foil_damping": {"foil_mass": "on"},
        "top_foil": steel, "bump_foil": steel | {"bumps": 26, "height": 0.508e-3, "half_length": 1.778e-3, "pitch": 4.572e-3, "fixed_line": "half_flat"},
        "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}, "mesh": {"circumferential_elements": 104, "axial_elements": 4},
        "operation": {"speed_rpm": 3.0e4, "load": (-20.0, 0.0)}, "dynamics": {"frequency_ratios": 1.0}})
    content = {"scene": {"analysis": "transient"},
               "shaft": {"lengths": 0.2, "outer_diameters": 0.038, "youngs_modulus": 2.1e11, "poissons_ratio": 0.3, "density": 7800.0},
               "discs": {"positions": 0.12, "masses": 4.0, "polar_inertias": 0.003},
               "bearings": {"files": ["beams.nml", "beams.nml"], "positions": [0.03, 0.17]}, "machine": {"speed_rpm": 3.0e4},
               "transient": {"turns": 0.2, "steps_per_turn": 60}}
    answer = solve(folder, "still_beams", content)
    checks.that("beams: their mass counts", "foil mass: of top foil and bumps" in answer.log)
    checks.below("beams: y at rest", answer["orbit_y_bearing_2"]/CLEARANCE, 1.0e-7)
    moved = solve(folder, "moved_beams", content | {"unbalance": {"positions": 0.12, "values": 4.0e-6}})
    checks.that("beams: an unbalance moves them", moved["orbit_y_bearing_2"] > 1.0e-3*CLEARANCE)


def check_wrong(checks, folder):
    """Mistakes are named with their rule."""
    content = moving_case(folder, "M1", 10000.0, {"turns": 0.1, "steps_per_turn": 50})
    for words, keys in (("needs pulse_position", {"couple_pulse": (1.0e-3, 0.0), "pulse_length": 1.0e-3}),
                        ("has no use beside &shaft", {"start_load": (1.0, 0.0)}), ("has no use beside &shaft", {"orbit_radius": 1.0e-6}),
                        ("or duration must say how long", {"duration": 1.0})):
        answer = solve(folder, "wrong", content | {"transient": content["transient"] | keys}, status=1)
        checks.that(f"{next(iter(keys))}: {words}", words in answer.complaint)
    touching = content | {"transient": {"duration": 0.02, "start_gravity": (-9.81, 0.0)}}
    touching["machine"] = content["machine"] | {"gravity": (-900.0, 0.0)}
    answer = solve(folder, "touching", touching, status=2)
    checks.that("touch-down names bearing and time", "touches down in bearing 2 at time" in answer["reason"])
    answer = solve(folder, "lost", content | {"machine": content["machine"] | {"gravity": (-9000.0, 0.0)}}, status=2)
    checks.that("a load that the first bearing does not bear: said", "bearing 1 alone under its load by levers" in answer["reason"])


def check_ranks(checks, folder):
    """One rank and two agree."""
    content = moving_case(folder, "M1", 10000.0, {"turns": 0.2, "steps_per_turn": 50}, REFERENCE["orbit"][0]["unbalance"])
    one = lines(solve(folder, "one", content).stem)
    two = lines(solve(folder, "two", content, ranks=2).stem)
    for name, size in (("x_disc_1", CLEARANCE), ("y_bearing_1", CLEARANCE), ("force_x_1", WEIGHT), ("tilt_y_2", CLEARANCE/HALF_WIDTH)):
        checks.below(f"two ranks: {name}", numpy.abs(one[name] - two[name]).max()/size, 1.0e-11)


def turn_of(table, place, axis, turns=1.0):
    """The last turn of a motion: mean, first harmonic x = mean + Re(h e^(i W t)), and the instants over the turn."""
    last = table["turns"] > table["turns"][-1] - turns + 1.0e-9
    motion, angle = table[f"{axis}_{place}"][last], 2.0*math.pi*table["turns"][last]
    return motion.mean(), 2.0*(motion*numpy.exp(-1j*angle)).mean()


def check_orbits(checks, folder, mesh=MIDDLE):
    """Orbits by unbalance as two programs have them, two lengths of steps extrapolated."""
    for row in REFERENCE["orbit"]:
        found = []
        for steps in (100, 200):
            content = moving_case(folder, row["machine"], row["speed_rpm"], {"turns": 25.0, "steps_per_turn": steps}, row["unbalance"], mesh,
                                  row["stations"])
            table = lines(solve(folder, f"orbit_{steps}", content).stem)
            found.append(numpy.array([turn_of(table, f"station_{k}", axis) for k in range(1, len(row["stations"]) + 1) for axis in AXES]))
        mean, first = ((4.0*found[1] - found[0])/3.0).T
        known = numpy.array([complex(*one) for one in row["h1"]["A"]])
        name = f"{row['machine']} at {row['speed_rpm']:.0f} rpm"
        checks.below(f"{name}: first harmonic", numpy.abs(first - known).max()/numpy.abs(known).max(), 10.0*row["h1"]["agreement"])
        known = numpy.array(row["mean"]["A"])
        checks.below(f"{name}: mean", numpy.abs(mean - known).max()/numpy.abs(known).max(), 10.0*row["mean"]["agreement"])


def check_run_up(checks, folder, mesh=MIDDLE):
    """A run-up through a bending critical speed as two programs have it, two lengths of steps extrapolated."""
    for row in REFERENCE["run_up"]:
        known = numpy.array(row["A"])
        found = []
        for steps in (80, 160):
            content = moving_case(folder, row["machine"], row["first_speed_rpm"],
                                  {"duration": row["duration"], "final_speed_rpm": row["last_speed_rpm"], "steps_per_turn": steps},
                                  row["unbalance"], mesh, row["stations"])
            table = lines(solve(folder, f"run_up_{steps}", content).stem)
            motion = [table[f"{axis}_station_{k}"] for k in range(1, len(row["stations"]) + 1) for axis in AXES]
            found.append(numpy.array([[cubic(table["time"], one, at) for one in motion] for at in row["times"]]))
        ours = (4.0*found[1] - found[0])/3.0
        checks.below(f"{row['machine']}: run-up at {len(row['times'])} times, over its extent",
                     numpy.abs(ours - known).max()/numpy.ptp(known, axis=0).max(), 10.0*row["agreement"])


def cubic(instants, values, at):
    """A value between instants, by the cubic through four of them."""
    first = min(max(numpy.searchsorted(instants, at) - 2, 0), len(instants) - 4)
    here, there = instants[first:first + 4], values[first:first + 4]
    weights = [numpy.prod([(at - here[k])/(here[i] - here[k]) for k in range(4) if k != i]) for i in range(4)]
    return float(numpy.dot(weights, there))


def main():
    """Runs all checks."""
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        for check in ((check_orbits, check_run_up) if "--long" in sys.argv else (check_push, check_rest, check_all_kinds, check_foils, check_restart, check_ranks, check_wrong)):
            check(checks, pathlib.Path(name))
    checks.close()


if __name__ == "__main__":
    main()
