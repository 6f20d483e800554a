#!/usr/bin/env python3
"""Signals and the time limit: a run ends where it can, keeps what it has reached, says so, and is resumed."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import GFB, MPIEXEC, Bearing, Checks, case_text, read_summary  # noqa: E402

SECONDS = 900  # nothing here takes that long
BEARING = Bearing()
POINTS = 1000
SWEEP = case_text(BEARING, mesh=(96, 16), number=2.0, load=(-20.0, 0.0), groups={
    "sweep": {"parameter": "load", "values": tuple(10.0 + i % 30 for i in range(POINTS))}})
SHORT = case_text(BEARING, mesh=(96, 16), number=2.0, load=(-20.0, 0.0), groups={
    "sweep": {"parameter": "load", "values": tuple(10.0 + i % 30 for i in range(24))}})
ONE = case_text(BEARING, mesh=(512, 160), number=2.0, load=(-20.0, 0.0))
# Meshes and load steps that take long beside the way of a signal.
ACCURATE = case_text(BEARING, mesh=(96, 16), number=2.0, load=(-20.0, 0.0), groups={
    "accuracy": {"quantity": "minimum_gap", "target": 1.0e-9, "maximum_refinements": 6}})
STRIP = """&scene analysis='strip' /
&bump_foil thickness=1.02e-4 youngs_modulus=2.14e11 poissons_ratio=0.29 half_length=1.778e-3 height=5.08e-4 pitch=4.572e-3 bumps=3
  width=0.0381 fixed_edge='leading' fixed_line='corner' /
&contact friction_sleeve=0.1 friction_top=0.0 /
&strip_load kind='crest_pressure' distribution='uniform' pressure=0.2e6 steps_up=500 /
&mesh arc_elements=8 flat_elements=2 axial_elements=8 /
"""
HANG = case_text(BEARING, mesh=(24, 4), number=2.0, load=(-20.0, 0.0))
STATUS = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129, signal.SIGXCPU: 152, signal.SIGUSR1: 138}


def begin(folder, case, *options, ranks=1):
    """A run whose lines can be read as they come."""
    command = [GFB, *options, case]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    return subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, encoding="utf-8")


def wait_for(process, words):
    """Reads the log up to a line."""
    for line in process.stdout:
        if line.startswith(words):
            return True
    return False


def stopped(folder, number, ranks=1):
    """Status, log and complaints of a sweep that is sent a signal after some points."""
    with begin(folder, "sweep.nml", ranks=ranks) as process:
        wait_for(process, "point 5 of")
        process.send_signal(number)
        log, complaint = process.communicate(timeout=SECONDS)
    return process.returncode, log, complaint


def rows(path):
    """Points of a history, by h5dump's own reader."""
    import h5py
    with h5py.File(path, "r") as file:
        return len(file["history/force_x"])


def check_sweep(checks, folder):
    """Every signal ends a sweep with a restart file, the points it has, a sentence and its status."""
    (folder/"sweep.nml").write_text(SWEEP, encoding="utf-8")
    for number, status in STATUS.items():
        name = signal.Signals(number).name
        found, log, complaint = stopped(folder, number)
        checks.that(f"{name}: status {found}", found == status)
        checks.that(f"{name}: says so", f"stopped by {name} after point" in log and "--restart resumes from" in log)
        checks.that(f"{name}: nothing else {complaint.strip()}", not complaint)
        checks.that(f"{name}: a restart file", (folder/"sweep.restart.h5").exists())
        kept = rows(folder/"sweep.unconverged.h5")
        checks.that(f"{name}: the {kept} points reached", kept >= 5 and f"after point {kept} of {POINTS}" in log)
        checks.that(f"{name}: no answer is claimed", not (folder/"sweep.h5").exists())
        for path in folder.glob("sweep.*.*"):
            path.unlink()
    found, log, _ = stopped(folder, signal.SIGUSR1, ranks=2)
    checks.that(f"2 ranks, SIGUSR1: status {found}", found == STATUS[signal.SIGUSR1])
    checks.that("2 ranks, SIGUSR1: said once", log.count("stopped by SIGUSR1 after point") == 1)
    checks.that("2 ranks, SIGUSR1: a restart file", (folder/"sweep.restart.h5").exists())


