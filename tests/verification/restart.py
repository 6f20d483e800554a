#!/usr/bin/env python3
"""Runs that are killed at random moments and go on from their restart files: the same digits, on one rank and on two;
files that are refused."""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

from contact_strips import COARSE, FORCE, PAIR
from gfb_run import COST, GFB, MPIEXEC, SECONDS, Checks, Result, largest_difference, read_summary, \
    run_file, seal, write_case
from shell_bearing import BEARING, BUMPS, SHEET, SIZES, SPEED
from thrust import SPRINGS, thrust

SEED = 20201
KILLS = 3
PARTS = tuple(f"{part}{kind}" for part in ("film", "top_foil", "bump_foil") for kind in ("", ".steps"))
FRICTION = {"friction_top": 0.1, "friction_sleeve": 0.1, "normal_stiffness": 5.0e10, "stick_length": 1.0e-7}
MESH = {"circumferential_elements": 104, "axial_elements": 4}
FOIL_MESH = {"arc_elements": 4, "flat_elements": 2}
RESUMED = "restart: resumed from"
RANKS = 1.0e-8              # runs on other numbers of ranks agree so far


def bearing(foil, sweep, every=1, **groups):
    """A bearing of [Gu2020]'s geometry with a sweep."""
    content = {
        "scene": {"analysis": "equilibrium"},
        "bearing": {"radius": BEARING.radius, "length": BEARING.length, "clearance": BEARING.clearance},
        "gas": {"viscosity": BEARING.viscosity, "ambient_pressure": BEARING.ambient_pressure},
        "operation": {"speed_rpm": SPEED, "load": (-100.0, 0.0)},
        "model": {"foil": foil},
        "mesh": dict(MESH),
        "sweep": sweep,
        "output": {"restart_every": every},
    }
    if foil in ("beam", "shell"):
        content |= {"top_foil": {**SHEET, "fixed_edge": "trailing"}, "bump_foil": {**SHEET, **BUMPS},
                    "contact": dict(FRICTION), "mesh": MESH | FOIL_MESH}
    for group, keys in groups.items():
        content.setdefault(group, {}).update(keys)
    return content


def vibrating():
    """A rotor over the speed, beyond its onset."""
    speeds = {"parameter": "speed_rpm", "values": (11000.0, 12000.0, 14000.0, 15000.0, 16000.0, 17000.0)}
    return bearing("elastic_foundation", speeds, scene={"analysis": "linear_dynamics"}, operation={"load": (-19.62, 0.0)},
                   bump_foil={**SHEET, **BUMPS}, mesh={"axial_elements": 12}, rotor={"mass": 2.0},
                   dynamics={"frequency_ratios": (0.5, 1.0), "foundation_damping": 3.0e5})


def shaft_in_time(turns=4.0, rotor=None, foils=None, **drive):
    """A shaft with an unbalance on beams, four turns of it."""
    content = bearing("beam", {}, every=15, scene={"analysis": "transient"}, rotor={"mass": 4.0} | (rotor or {}),
                      mesh={"circumferential_elements": 208},
                      transient={"turns": turns, "steps_per_turn": 60, "unbalance": 4.0e-6, **drive},
                      top_foil=foils or {}, bump_foil=foils or {})
    return {group: keys for group, keys in content.items() if group != "sweep"}


def strip(kind, every=1):
    """A strip up and down, its crests under forces or between plates."""
    load = {"kind": kind, "steps_up": 8, "steps_down": 8}
    load |= {"maximum_force": FORCE*PAIR["bumps"]} if kind == "plates" else {"pressure": 1.0e5}
    return {"scene": {"analysis": "strip"}, "bump_foil": dict(PAIR), "strip_load": load, "mesh": dict(COARSE),
            "contact": {"friction_top": 0.2, "friction_sleeve": 0.2}, "output": {"restart_every": every}}


def ranks_of(process, ranks):
    """Processes of a run that has not ended: itself, or those that mpiexec has started."""
    if process.poll() is not None:
        return []
    if ranks == 1:
        return [process.pid]
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
    return [int(word) for word in children.read_text(encoding="utf-8").split()]


