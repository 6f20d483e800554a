#!/usr/bin/env python3
"""gfb as a user meets it: options, folders, exit status, reruns, and results that survive a kill."""

import concurrent.futures
import contextlib
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import (GFB, MPIEXEC, Bearing, Checks, case_text, natural_sizes, run, run_file,  # noqa: E402
                     summary_difference)

BEARING = Bearing()
ROOT = pathlib.Path(__file__).resolve().parents[2]
GOOD = case_text(BEARING, mesh=(48, 8), number=2.0, load=(-20.0, 0.0))
PLATE = """&scene analysis='modes' /
&modes part='top_foil' /
&bearing radius=0.02 length=0.04 /
&top_foil thickness=1e-4 youngs_modulus=2e11 poissons_ratio=0.3 density=8000.0 /
&mesh circumferential_elements=20 axial_elements=6 /
"""
LONG = """&scene analysis='transient' /
&bearing radius=19.05e-3 length=38.1e-3 clearance=31.8e-6 /
&gas viscosity=1.95e-5 ambient_pressure=1.0135e5 /
&operation speed_rpm=30000.0 load=-60.0, 0.0 /
&rotor mass=1.5 /
&transient duration=2.0 output_every=1000 /
&unbalance unbalance=1.5e-6 /
&foil_damping foundation_damping=3.0e5 /
&model foil='elastic_foundation' foundation_stiffness=4.8243e9 /
&mesh circumferential_elements=60 axial_elements=8 /
"""
SECONDS = 900  # nothing here takes that long


def call(*words, folder, ranks=1, environment=None):
    """Status, output and error stream."""
    command = [GFB, *map(str, words)]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS,
                          check=False, env={**os.environ, **(environment or {})})
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def check_options(checks, folder):
    """Options that compute nothing, and options that are none."""
    (folder/"good.nml").write_text(GOOD, encoding="utf-8")
    status, words, wrong = call("--help", folder=folder)
    checks.that("--help: status 0, nothing on the error stream", status == 0 and not wrong)
    checks.that("--help: names every option and the exit status", all(part in words for part in (
        "--check", "--output", "--quiet", "--verbose", "--csv", "--template", "--explain", "--groups", "--name", "--keys", "--results", "--strict", "--version", "--petsc-options-file FILE", "--petsc ",
        "exit status", "CASE.nml")))
    status, words, wrong = call("--version", folder=folder)
    checks.that("--version", status == 0 and words.startswith("gfb ") and "PETSc" in words and words.count("\n") == 1)
    status, words, wrong = call("--keys", folder=folder)
    checks.that("--keys: a table with each group", status == 0 and all(f"{group}" in words for group in (
        "bearing", "gas", "operation", "sweep", "bump_foil", "model", "mesh", "solver", "output")))
    checks.that("--keys: with units", "| m |" in words and "speed_rpm" in words)
    status, words, wrong = call("--keys", "good.nml", folder=folder)
    checks.that("--keys of a case: with why a key has no use in it", status == 0 and not wrong and all(
        re.search(rf"^\| `&{group}` \| `{key}` .* \| {why} ?\|$", words, re.M) for group, key, why in (
            ("bearing", "clearance", ""), ("bearing", "outer_radius", "needs kind = 'thrust' in &bearing"), ("transient", "turns", "has no use with .*"))))
    status, words, wrong = call("--keys", "none.nml", folder=folder)
    checks.that("--keys of no file: says so", status == 1 and "does not exist" in wrong and not words)
    status, words, wrong = call("--results", folder=folder)
    checks.that("--results: a table of names with units", status == 0 and all(part in words for part in (
        "| `minimum_gap` | m | bearing |", "`crest_deflection_<n>`", "| `force_x`, `force_y` | N |")))
    status, words, wrong = call("--check", "good.nml", folder=folder)
    checks.that("--check: says what the scene needs", status == 0 and "48 x 8" in words and "in order" in words)
    checks.that("--check: numbers without unit", all(f"{line}\n" in words for line in (
        "C/R: 0.001", "(R/C)^2: 2", "load over p_a D L: 0.125")))
    checks.that("--check: leaves nothing behind", sorted(os.listdir(folder)) == ["good.nml"])
    status, words, wrong = call("--partition=3", "good.nml", folder=folder)
    rows = [line.split() for line in words.splitlines() if re.match(r"^ +[0-2] +\d+ +0 +\d+ +[\d.]+$", line)]
    checks.that("--partition=3: a line a rank", status == 0 and [row[0] for row in rows] == ["0", "1", "2"])
    checks.that("--partition=3: columns add up", sum(int(row[1]) for row in rows) == 48)
    checks.that("--partition=3: unknowns too", sum(int(row[3]) for row in rows) == 48*5)
    checks.that("--partition: balance and cut", "largest load over the mean" in words and "cut: 2 of 47" in words)
    checks.that("--partition: leaves nothing behind", sorted(os.listdir(folder)) == ["good.nml"])
    status, words, wrong = call("--partition", "good.nml", folder=folder, ranks=2)
    checks.that("--partition: ranks of the job", status == 0 and len(re.findall(r"^ +[01] +24 ", words, re.M)) == 2)
    (folder/"plate.nml").write_text(PLATE, encoding="utf-8")
    status, words, wrong = call("--partition=3", "plate.nml", folder=folder)
    rows = [line.split() for line in words.splitlines() if re.match(r"^ +[0-2] +0 +\d+ +\d+ +[\d.]+$", line)]
    checks.that("--partition=3: a plate's columns add up", status == 0 and sum(int(row[2]) for row in rows) == 20)
    (folder/"plate.nml").unlink()
    mistakes = {
        ("--partition=none", "good.nml"): "the number of ranks is a whole number above zero",
        ("--partition=0", "good.nml"): "the number of ranks is a whole number above zero",
        ("--chekc", "good.nml"): "did you mean --check",
        ("-x", "good.nml"): "unknown option -x",
        (): "no case file given",
        ("good.nml", "other.nml"): "one case file at a time",
        ("good.nml", "--output"): "--output needs a folder",
        ("nowhere.nml",): "does not exist",
    }
    for words_given, expected in mistakes.items():
        status, words, wrong = call(*words_given, folder=folder)
        checks.that(f"gfb {' '.join(words_given)}: {expected}", status == 1 and expected in wrong)
    checks.that("mistakes leave nothing behind", sorted(os.listdir(folder)) == ["good.nml"])


