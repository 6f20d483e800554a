#!/usr/bin/env python3
"""Sweeps over keys of the case file: each point is the answer of its own scene, branches are followed or said to end."""

import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import numpy

from capacity import BEAMS, case
from gfb_run import GFB, SECONDS, Bearing, Checks, case_groups, largest_difference, run_file, solve, write_case

LIMIT = 1.0e-8  # runs and starts agree so far
SHEET = {"thickness": 1.0e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
CLEARANCE = 2.5e-5
# A small bearing with several equilibria: over the clearance its branches are four times apart in film.
ENGINEER = {
    "scene": {"analysis": "equilibrium"},
    "bearing": {"radius": 0.015, "length": 0.03, "clearance": CLEARANCE},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101350.0},
    "operation": {"speed_rpm": 80000.0, "load": (0.0, -20.0)},
    "top_foil": SHEET,
    "bump_foil": SHEET | {"half_length": 1.4e-3, "height": 4.5e-4, "bumps": 26},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
    "model": {"foil": "beam"},
    "mesh": {"circumferential_elements": 104, "axial_elements": 4, "arc_elements": 4, "flat_elements": 2},
    "output": {"fields": "none"},
}
FRICTIONS = "contact%friction_top, contact%friction_sleeve"
RIGID = Bearing()
SPRINGS = {"foundation_stiffness": 2.0*RIGID.ambient_pressure/RIGID.clearance}
STIFFNESSES = tuple(factor*SPRINGS["foundation_stiffness"] for factor in (1.0, 1.5, 3.0))


def with_keys(content, changes):
    """A case with other values of some keys."""
    return {group: {**content.get(group, {}), **changes.get(group, {})} for group in {**content, **changes}}


def sweep_of(parameter, values, **keys):
    """The group &sweep."""
    return {"sweep": {"parameter": parameter, "values": values, **keys}}


def swept(folder, name, content, parameter, values):
    """Log and history of a sweep."""
    answer = solve(folder, name, with_keys(content, sweep_of(parameter, values)))
    return answer.log, answer.history()


def check_alone(checks, folder, words, content, parameter, values):
    """Where there is one equilibrium, a point is the answer of the scene with its value in the file."""
    _, history = swept(folder, "swept", content, parameter, values)
    checks.below(f"{words}: the history has the values", largest_difference(history["key_value"], values), 0.0)
    group, key = parameter.split("%")
    for point, value in enumerate(values):
        alone = solve(folder, "alone", with_keys(content, {group: {key: value}}))
        worst = max(abs(history[name][point]/alone.summary[name] - 1.0)
                    for name in ("minimum_gap", "eccentricity_x", "friction_torque"))
        checks.below(f"{words} {value:.3g}: the answer of that scene", worst, LIMIT)
    checks.that(f"{words}: no point was started anew", not history["started_anew"].any())


def check_list(checks, folder, content):
    """A sweep over one value of a list."""
    shims = {"shim_angle": (1.0, 3.0), "shim_arc": 0.6, "shim_ramp": 0.1}
    heights = (4.0e-6, 6.0e-6)
    log, history = swept(folder, "swept", with_keys(content, {"bore": {**shims, "shim_height": (2.0e-6, 2.0e-6)}}), "bore%shim_height(2)",
                         heights)
    for point, height in enumerate(heights):
        alone = solve(folder, "alone", with_keys(content, {"bore": {**shims, "shim_height": (2.0e-6, height)}}))
        worst = max(abs(history[name][point]/alone.summary[name] - 1.0) for name in ("minimum_gap", "eccentricity_x"))
        checks.below(f"height of the second shim {height:.3g}: the answer of that scene", worst, LIMIT)


def largest_bend(history, name):
    """How far a history departs from straight lines through neighbours, over the clearance."""
    return float(numpy.abs(numpy.diff(history[name], 2)).max()/CLEARANCE)


def check_smooth(checks, folder, words, parameter, values):
    """Beams with several equilibria: the sweep stays on one branch."""
    log, history = swept(folder, "smooth", ENGINEER, parameter, values)
    checks.that(f"{words}: one branch, and no warning of another",
                not history["branch_changed"].any() and "another branch" not in log)
    checks.that(f"{words}: one sign of the determinant", len(set(history["determinant_sign"])) == 1)
    checks.that(f"{words}: no point was started anew", not history["started_anew"].any())
    checks.below(f"{words}: the film is smooth, over C", largest_bend(history, "minimum_gap"), 0.06)
    checks.below(f"{words}: the free edge is smooth, over C", largest_bend(history, "leading_edge_lift"), 0.1)
    checks.below(f"{words}: the force is the load", largest_difference(history["force_y"], [-20.0]*len(values)), LIMIT)
    return history