def is_step(line):
    """Whether a line of the log says that a step is done."""
    words = line.split()
    return line.startswith(("point ", "on the branch: ", "fold: ")) or (len(words) == 11 and words[0].isdigit())


def command_of(path, folder, ranks, restart):
    """Command line of a run."""
    command = [GFB, "--output", str(folder), *(["--restart"] if restart else []), str(path)]
    return command if ranks == 1 else [MPIEXEC, "-n", str(ranks), *command]


def read_answer(path, folder):
    """What a run left behind."""
    stem = pathlib.Path(folder)/pathlib.Path(path).stem
    return Result(0, "", "", stem, *read_summary(f"{stem}.summary"))


def run_whole(path, folder, ranks):
    """A run that nothing stops; its answer, and the shortest time between two steps [s]."""
    moments = []
    with subprocess.Popen(command_of(path, folder, ranks, False), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          encoding="utf-8") as process:
        for line in process.stdout:
            if is_step(line):
                moments.append(time.monotonic())
        process.wait(SECONDS)
    if process.returncode != 0:
        sys.exit(f"{path}: status {process.returncode}")
    return read_answer(path, folder), len(moments), min(numpy.diff(moments))


def run_time(path, folder):
    """The same of a shaft over time, whose log has no line a step."""
    begun = time.monotonic()
    answer = run_file(path, folder)
    return answer, int(answer["time_steps"]), (time.monotonic() - begun)/answer["time_steps"]


def run_and_kill(path, folder, ranks, files, delay, restart):
    """Kills a run when it has written so many restart files and a while has passed. Returns the files, less where it
    ended before, and whether it went on from a file."""
    file = pathlib.Path(folder)/f"{path.stem}.restart.h5"
    log = path.with_suffix(".log")
    with log.open("w", encoding="utf-8") as output:
        before, written, begun = changed(file), 0, time.monotonic()
        with subprocess.Popen(command_of(path, folder, ranks, restart), stdin=subprocess.DEVNULL, stdout=output,
                              stderr=subprocess.DEVNULL) as process:
            while (written < files or len(ranks_of(process, ranks)) < ranks) and process.poll() is None \
                    and time.monotonic() < begun + SECONDS:
                time.sleep(0.001)
                now = changed(file)
                written += now not in (before, None)
                before = now
            time.sleep(delay)
            for rank in ranks_of(process, ranks):
                os.kill(rank, signal.SIGKILL)
            process.wait(SECONDS)
    if process.returncode == 0:
        written = -1
    return written, RESUMED in log.read_text(encoding="utf-8")


def changed(file):
    """When a file was written, None where there is none."""
    try:
        return file.stat().st_mtime_ns
    except FileNotFoundError:
        return None


def datasets(path):
    """Numbers of an HDF5 file by their paths, without those of the cost."""
    found = {}

    def keep(name, item):
        """Takes a dataset of numbers."""
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu" and not name.startswith("provenance") \
                and not name.endswith("/rank") \
                and name.rsplit("/", 1)[-1] not in ("wall_time", "peak_memory"):
            found[name] = item[...]

    with h5py.File(path, "r") as file:
        file.visititems(keep)
    return found


def difference(one, other, cost=True):
    """Largest difference of two runs' files, relative or over the natural sizes, and where; infinite where names or
    sizes differ. What the answer cost is part of it where both ran alike."""
    worst = (0.0, "all")
    for ending in ("h5", *(f"{part}.vtkhdf" for part in PARTS)):
        files = [pathlib.Path(f"{answer.stem}.{ending}") for answer in (one, other)]
        if not any(file.exists() for file in files):
            continue
        first, second = (datasets(file) for file in files)
        if set(first) != set(second):
            return numpy.inf, f"{ending}: {set(first) ^ set(second)}"
        for path, values in first.items():
            name = path.rsplit("/", 1)[-1]
            if cost or name not in COST:
                both = [numpy.nan_to_num(found) for found in (values, second[path])]
                worst = max(worst, (largest_difference(*both, size=SIZES.get(name)), f"{ending}: {path}"))
    lines = [[line for line in pathlib.Path(f"{answer.stem}.summary").read_text(encoding="utf-8").splitlines()
              if not line.startswith(("wall_time", "peak_memory"))] for answer in (one, other)]
    if worst[0] == 0.0 and lines[0] != lines[1]:
        return numpy.inf, "summary"
    return worst