def check_folders(checks, folder):
    """Results go where they are wanted, and nothing is computed where they cannot."""
    (folder/"good.nml").write_text(GOOD, encoding="utf-8")
    expected = {f"good.{ending}" for ending in ("summary", "h5", "film.vtkhdf", "used.nml")}
    for option in (["--output", "new/and/nested"], ["--output=with space/here"]):
        status, _, wrong = call(*option, "good.nml", folder=folder)
        place = folder/option[-1].removeprefix("--output=")
        checks.that(f"{' '.join(option)}: made and filled", status == 0 and set(os.listdir(place)) == expected)
    status, _, wrong = call("good.nml", folder=folder)
    checks.that("without --output: here", status == 0 and expected <= set(os.listdir(folder)))
    (folder/"a_file").write_text("not a folder", encoding="utf-8")
    for place in ("a_file", "a_file/below", "/proc/gfb"):
        status, words, wrong = call("--output", place, "good.nml", folder=folder)
        checks.that(f"--output {place}: refused before computing",
                    status == 3 and place in wrong and "solution" not in words)
    if os.geteuid() != 0:  # root writes everywhere
        closed = folder/"closed"
        closed.mkdir(mode=0o555)
        status, _, wrong = call("--output", "closed", "good.nml", folder=folder)
        checks.that("--output closed: refused", status == 3 and "closed" in wrong)


def check_refusals(checks, folder):
    """--check refuses what a run would refuse before its first equation, in the same words."""
    ring = (ROOT/"inputs"/"thrust_shell.nml").read_text(encoding="utf-8")
    (folder/"wide.nml").write_text(re.sub(r"outer_radius *=[^!\n]*", "outer_radius = 50.0", ring), encoding="utf-8")
    (looked, told, refused), (status, _, wrong) = (call(*words, "wide.nml", folder=folder) for words in (["--check"], []))
    checks.that(f"a ring of 50 m: refused by --check as by the run: {refused} {wrong}",
                looked == status == 1 and "is in order" not in told and refused == wrong and "wide.nml: mesh of the " in wrong)
    checks.that("and no result", not list((folder/"results").glob("**/wide*")))