def check_end(checks, folder):
    """Over the clearance a branch ends at about 17.4 um; from there on, another one is followed, and comes back far."""
    log, down = swept(folder, "down", ENGINEER, "bearing%clearance", (2.0e-5, 1.5e-5))
    checks.that("clearance down: the branch ends before 15 um, and the log says where",
                "the path from the point before ends at bearing%clearance = 1.7" in log)
    checks.that("clearance down: 15 um is started anew, and on another branch",
                list(down["started_anew"]) == [0, 1] and list(down["branch_changed"]) == [0, 1] and "warning: another branch of equilibria" in log)
    _, up = swept(folder, "up", ENGINEER, "bearing%clearance", (1.5e-5, 2.0e-5))
    checks.below("clearance up: the other branch is the same", up["minimum_gap"][0]/down["minimum_gap"][1] - 1.0, LIMIT)
    checks.that("clearance up: it goes on beyond the end of the first one, with a quarter of its film",
                not up["branch_changed"].any() and up["minimum_gap"][1] < 0.25*down["minimum_gap"][0])


def check_lost(checks, folder):
    """A sweep of the load whose steps may not be short: the branch is lost on the way, and the point starts from nothing."""
    settings = {"solver": {"smallest_load_step": 0.9, "maximum_load_steps": 3}}
    both = solve(folder, "lost", case("equilibrium", load=10.0, **BEAMS, **settings, **sweep_of("load", (10.0, 150.0))))
    history = both.history()
    checks.that("lost: the second point starts from nothing", history["started_anew"][1] == 1 and "starts from nothing" in both.log)
    alone = solve(folder, "alone", case("equilibrium", load=150.0, **BEAMS, **settings))
    checks.below("lost: the answer of its own scene", history["minimum_gap"][1]/alone["minimum_gap"] - 1.0, LIMIT)


def killed_after(path, folder, words):
    """Kills a run as soon as its log has some words."""
    log = folder/"killed.log"
    with open(log, "w", encoding="utf-8") as out, \
            subprocess.Popen([GFB, "--output", str(folder), str(path)], stdout=out) as process:
        begun = time.monotonic()
        while words not in log.read_text(encoding="utf-8") and process.poll() is None:
            if time.monotonic() - begun > SECONDS:
                break
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)


def check_restart_and_groups(checks, folder):
    """A sweep that is killed goes on to the same digits; groups of ranks give the same numbers."""
    content = with_keys(ENGINEER, sweep_of("bump_foil%thickness", (8.0e-5, 9.0e-5, 1.0e-4, 1.1e-4))
                        | {"output": {"restart_every": 1}})
    path = write_case(folder, "pieces", content)
    whole = run_file(path, folder, options=()).history()
    resumed_folder = pathlib.Path(folder)/"resumed"
    resumed_folder.mkdir()
    killed_after(path, resumed_folder, "point 2 of 4")
    if (resumed_folder/"pieces.restart.h5").exists():
        resumed = run_file(path, resumed_folder, options=("--restart",)).history()
        checks.that("killed and resumed: the same digits", set(resumed) == set(whole) and all(
            numpy.array_equal(resumed[name], whole[name], equal_nan=True) for name in whole))
    else:
        checks.that("killed and resumed: the run had ended", (resumed_folder/"pieces.h5").exists())
    shutil.rmtree(resumed_folder)
    divided = run_file(path, folder, ranks=2, options=("--groups", "2")).history()
    for name in ("key_value", "minimum_gap", "leading_edge_lift", "branch_changed", "started_anew"):
        checks.below(f"two groups of ranks: {name}", largest_difference(divided[name], whole[name]), LIMIT)


def main():
    """All checks."""
    checks = Checks()
    with tempfile.TemporaryDirectory() as words:
        folder = pathlib.Path(words)
        force = RIGID.force_unit
        rigid = case_groups(RIGID, mesh=(48, 8), load=(-0.4*force, 0.1*force), number=3.0)
        springs = case_groups(RIGID, mesh=(48, 8), load=(-0.4*force, 0.1*force), number=3.0, foil="elastic_foundation",
                              groups={"model": SPRINGS})
        check_alone(checks, folder, "rigid, clearance", rigid, "bearing%clearance", (2.0e-5, 2.5e-5, 1.5e-5))
        check_alone(checks, folder, "rigid, length", rigid, "bearing%length", (0.04, 0.05))
        check_list(checks, folder, rigid)
        check_alone(checks, folder, "springs, stiffness", springs, "model%foundation_stiffness", STIFFNESSES)
        check_alone(checks, folder, "springs, viscosity", springs, "gas%viscosity", (2.0e-5, 3.0e-5))
        check_smooth(checks, folder, "thickness of the bumps", "bump_foil%thickness",
                     (8.0e-5, 9.0e-5, 1.0e-4, 1.1e-4, 1.2e-4, 1.35e-4, 1.5e-4))
        check_smooth(checks, folder, "both frictions", FRICTIONS, (0.0, 0.1, 0.2, 0.3))
        check_smooth(checks, folder, "pitch, with more stations", "bump_foil%pitch", (3.6e-3, 3.58e-3, 3.56e-3))
        check_end(checks, folder)
        check_lost(checks, folder)
        check_restart_and_groups(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