def kill_for_sure(path, folder, ranks, files, delay, restart):
    """The same, tried again with fewer files where the machine was so busy that the run ended before."""
    file = pathlib.Path(folder)/f"{path.stem}.restart.h5"
    kept = file.read_bytes() if file.exists() else None
    while True:
        done, went_on = run_and_kill(path, folder, ranks, files, delay, restart)
        if done >= 0:
            return done, went_on
        if files == 0:
            sys.exit(f"{path}: a run ended before it could be killed")
        print("       the run ended before it could be killed, again", flush=True)
        files -= 1
        if kept:
            file.write_bytes(kept)


def check_kills(checks, folder, name, content, chance, ranks=(1, 1, 1, 1), whole=None):
    """A run that is killed three times, on so many ranks each time, against one that nothing stops; returns that.

    On one rank all digits are the same. Sums over several ranks come in any order: there no run repeats itself to the
    last digit.
    """
    path = write_case(folder, name, content)
    if whole is None:
        whole = run_whole(path, pathlib.Path(folder)/"whole", 1)
    answer, steps, shortest = whole
    alike = set(ranks) == {1}
    place = pathlib.Path(folder)/"killed"
    shutil.rmtree(place, ignore_errors=True)
    files = steps//content["output"]["restart_every"]
    for kill in range(KILLS):
        there = (place/f"{name}.restart.h5").exists()
        wanted = chance.randint(min(kill, 1), max(min(kill, 1), files - 1 - (KILLS - kill)))
        done, went_on = kill_for_sure(path, place, ranks[kill], wanted, chance.uniform(0.0, shortest), kill > 0)
        checks.that(f"{name}: run {kill + 1}, {ranks[kill]} rank(s), {'goes on' if there else 'begins'} and is killed "
                    f"{done} restart files later", went_on == there or not done)
        files -= done
    file = place/f"{name}.restart.h5"
    there = file.exists()
    (place/".gfb-file-1-0").write_bytes(b"a file that a killed run had begun")
    killed = run_file(path, place, ranks=ranks[KILLS], options=["--restart"])
    off, where = difference(answer, killed, cost=alike)
    checks.below(f"{name}: numbers of the last run, {ranks[KILLS]} rank(s), and of one that nothing stopped ({where})",
                 off, 0.0 if alike else RANKS)
    checks.that(f"{name}: the last run goes on", there and RESUMED in killed.log)
    left_over = [file.name for file in place.iterdir() if "restart" in file.name or file.name.startswith(".gfb")]
    checks.that(f"{name}: no restart file is left {left_over}", not left_over)
    return whole


def check_march(checks, folder, content):
    """A run over time that is killed on one rank, and on changing numbers of them, against one that nothing stops."""
    chance = random.Random(SEED)
    whole = run_time(write_case(folder, "stopped", content), pathlib.Path(folder)/"whole")
    for ranks in ((1, 1, 1, 1), (2, 1, 2, 1)):
        check_kills(checks, folder, "stopped", content, chance, ranks, whole)