def check_quiet(checks, folder):
    """A line per iteration with --verbose alone; --quiet has a line a stage, with the time so far."""
    (folder/"good.nml").write_text(GOOD, encoding="utf-8")
    loud, usual, quiet = (call(*words, "good.nml", folder=folder)[1] for words in (["--verbose"], [], ["--quiet"]))
    checks.that("--verbose: a line per iteration", "residual" in loud and "new" in loud)
    checks.that("without it: none", "residual" not in usual + quiet and "start: " in usual)
    for part in ("what the scene needs", "eccentricity", "minimum gap", "um", "friction torque", "results: "):
        checks.that(f"the log has: {part}", part in loud and part in usual)
    lines = quiet.rstrip().splitlines()
    checks.that(f"--quiet: a line a stage {quiet}", len(lines) < 10 and lines[-1].startswith("results: ") and all(
        re.fullmatch(r" +\d+\.\d s  \S.*", line) for line in lines[:-1]))
    for stage in ("what the scene needs", "start: ", "answer"):
        checks.that(f"--quiet: {stage}", any(f" s  {stage}" in line for line in lines))
    status, _, wrong = call("--quiet", "--verbose", "good.nml", folder=folder)
    checks.that("not both", status == 1 and "not both" in wrong)
    whirls = GOOD.replace("'equilibrium'", "'linear_dynamics'") + "&dynamics frequency_ratios=0.5 / &rotor mass={} /"
    for mass, words in ((1.0e-3, "rotor: stable"), (100.0, "rotor: unstable")):
        (folder/"whirls.nml").write_text(whirls.format(mass), encoding="utf-8")
        usual, quiet = (call(*words, "whirls.nml", folder=folder)[1] for words in ([], ["--quiet"]))
        checks.that(f"{mass} kg: {words}", words in usual)
        checks.that(f"{mass} kg: --quiet tells what does not stay, and that alone", ("rotor: " in quiet) == (words in quiet) == (mass > 1.0))
    heavy = case_text(BEARING, mesh=(48, 8), number=2.0, load=(-1.0e9, 0.0))
    (folder/"heavy.nml").write_text(heavy, encoding="utf-8")
    status, words, _ = call("--quiet", "heavy.nml", folder=folder)
    checks.that("--quiet: why there is no answer", status == 2 and words.count("no equilibrium found: ") == 1)
    checks.that("--quiet: warnings, at the end too", words.count("warning: heavy.nml:") == 2
                and words.strip().splitlines()[-1].startswith("warning: "))