def check_resumed(checks, folder):
    """A sweep that is stopped again and again has the answers of one that is not."""
    (folder/"whole").mkdir()
    (folder/"short.nml").write_text(SHORT, encoding="utf-8")
    whole = subprocess.run([GFB, "--output", "whole", "short.nml"], cwd=folder, capture_output=True,
                           check=False, timeout=SECONDS)
    resumed = 0
    for number in (4, 9):
        with begin(folder, "short.nml", "--restart") as process:
            wait_for(process, f"point {number} of")
            process.send_signal(signal.SIGTERM)
            log, _ = process.communicate(timeout=SECONDS)
        resumed += process.returncode == 143 and "stopped by SIGTERM" in log
    with begin(folder, "short.nml", "--restart") as process:
        log, _ = process.communicate(timeout=SECONDS)
    checks.that("stopped twice, resumed twice", resumed == 2 and process.returncode == 0 and "restart: resumed" in log)
    one, other = (read_summary(folder/place/"short.summary")[0] for place in ("whole", "."))
    worst = max(abs(one[name] - other[name])/abs(one[name]) for name in ("eccentricity_x", "eccentricity_y", "minimum_gap",
                                                                        "friction_torque"))
    checks.that("the whole run", whole.returncode == 0)
    checks.below("the same answer", worst, 1.0e-8)
    checks.that("no restart file is left", not (folder/"short.restart.h5").exists())
    checks.that("all points", rows(folder/"short.h5") == 24)


def check_outcomes(checks, folder):
    """The files of a run without an answer say how it ended, in every analysis that can be stopped, and by which program."""
    program = subprocess.run([GFB, "--version"], capture_output=True, text=True, check=True).stdout.partition(",")[0]
    loop = dict(mesh=(48, 8), number=2.0, load=(-20.0, 0.0))
    cases = {
        "sweep": (None, "point 3 of"),
        "time": (case_text(BEARING, **loop, groups={"scene": {"analysis": "transient"}, "rotor": {"mass": 1.0}, "transient": {"turns": 5000.0}}), "time"),
        "orbit": (case_text(BEARING, **loop, groups={"scene": {"analysis": "periodic"}, "rotor": {"mass": 0.5}, "unbalance": {"unbalance": 1.0e-6},
                                                     "periodic": {"motion": "forced", "parameter": "speed_rpm", "final_value": 40000.0, "points": 400}}), "orbits"),
        "members": (case_text(BEARING, **loop, groups={"sample": {"count": 200, "parameters": "bearing%clearance", "factors": 1.001}}), "seed 3"),
        "meshes": (ACCURATE, "mesh 1"),
        "strip": (STRIP, "      3 ")}
    for name, (text, words) in cases.items():
        if text:
            (folder/f"{name}.nml").write_text(text, encoding="utf-8")
        with begin(folder, f"{name}.nml") as process:
            wait_for(process, words)
            process.send_signal(signal.SIGINT)
            log, complaint = process.communicate(timeout=SECONDS)
        found = read_summary(folder/f"{name}.unconverged.summary")[0] if (folder/f"{name}.unconverged.summary").exists() else {}
        checks.that(f"{name}: status {process.returncode} {complaint}{log[-300:]}", process.returncode == 130)
        checks.that(f"{name}: {found.get('outcome')}, {found.get('reason')}", found.get("outcome") == "stopped"
                    and str(found.get("reason")).startswith("stopped by SIGINT"))
        checks.that(f"{name}: {found.get('program')}", found.get("program") == program)
    for name, changes, outcome in (("touches", {"load": (-1.0e6, 0.0)}, "refused"),
                                   ("bounded", {"groups": {"solver": {"maximum_factorizations": 1}}}, "gave_up")):
        (folder/f"{name}.nml").write_text(case_text(BEARING, **{**loop, **changes}), encoding="utf-8")
        done = subprocess.run([GFB, f"{name}.nml"], cwd=folder, capture_output=True, encoding="utf-8", check=False, timeout=SECONDS)
        found = read_summary(folder/f"{name}.unconverged.summary")[0]
        checks.that(f"{name}: status {done.returncode}, {found.get('outcome')}: {found.get('reason')}", done.returncode == 2
                    and found["outcome"] == outcome and str(found["reason"]) in done.stdout.replace("\n", " "))
    (folder/"other.nml").write_text(SHORT, encoding="utf-8")
    log = folder/"batch/sweep.log"
    with begin(folder, "other.nml", "--groups", "1", "--output", "batch", "sweep.nml") as process:
        while process.poll() is None and not (log.exists() and "point 3 of" in log.read_text(encoding="utf-8")):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=SECONDS)
    table = read_summary(folder/"batch/ensemble.summary")[0]
    found = read_summary(folder/"batch/sweep.unconverged.summary")[0]
    checks.that(f"several cases: status {process.returncode}, {table}", process.returncode == 130 and found["outcome"] == "stopped"
                and table["member_1"].startswith("sweep: stopped (stopped by SIGINT") and table["member_2"] == "other: stopped (not computed, stopped by SIGINT)")
    with begin(folder, "sweep.nml", "--time-limit=1") as process:
        process.communicate(timeout=SECONDS)
    found = read_summary(folder/"sweep.unconverged.summary")[0]
    checks.that(f"time limit: {found['outcome']}", found["outcome"] == "out_of_time" and found["program"] == program)


