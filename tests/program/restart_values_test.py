#!/usr/bin/env python3
"""Restart files whose numbers somebody has changed, the checksum made anew: no value makes a run abort, and none a wrong answer.

A run of each kind is stopped. Then every dataset of its restart file in turn becomes what is no number, too large or negative, and
single numbers of the long ones each one of these: the run that goes on refuses the file with a sentence, or ends with the answer of
the file as it was, or without one, status 2. With --long other kinds of runs; what an earlier kind has too becomes too large alone."""

import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1]/name) for name in ("verification", "floating_point")]
import h5py  # noqa: E402
import numpy  # noqa: E402

from gfb_run import GFB, Checks, read_summary, seal, write_case  # noqa: E402 (found only now)
from gfb.bench import faults  # noqa: E402
from scenes import COARSE, HEAVY, MEAN, PLATES, PRESSED, ROTOR, SHELL, merged  # noqa: E402

SECONDS = 120
VALUES = (numpy.nan, 1.0e300, -1.0)
SINGLE = 3  # numbers of a list that are changed alone, each to one of the values in turn
SEED = 4
SAME = 1.0e-6
COST = ("wall_time", "peak_memory", "newton_iterations", "factorizations", "factorizations_finest", "critical_mass")
EVERY = {"output": {"restart_every": 1}}
LOADS = {"sweep": {"parameter": "load", "values": tuple(10.0 + i % 9 for i in range(30))}}
SMALL = {"sweep": {"parameter": "load", "values": tuple(4.0 + 0.1*(i % 9) for i in range(20))}}
BEAM = merged(SHELL, model={"foil": "beam"})
TURNS = {"scene": {"analysis": "transient"}, "transient": {"turns": 0.5, "steps_per_turn": 80}, "unbalance": {"unbalance": 1.0e-6}}
BOTH = {"rotor": {"transverse_inertia": 5.0e-3, "bearing_distance": 0.2},
        "foil_damping": {"foundation_damping": 3.0e5, "maxwell_stiffness": 3.0e9, "maxwell_time": 1.0e-4}}
HOT = next(scene["groups"] for scene in json.loads((pathlib.Path(__file__).resolve().parents[1]/"verification/reference/thermal.json")
                                                   .read_text(encoding="utf-8"))["scenes"] if scene["name"] == "load_growth")
FEW = {"sweep": merged(faults.CASE, **LOADS, mesh={"circumferential_elements": 24, "axial_elements": 4}),
       "strip": PLATES, "transient": merged(ROTOR, **TURNS)}
SPRINGS = merged(MEAN, mesh=COARSE, operation={"load": (-60.0, 0.0)}, **LOADS)
MORE = {"springs": SPRINGS, "beams": merged(BEAM, **SMALL),
        "memory": merged(BEAM, sweep=SMALL["sweep"] | {"friction_memory": True}),
        "held": merged(MEAN, mesh=COARSE, operation={"load": (-60.0, 0.0)}, sweep={
            "parameter": "tilt_x", "values": tuple(1.0e-5*i for i in range(20)), "hold_position": True}),
        "capacity": merged(MEAN, scene={"analysis": "load_capacity"}, operation={"load": (-50.0, 0.0)}, mesh=COARSE,
                           capacity={"smallest_gap": 5.0e-6}, sweep={
                               "parameter": "speed_rpm", "values": tuple(30000.0 + 1000.0*i for i in range(12))}),
        "dynamics": merged(ROTOR, scene={"analysis": "linear_dynamics"}, dynamics={"frequency_ratios": (0.5, 1.0)}, sweep={
            "parameter": "speed_rpm", "values": tuple(30000.0 + 1000.0*i for i in range(8))}),
        "partitioned": merged(SPRINGS, model={"coupling": "partitioned"}), "pressed": PRESSED,
        "heavy": merged(HEAVY, **TURNS | {"unbalance": {"unbalance": 2.0e-8}, "foil_damping": {"foil_mass": "on"}}),
        "two": merged(ROTOR, **TURNS | BOTH), "hot": merged(HOT, mesh=COARSE, sweep={
            "parameter": "load", "values": tuple(60.0 + i % 9 for i in range(20))}),
        "hot_turns": merged(HOT, **TURNS, mesh=COARSE, rotor={"mass": 1.5})}


def stopped(path, folder):
    """Runs a case until its restart file is there, and stops it; whether the file is left."""
    file = folder/f"{path.stem}.restart.h5"
    with subprocess.Popen([GFB, "--quiet", "--output", str(folder), str(path)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE) as process:
        while not file.exists() and process.poll() is None:
            time.sleep(0.002)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=SECONDS)
    return file.exists()