def on_terminal(folder, *words, environment=None, rests=(), terminal=True, ends=None):
    """What a terminal gets, or a pipe.

    rests: two times after its stage `time` begins, between which the program is stopped [s]; ends: whether what was told so far is enough,
    and the program is to end.
    """
    ours, theirs = os.openpty() if terminal else os.pipe()
    with subprocess.Popen([GFB, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=theirs, stderr=subprocess.DEVNULL,
                          env={**os.environ, **(environment or {})}) as process:
        os.close(theirs)
        timers, told = [threading.Timer(SECONDS, process.kill)], b""
        timers[0].start()
        begun = ended = False
        while True:
            if select.select([ours], [], [], 0.2)[0]:
                try:
                    more = os.read(ours, 4096)
                except OSError:  # the other end is closed
                    break
                if not more:
                    break
                told += more
            if not begun and re.search(rb"^(\x1b\[1m| +\d+\.\d s  )?time\b", told, re.M):
                begun = True
                timers += [threading.Timer(seconds, process.send_signal, (number,))
                           for seconds, number in zip(rests, (signal.SIGSTOP, signal.SIGCONT))]
                for timer in timers[1:]:
                    timer.start()
            if not ended and ends and ends(told.decode(errors="replace")):
                ended = True
                for number in (signal.SIGTERM, signal.SIGCONT):
                    process.send_signal(number)
        process.wait(timeout=SECONDS)
        for timer in timers:
            timer.cancel()
    os.close(ours)
    return told.decode()


WAITING = re.compile(r"\.\.\. \d+ s: time .* s, turn .*, about \d+ s left, .*")


def waiting_lines(told):
    """Those of a log, on a terminal or not."""
    return [part for line in re.split(r"\r\n|\n", told) for part in line.split("\r\x1b[K") if part.startswith("... ")]


def check_waiting(checks, folder):
    """A run of more than ten seconds: on a terminal one line that is written anew and is gone at the end, in a file plain lines
    now and then, with --quiet none. Part of the time it is stopped: its clock goes on, and it costs
    nothing. Each run ends when it has told what is looked for, the quiet one behind the others, however fast the machine is."""
    (folder/"long.nml").write_text(LONG, encoding="utf-8")
    others = threading.Semaphore(0)

    def has_told(count):
        def is_enough(told):
            waits = waiting_lines(told)
            enough = len(waits) >= count and any(map(WAITING.fullmatch, waits[:-1] if count > 1 else waits))
            if enough:
                others.release()
            return enough
        return is_enough
    runs = (("shown",), True, has_told(2)), (("filed",), False, has_told(1))
    with concurrent.futures.ThreadPoolExecutor() as pool:
        quiet = pool.submit(on_terminal, folder, "--output", "quiet", "--quiet", "long.nml", rests=(2.5, 10.0),
                            ends=lambda _: others.acquire(blocking=False) and others.acquire(timeout=SECONDS))
        shown, filed = pool.map(lambda one: on_terminal(folder, "--output", *one[0], "long.nml", rests=(2.5, 10.0), terminal=one[1], ends=one[2]), runs)
        quiet = quiet.result()
    lines = shown.split("\r\n")
    waits = [line for line in lines if "..." in line]
    renewed = waiting_lines(shown)
    checks.that(f"terminal: renewed on one line {waits}", len(waits) == 1 and len(renewed) > 1)
    checks.that(f"terminal: cleared before the next line {waits}", all("..." not in line.rpartition("\x1b[K")[2] for line in waits))
    checks.that("terminal: fits", all(len(part) < 80 for part in renewed))
    told = waiting_lines(filed)
    times = [0, *(int(line.split()[1]) for line in told)]
    checks.that(f"no terminal: plain lines, ten seconds apart {told}", told and "\r" not in filed and "\x1b" not in filed
                and all(later - earlier >= 10 for earlier, later in zip(times, times[1:])))
    for lines in (renewed, told):
        checks.that(f"time, place and what is left: {lines}", any(map(WAITING.fullmatch, lines)))
    checks.that("--quiet: none", "time" in quiet and "..." not in quiet and "\x1b[K" not in quiet)


def check_colours(checks, folder):
    """On a terminal alone, and not where NO_COLOR is set."""
    (folder/"good.nml").write_text(GOOD, encoding="utf-8")
    for environment, coloured in (({"NO_COLOR": ""}, True), ({"NO_COLOR": "1"}, False)):
        words = on_terminal(folder, "good.nml", environment=environment)
        checks.that(f"on a terminal, {environment}: colours {coloured}", ("\x1b[1manswer\x1b[0m" in words) == coloured
                    and "answer" in words)
    checks.that("no terminal: no colours", "\x1b" not in call("good.nml", folder=folder)[1])
    launched = subprocess.run([os.environ.get("GFB_MPIEXEC", "mpiexec"), "-n", "1", GFB, "good.nml"], cwd=folder, capture_output=True,
                              stdin=subprocess.DEVNULL, text=True, check=True, timeout=SECONDS).stdout
    checks.that("under mpiexec into a file: no colours", "\x1b" not in launched and "answer" in launched)


def check_warnings(checks, folder):
    """An improbable value is reported before and after the answer; with --strict it is a mistake. None that come
    with gfb is."""
    odd = GOOD.replace("viscosity = 2e-05", "viscosity = 2e-03")
    (folder/"odd.nml").write_text(odd, encoding="utf-8")
    told = "warning: odd.nml:"
    status, words, wrong = call("odd.nml", folder=folder)
    checks.that("a viscosity a hundred times too large: an answer", odd != GOOD and status == 0 and not wrong)
    checks.that("its warning, before and after the answer", words.count(told) == 2 and words.count("usual is 3e-6") == 2
                and words.index(told) < words.index("what the scene needs") < words.index("results: ") < words.rindex(told))
    status, words, wrong = call("--check", "odd.nml", folder=folder)
    checks.that("--check: told, in order", status == 0 and words.count(told) == 1 and "in order" in words)
    for options in ((), ("--check",), ("--check", "--groups", "1")):
        status, words, wrong = call("--strict", *options, "odd.nml", folder=folder)
        checks.that(f"--strict {' '.join(options)}: status 1", status == 1 and "odd.nml:" in wrong
                    and "viscosity = 2e-03: usual is 3e-6" in wrong and "warning" not in words + wrong)
    shipped = sorted((pathlib.Path(__file__).resolve().parents[2]/"inputs").glob("*.nml"))
    status, words, wrong = call("--check", "--strict", "--groups", "1", *shipped, folder=folder)
    checks.that(f"inputs: no warning {wrong}", status == 0)
    for path in shipped:
        checks.that(f"{path.name}: in order", f"{path} is in order" in words)
    checks.that("there are such files", len(shipped) > 20)


def check_petsc_options(checks, folder):
    """Options that PETSc has from elsewhere are told where they can change the solver, and only there."""
    (folder/"good.nml").write_text(GOOD, encoding="utf-8")
    for words_given, expected in (("-log_view :profile -bearing_snes_max_it 30", "-bearing_snes_max_it 30"),
                                  ("-log_view :profile", "")):
        status, words, _ = call("--output", ".", "good.nml", folder=folder, environment={"PETSC_OPTIONS": words_given})
        with h5py.File(folder/"good.h5") as file:
            kept = file["provenance/petsc_options"][()].decode() if "petsc_options" in file["provenance"] else ""
        checks.that(f"PETSC_OPTIONS={words_given}: '{kept}' in the file", status == 0 and kept == expected)
        checks.that("in the log, too", ("options given to PETSc: " + expected + "\n" in words) == bool(expected))
    (folder/"mine").write_text("-bearing_ksp_type gmres # an experiment\n", encoding="utf-8")
    status, words, _ = call("good.nml", "--petsc-options-file", "mine", "--petsc", "-bearing_snes_max_it", "30", folder=folder)
    checks.that("from a file and the command line", "-bearing_snes_max_it 30" in words and (
        "-bearing_ksp_type gmres" in words))


def check_rerun(checks, folder):
    """The echo computes the same again, and echoes itself."""
    cases = {
        "pad": {"load": (-20.0, 3.0)},
        "held": {"eccentricity": (1.0e-6, 5.0e-6), "tilt": (1.0e-4, 0.0), "groups": {"model": {"film_scheme": "supg"}}},
        "bumps": {"load": (-10.0, 0.0), "foil": "elastic_foundation", "groups": {"bump_foil": {
            "thickness": 0.1e-3, "youngs_modulus": 2.1e11, "poissons_ratio": 0.3, "half_length": 1.8e-3,
            "height": 0.5e-3, "pitch": 4.5e-3}, "scene": {"title": "it''s a 'title', with ! and / and &"}}},
        "sweep": {"load": (-20.0, 3.0), "groups": {"sweep": {"parameter": "load", "values": (5.0, 1.0/3.0)}}},
    }
    for name, case in cases.items():
        first = run(folder, name, BEARING, mesh=(48, 8), number=2.0, **case)
        echo = folder/f"{name}.used.nml"
        again = folder/"again"
        again.mkdir(exist_ok=True)
        shutil.copy(echo, again/f"{name}.nml")
        second = run_file(again/f"{name}.nml", again)
        difference, worst = summary_difference(first, second, natural_sizes(BEARING))
        checks.below(f"{name}: rerun of the echo ({worst})", difference, 0.0)
        keys = [[line.split("!")[0].split() for line in path.read_text(encoding="utf-8").splitlines()
                 if "title" not in line and line.split("!")[0].strip()] for path in (echo, again/f"{name}.used.nml")]
        checks.that(f"{name}: the echo of the echo has the same keys and values", keys[0] == keys[1])


def check_kill(checks, folder):
    """A run that is killed leaves the older result whole, to the last byte."""
    (folder/"case.nml").write_text(GOOD, encoding="utf-8")
    run_file(folder/"case.nml", folder)
    endings = ("summary", "h5", "film.vtkhdf", "used.nml")
    before = {ending: (folder/f"case.{ending}").read_bytes() for ending in endings}
    values = tuple(float(1 + i % 50) for i in range(600))
    (folder/"case.nml").write_text(case_text(BEARING, mesh=(256, 32), number=2.0, load=(-20.0, 0.0), groups={
        "sweep": {"parameter": "load", "values": values}}), encoding="utf-8")
    log = folder/"killed.log"
    for words in ("", "point 2 of", "point 100 of"):
        with open(log, "wb") as told:
            process = subprocess.Popen([GFB, "--output", str(folder), str(folder/"case.nml")],
                                       stdin=subprocess.DEVNULL, stdout=told, stderr=subprocess.DEVNULL)
            while words not in log.read_text(encoding="utf-8") and process.poll() is None:
                time.sleep(0.01)
            alive = process.poll() is None
            process.send_signal(signal.SIGKILL)
            process.wait(timeout=SECONDS)
        where = f"killed at '{words or 'its start'}'"
        checks.that(f"{where}: it still ran", alive)
        checks.that(f"{where}: older result as it was", all(
            (folder/f"case.{ending}").read_bytes() == content for ending, content in before.items()))
    checks.that("killed: a later run is not disturbed", run_small(folder))


def run_small(folder):
    """Whether the good case runs over what killed runs left, and leaves no temporary file."""
    (folder/"case.nml").write_text(GOOD, encoding="utf-8")
    run_file(folder/"case.nml", folder)
    return not list(folder.glob(".gfb*"))


def check_hindrance(checks, folder):
    """Where a file cannot be put in its place: status 3, a sentence, the older results as they were."""
    (folder/"case.nml").write_text(GOOD, encoding="utf-8")
    run_file(folder/"case.nml", folder)
    before = {ending: (folder/f"case.{ending}").read_bytes() for ending in ("h5", "film.vtkhdf", "used.nml")}
    (folder/"case.summary").unlink()
    (folder/"case.summary"/"full").mkdir(parents=True)
    status, _, wrong = call("case.nml", folder=folder)
    checks.that("a folder in the way: status 3 and its name", status == 3 and "case.summary" in wrong)
    checks.that("a folder in the way: no crash", "Backtrace" not in wrong and "MPI_ABORT" not in wrong)
    checks.that("a folder in the way: older results as they were", all(
        (folder/f"case.{ending}").read_bytes() == content for ending, content in before.items()))


def check_side_by_side(checks, folder):
    """Runs side by side, alone and with a launcher, share nothing and leave nothing behind."""
    (folder/"case.nml").write_text(GOOD, encoding="utf-8")
    running, alone = [], 6
    for number in range(alone + 1):
        command = [GFB, "--output", str(folder/str(number)), str(folder/"case.nml")]
        if number == alone:
            command = [MPIEXEC, "-n", "2", *command]
        running.append(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE))
    ended = [process.communicate(timeout=SECONDS)[1].decode() for process in running]
    # Open MPI 5 complains of networks through which two ranks of one machine cannot reach each other.
    ended = ["".join(line for line in said.splitlines(keepends=True) if "opal/mca/btl/tcp" not in line) for said in ended]
    checks.that("side by side: status 0", not any(process.returncode for process in running))
    checks.that(f"side by side: nothing on the error stream {''.join(ended)[:200]}", not any(ended))
    answers = [[line for line in (folder/str(number)/"case.summary").read_text(encoding="utf-8").splitlines()
                if not line.startswith(("wall_time", "peak_memory"))] for number in range(alone)]
    checks.that("side by side: one answer", all(answer == answers[0] for answer in answers))