def check_first_answer(checks, folder):
    """A run without a sweep ends between two iterations; a second signal ends it at once."""
    (folder/"one.nml").write_text(ONE, encoding="utf-8")
    with subprocess.Popen([GFB, "--verbose", "one.nml"], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, encoding="utf-8") as process:
        wait_for(process, "    iteration")
        process.send_signal(signal.SIGTERM)
        begun = time.monotonic()
        log, complaint = process.communicate(timeout=SECONDS)
    seconds = time.monotonic() - begun
    checks.that(f"one answer: status {process.returncode} {seconds:.1f} s later", process.returncode == 143)
    checks.that(f"one answer: says so {complaint}", "stopped by SIGTERM" in log and not complaint)
    with begin(folder, "sweep.nml") as process:
        wait_for(process, "point 2 of")
        os.kill(process.pid, signal.SIGSTOP)
        for number in (signal.SIGINT, signal.SIGCONT):
            os.kill(process.pid, number)
        process.communicate(timeout=SECONDS)
    checks.that("stopped and continued: the first signal counts", process.returncode == 130)
    with subprocess.Popen([GFB, "--verbose", "one.nml"], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, encoding="utf-8") as process:
        wait_for(process, "    iteration")
        for _ in range(2):
            process.send_signal(signal.SIGTERM)
        process.communicate(timeout=SECONDS)
    checks.that("a second signal: the end", process.returncode in (143, -signal.SIGTERM))


def check_quiet_end(checks, folder):
    """Nobody reads on: no word of MPI's."""
    done = subprocess.run(f"{GFB} sweep.nml | head -n 3", shell=True, cwd=folder, capture_output=True, encoding="utf-8",
                          check=False, timeout=SECONDS)
    checks.that(f"gfb | head: quiet {done.stderr[:200]}", done.returncode == 0 and not done.stderr)


def check_time_limit(checks, folder):
    """A limit does what a signal does, with a status of its own."""
    with begin(folder, "sweep.nml", "--time-limit=0:01") as process:  # before its first answer, where the machine is slow
        log, _ = process.communicate(timeout=SECONDS)
    checks.that(f"--time-limit=0:01: status {process.returncode}", process.returncode == 124 and "stopped by the time limit" in log)
    for limit in (1, 4, 16, 64, 256):
        with begin(folder, "sweep.nml", f"--time-limit={limit}") as process:
            begun = wait_for(process, "point 2 of")
            os.kill(process.pid, signal.SIGSTOP)  # so that the sweep does not end before its limit
            time.sleep(limit if begun else 0)
            os.kill(process.pid, signal.SIGCONT)
            log, _ = process.communicate(timeout=SECONDS)
        if begun:
            break
    checks.that(f"--time-limit={limit}: status {process.returncode}", process.returncode == 124)
    checks.that(f"--time-limit={limit}: says so", "stopped by the time limit after point" in log)
    for wrong in ("x", "0", "1:", "-3", ""):
        done = subprocess.run([GFB, "--time-limit", wrong, "sweep.nml"], cwd=folder, capture_output=True,
                              encoding="utf-8", check=False, timeout=SECONDS)
        checks.that(f"--time-limit '{wrong}' is refused", done.returncode == 1 and "--time-limit" in done.stderr)


def begin_hanging(folder):
    """A run whose library does not come back from its first factors, and that has been asked to end; None without a compiler."""
    (folder/"hang.c").write_text("#include <fcntl.h>\n#include <unistd.h>\nvoid *klu_analyze(void) {\n  creat(\"hangs\", 0600);\n"
                                 "  for (;;) pause();\n}\n", encoding="utf-8")
    made = subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-o", "hang.so", "hang.c"], cwd=folder, check=False)
    if made.returncode != 0:
        return None
    (folder/"hang.nml").write_text(HANG, encoding="utf-8")
    process = subprocess.Popen([GFB, "hang.nml"], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, encoding="utf-8",
                               env={**os.environ, "LD_PRELOAD": str(folder/"hang.so")})
    while not (folder/"hangs").exists() and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    return process


def check_hanging(checks, process, folder):
    """One signal is enough where a library hangs; a clock waits for it meanwhile, beside the other checks."""
    try:
        _, complaint = process.communicate(timeout=SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        complaint = "it hangs on"
    checks.that(f"a library that hangs: status {process.returncode}", process.returncode == 143)
    checks.that(f"a library that hangs: {complaint.strip()}", "does not come to an end" in complaint)
    checks.that("a library that hangs: no results", not list(folder.glob("hang*.summary")))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        hanging = begin_hanging(folder)
        for check in (check_sweep, check_resumed, check_outcomes, check_first_answer, check_quiet_end, check_time_limit):
            check(checks, folder)
        if hanging:
            check_hanging(checks, hanging, folder)
    checks.close()


if __name__ == "__main__":
    main()