def resumed(path, folder):
    """A run that goes on from the file."""
    return subprocess.run([GFB, "--quiet", "--restart", "--output", str(folder), str(path)], stdin=subprocess.DEVNULL, capture_output=True,
                          encoding="utf-8", check=False, timeout=SECONDS)


def answer_of(path, folder):
    """Numbers of a summary, without the cost."""
    numbers, _ = read_summary(folder/f"{path.stem}.summary")
    return {name: value for name, value in numbers.items() if isinstance(value, float) and name not in COST}


def same(one, other):
    """Whether two answers are the same; small components against the largest number of their kind."""
    size = max((abs(value) for name, value in one.items() if name.startswith(("force", "eccentricity"))), default=0.0)
    return set(one) == set(other) and all(abs(value - other[name]) <= SAME*max(abs(value), abs(other[name])) or (
        abs(value - other[name]) <= SAME*size and name.startswith(("force", "eccentricity"))) for name, value in one.items())


def changes(file, chance, values, known):
    """(dataset, entry or all of it, value) of a file's numbers; those that are known become too large alone."""
    names = []
    with h5py.File(file, "r") as stored:
        stored.visititems(lambda name, item: names.append((name, item.size))
                          if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not name.startswith("provenance/") else None)
    for name, size in names:
        for value in values[1:2] if name in known else values:
            yield name, None, value
        if size > 1 and name not in known:
            for turn, entry in enumerate(sorted(chance.sample(range(size), min(SINGLE, size)))):
                yield name, entry, values[turn % len(values)]


def check_kind(checks, folder, kind, content, values, known):
    """All changes of a run's restart file; adds its datasets to those that are known."""
    chance = random.Random(SEED)
    path, place = write_case(folder, kind, merged(content, **EVERY)), folder/kind
    checks.that(f"{kind}: a restart file is left", stopped(path, place))
    file = place/f"{kind}.restart.h5"
    whole = file.read_bytes()
    done = resumed(path, place)
    checks.that(f"{kind}: the file as it was: status {done.returncode}: {done.stderr.strip()[-200:]}", done.returncode == 0)
    if done.returncode != 0:
        return
    right, refused, unchanged, lost, wrong = answer_of(path, place), 0, 0, 0, []
    file.write_bytes(whole)
    wanted = list(changes(file, chance, values, known))
    for name, entry, value in wanted:
        for old in place.iterdir():
            old.unlink()
        file.write_bytes(whole)
        with h5py.File(file, "r+") as stored:
            if entry is None:
                stored[name][...] = value
            else:
                flat = stored[name][...].reshape(-1)
                flat[entry] = value
                stored[name][...] = flat.reshape(stored[name].shape)
        seal(file)
        done = resumed(path, place)
        crash = [word for word in faults.CRASH if word in done.stderr + done.stdout]
        told = done.stderr.count("\n") == 1 and file.name in done.stderr
        if done.returncode in (1, 3) and told and not crash:
            refused += 1
        elif done.returncode == 0 and not crash and same(right, answer_of(path, place)):
            unchanged += 1
        elif done.returncode == 2 and not crash:
            lost += 1
        else:
            wrong.append(f"{name}[{'all' if entry is None else entry}] = {value}: status {done.returncode}: {done.stderr.strip()[-150:]}")
    checks.that(f"{kind}: {refused} refused with a sentence, {unchanged} with the right answer all the same, {lost} without one, wrong: {wrong}",
                refused > lost and not wrong)
    known |= {name for name, _, _ in wanted}
    shutil.rmtree(place)


def check_steps(checks, folder):
    """A step that the run does not have, and a file for a run that writes none."""
    path, place = write_case(folder, "steps", merged(FEW["sweep"], **EVERY)), folder/"steps"
    stopped(path, place)
    file = place/"steps.restart.h5"
    for step in (0.0, -1.0, 31.0, 2.5, 1.0e10, numpy.nan):
        with h5py.File(file, "r+") as stored:
            stored["step/number"][()] = step
        seal(file)
        done = resumed(path, place)
        checks.that(f"step {step}: {done.stderr.strip()}", done.returncode == 3 and "/step/number" in done.stderr)


def main():
    checks, long, known = Checks(), "--long" in sys.argv, set()
    with tempfile.TemporaryDirectory() as name:
        for kind, content in (MORE if long else FEW).items():
            check_kind(checks, pathlib.Path(name), kind, content, VALUES[:2] if long else VALUES, known)
        if not long:
            check_steps(checks, pathlib.Path(name))
    checks.close()


if __name__ == "__main__":
    main()