def check_ranks(checks, folder):
    """Under mpiexec one rank speaks for all, and the status is the program's."""
    (folder/"good.nml").write_text(GOOD, encoding="utf-8")
    (folder/"wrong.nml").write_text(GOOD.replace("clearance", "clearence"), encoding="utf-8")
    status, words, wrong = call("wrong.nml", folder=folder, ranks=2)
    checks.that("wrong input on 2 ranks: status 1", status == 1)
    checks.that("wrong input on 2 ranks: said once", (words + wrong).count("clearence") == 1)
    status, words, _ = call("good.nml", folder=folder, ranks=2)
    checks.that("2 ranks: status 0, one log", status == 0 and words.count("results: ") == 1)
    status, words, _ = call("--check", "good.nml", folder=folder, ranks=2)
    checks.that("--check on 2 ranks: said once", status == 0 and words.count("in order") == 1)
    heavy = case_text(BEARING, mesh=(48, 8), number=2.0, load=(-1.0e9, 0.0))
    (folder/"heavy.nml").write_text(heavy, encoding="utf-8")
    status, words, _ = call("heavy.nml", folder=folder, ranks=2)
    checks.that("no equilibrium on 2 ranks: status 2, said once", status == 2 and words.count("no equilibrium") == 1)
    (folder/"a_file").write_text("not a folder", encoding="utf-8")
    status, _, wrong = call("--output", "a_file", "good.nml", folder=folder, ranks=2)
    checks.that("no folder on 2 ranks: status 3, said once", status == 3 and wrong.count("a_file") == 1)


def main():
    checks = Checks()
    for check in (check_options, check_folders, check_refusals, check_quiet, check_waiting, check_colours, check_warnings, check_petsc_options, check_rerun, check_kill,
                  check_hindrance, check_side_by_side, check_ranks):
        with tempfile.TemporaryDirectory() as folder:
            check(checks, pathlib.Path(folder).resolve())
    checks.close()


if __name__ == "__main__":
    main()