def check_refusals(checks, folder, content):
    """A file of another scene or program, or a damaged one, is refused with a sentence, and stays as it is."""
    path = write_case(folder, "refused", content)
    place = pathlib.Path(folder)/"refused"
    file = place/"refused.restart.h5"
    none = run_file(path, place, options=["--restart"])
    checks.that("without a file the run says so and starts from the beginning",
                "there is no" in none.log and "starts from the beginning" in none.log and RESUMED not in none.log)
    kill_for_sure(path, place, 1, 2, 0.0, False)
    kept = file.read_bytes()

    def refused(words, status, *sentences):
        """The present file does not serve."""
        before = file.read_bytes()
        answer = run_file(path, place, options=["--restart"], status=status)
        checks.that(f"{words}: {answer.complaint.strip()}", all(one in answer.complaint for one in sentences))
        checks.that(f"{words}: the file stays as it is", file.read_bytes() == before)

    for group, key, value, line in (("operation", "speed_rpm", SPEED + 1.0, "speed_rpm = "),
                                    ("sweep", "values", (60.0, 80.0, 90.0), "values = "),
                                    ("mesh", "axial_elements", 6, "axial_elements = "),
                                    ("solver", "step_tolerance", 1.0e-7, "step_tolerance = ")):
        other = {name: dict(keys) for name, keys in content.items()}
        other.setdefault(group, {})[key] = value
        write_case(folder, "refused", other)
        refused(f"another {key}", 1, "belongs to another scene", f"&{group}: {line}", "there", "here",
                "run without --restart")
    write_case(folder, "refused", content)
    for name in ("program_version", "commit"):
        with h5py.File(file, "r+") as stored:
            data = stored[f"provenance/{name}"]
            data[()] = b"0"*data.dtype.itemsize
        seal(file)
        refused(f"another {name}", 1, "was written by gfb", "000", "this is gfb", "run without --restart")
        file.write_bytes(kept)
    with h5py.File(file, "r+") as stored:
        del stored["bearing/state"]
    seal(file)
    refused("a field is missing", 3, "the file is damaged: /bearing/state cannot be read")
    file.write_bytes(kept)
    with h5py.File(file, "r+") as stored:
        data = stored["bearing/words"]
        data[()] = data[()].replace(b"edge_height", b"edge_length")
    seal(file)
    refused("a component has another name", 3, "the file is damaged at /bearing: 'edge_height real 24' is missing, "
            "there is 'edge_length real 24'")
    with h5py.File(file, "r") as stored:
        right = float(stored["format"][()])
    for wrong in (None, right - 1.0, right + 1.0):
        file.write_bytes(kept)
        with h5py.File(file, "r+") as stored:
            del stored["format"]
            if wrong:
                stored["format"] = wrong
        seal(file)
        refused(f"a file of the kind {wrong}", 1, "was written by gfb", "this is gfb", "whose restart files are of another kind",
                "run without --restart")
    file.write_bytes(kept[:len(kept)//2])
    refused("half a file", 3, "cannot be read")
    file.write_bytes(kept)
    text = path.read_text(encoding="utf-8")
    path.write_text("! only a comment is new\n" + text, encoding="utf-8")
    answer = run_file(path, place, options=["--restart"])
    checks.that("a new comment in the case file changes nothing", RESUMED in answer.log)
    file.write_bytes(kept)
    answer = run_file(path, place, options=[])
    checks.that("without --restart a file that is there is named, and the run begins anew",
                "warning" in answer.log and file.name in answer.log and RESUMED not in answer.log)
    (file/"full").mkdir(parents=True)
    answer = run_file(path, place, options=[])
    checks.that("a restart file that cannot be written does not end the run",
                "restart.h5: the file cannot be put in its place" in answer.log
                and "the run continues without it" in answer.log)
    shutil.rmtree(file)


def check_all_foils(checks, folder, loads, tilts, chance):
    """Other foils and couplings, and what else a sweep may ask for."""
    whole = check_kills(checks, folder, "shells", bearing("shell", loads), chance)
    check_kills(checks, folder, "shells", bearing("shell", loads), chance, (2, 1, 2, 2), whole)
    check_kills(checks, folder, "beams_stability", bearing("beam", loads, solver={"stability": True}), chance)
    check_kills(checks, folder, "beams_held", bearing("beam", tilts), chance)
    check_kills(checks, folder, "beams_partitioned", bearing("beam", loads, model={"coupling": "partitioned"}), chance)
    check_kills(checks, folder, "rigid", bearing("rigid", {"parameter": "load", "values": (40.0, 60.0, 50.0, 30.0)},
                                                 mesh={"axial_elements": 20}), chance)
    moved = {"parameter": "eccentricity_x", "values": (1.0e-5, 1.2e-5, 1.5e-5, 1.8e-5, 2.0e-5)}
    tilting = shaft_in_time(2.0, {"transverse_inertia": 8.0e-3, "polar_inertia": 2.0e-3, "bearing_distance": 0.12},
                            couple_unbalance=1.0e-7)
    check_kills(checks, folder, "two_bearings", tilting, chance,
                whole=run_time(write_case(folder, "tilting", tilting), pathlib.Path(folder)/"whole"))
    check_kills(checks, folder, "beams_placed",
                bearing("beam", moved, scene={"analysis": "fixed_position"},
                        operation={"eccentricity": (1.0e-5, 5.0e-6)}), chance)
    pressed = {"parameter": "axial_load", "values": (60.0, 90.0, 120.0, 150.0, 120.0)}
    check_kills(checks, folder, "thrust", thrust({"axial_load": 60.0, "moment": (0.2, -0.1)}, "equilibrium", SPRINGS, sweep=pressed,
                                                 output={"restart_every": 1}), chance, (1, 2, 1, 1))
    speeds = {"parameter": "speed_rpm", "values": (60000.0, 50000.0, 40000.0, 30000.0, 25000.0)}
    check_kills(checks, folder, "foundation",
                bearing("elastic_foundation", speeds, operation={"load": (-50.0, 0.0)}, bump_foil={**SHEET, **BUMPS},
                        model={"foundation_pressure": "axial_mean"}, mesh={"axial_elements": 12}), chance)


def check_kinds(checks, folder, loads, tilts, chance):
    """Beams and strips, with and without memory of friction, and rotors."""
    whole = check_kills(checks, folder, "beams_memory", bearing("beam", loads), chance)
    check_kills(checks, folder, "beams_tilted", bearing("beam", tilts, every=2), chance)
    check_kills(checks, folder, "beams_folded",
                bearing("beam", {"parameter": "load", "values": (100.0, 60.0, 30.0), "turn_folds": True}), chance)
    check_kills(checks, folder, "rotor", vibrating(), chance)
    heavy = shaft_in_time(foils={"density": 8200.0}, foil_mass="on", output_every=25, steady_tolerance=3.0e-2)
    turning = run_time(write_case(folder, "turning", heavy), pathlib.Path(folder)/"whole")
    check_kills(checks, folder, "turning", heavy, chance, whole=turning)
    check_kills(checks, folder, "strip_pressed", strip("crest_pressure", every=3), chance)
    loop = check_kills(checks, folder, "strip_squeezed", strip("plates"), chance)
    check_kills(checks, folder, "beams_memory", bearing("beam", loads), chance, (2, 1, 2, 2), whole)
    check_kills(checks, folder, "strip_squeezed", strip("plates"), chance, (2, 2, 1, 2), loop)


def main():
    """The checks of every run, or with --long those of all other kinds of foils."""
    checks = Checks()
    chance = random.Random(SEED)
    loads = {"parameter": "load", "values": (60.0, 80.0, 100.0, 120.0, 100.0, 80.0)}
    tilts = {"parameter": "tilt_x", "values": (0.0, 1.0e-5, 2.0e-5, 3.0e-5, 2.0e-5, 1.0e-5), "hold_position": True}
    remembers = {"friction_memory": True}
    with tempfile.TemporaryDirectory() as folder:
        if "--long" in sys.argv:
            check_all_foils(checks, folder, loads | remembers, tilts, chance)
        else:
            check_refusals(checks, folder, bearing("beam", {**loads, "values": (60.0, 80.0, 100.0, 80.0)}))
            check_kinds(checks, folder, loads | remembers, tilts | remembers, chance)
    checks.close()


if __name__ == "__main__":
    main()
