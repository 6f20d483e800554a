#!/usr/bin/env python3
"""Long names, deep folders and odd case files work, or are refused before anything is computed; so are ranks that a mesh
cannot use."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import GFB, MPIEXEC, Checks, read_summary  # noqa: E402
from gfb.bench.faults import CASE  # noqa: E402 (gfb_run has made it known)
from gfb.case import Case  # noqa: E402
from gfb.program import ENVIRONMENT  # noqa: E402

SECONDS = 900
TEXT = str(Case(CASE))
LONGEST = 255 - len(".unconverged.bump_foil.steps.vtkhdf")


def call(folder, *words, ranks=1, text=None):
    """Status, log, complaints."""
    command = [GFB, *map(str, words)]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    done = subprocess.run(command, cwd=folder, input=text, stdin=None if text else subprocess.DEVNULL, capture_output=True,
                          encoding="utf-8", check=False, timeout=SECONDS, env={**ENVIRONMENT, **os.environ})
    return done.returncode, done.stdout, done.stderr


def check_names(checks, folder):
    """Case names up to what a file system takes."""
    for length in (100, LONGEST, LONGEST + 1, 251):
        name = "n"*length
        (folder/f"{name}.nml").write_text(TEXT, encoding="utf-8")
        place = folder/str(length)
        status, log, wrong = call(folder, "--output", place, f"{name}.nml")
        if length <= LONGEST:
            checks.that(f"a name of {length} characters works", status == 0 and (place/f"{name}.h5").exists())
        else:
            checks.that(f"a name of {length} characters is refused first", status == 1 and "too long by" in wrong
                        and "solution" not in log)


def check_folders(checks, folder):
    """Paths up to what the system takes."""
    (folder/"c.nml").write_text(TEXT, encoding="utf-8")
    here = str(folder)
    for length in (1000, 4000, 4080):
        deep = here
        while len(deep) < length:
            deep += "/" + "d"*min(200, max(1, length - len(deep) - 1))
        status, log, wrong = call(folder, "--output", deep, "c.nml")
        if length <= 4000:
            checks.that(f"a path of {len(deep)} characters works {wrong[-200:]}", status == 0
                        and os.path.exists(deep + "/c.h5"))
        else:
            checks.that(f"a path of {len(deep)} characters is refused first", status == 1 and "too long" in wrong
                        and "solution" not in log)


def check_odd_files(checks, folder):
    """What begins with a dash, is piped, or is a pipe."""
    (folder/"-x.nml").write_text(TEXT, encoding="utf-8")
    checks.that("gfb -- -x.nml", call(folder, "--", "-x.nml")[0] == 0 and (folder/"-x.summary").exists())
    checks.that("gfb -- alone", call(folder, "--")[0] == 1)
    os.mkfifo(folder/"pipe.nml")
    for name, text in (("pipe.nml", None), ("/dev/stdin", TEXT), ("/dev/null", None)):
        status, _, wrong = call(folder, name, text=text)
        checks.that(f"{name}: {wrong.strip()}", status == 1 and "is a pipe, a terminal or another device" in wrong)


def check_encoding(checks, folder):
    """A file in Latin-1 is read, with a warning; what is written is UTF-8."""
    text = TEXT.replace("&scene", "&scene title = 'M\u00fcller',", 1)
    (folder/"latin.nml").write_bytes(text.encode("latin-1"))
    status, log, _ = call(folder, "latin.nml")
    checks.that(f"Latin-1: status {status}", status == 0)
    checks.that("Latin-1: a warning", "the byte 252 is no UTF-8" in log)
    checks.that("Latin-1: the echo is UTF-8", "M\u00fcller" in (folder/"latin.used.nml").read_bytes().decode("utf-8"))


def check_older_results(checks, folder):
    """A state without an answer goes when the case has one, and leaves an older answer alone; a case of that name stays."""
    place = folder/"older"
    heavy = CASE | {"operation": CASE["operation"] | {"load": (-1.0e5, 0.0)}, "solver": {"maximum_load_steps": 1}}
    for number, (case, wanted, words) in enumerate((
            (CASE, {"older"}, ""), (heavy, {"older", "older.unconverged"}, "are of an earlier run"),
            (CASE, {"older"}, "older.unconverged.*, of an earlier run without an answer"))):
        (folder/"older.nml").write_text(str(Case(case)), encoding="utf-8")
        status, log, _ = call(folder, "--output", place, "older.nml")
        checks.that(f"run {number + 1}: status {status}", status == (2 if case is heavy else 0))
        checks.that(f"run {number + 1} says '{words}'", words in log)
        files = {path.name for path in place.iterdir()}
        checks.that(f"run {number + 1} leaves {sorted(files)}", files == {
            f"{name}.{ending}" for name in wanted for ending in ("summary", "h5", "film.vtkhdf", "used.nml")})
    (folder/"older.unconverged.nml").write_text(str(Case(CASE)), encoding="utf-8")
    call(folder, "--output", place, "older.unconverged.nml")
    call(folder, "--output", place, "older.nml")
    checks.that("the answer of a case that is called so stays", (place/"older.unconverged.summary").exists())


def check_ranks(checks, folder):
    """A small mesh on more and more ranks: the same answer, or a sentence."""
    (folder/"small.nml").write_text(TEXT, encoding="utf-8")
    few = CASE | {"mesh": {"circumferential_elements": 8, "axial_elements": 2}}
    (folder/"few.nml").write_text(str(Case(few)), encoding="utf-8")
    call(folder, "small.nml")
    alone = read_summary(folder/"small.summary")[0]
    for ranks in (3, 16):
        place = folder/f"ranks{ranks}"
        status, _, wrong = call(folder, "--output", place, "small.nml", ranks=ranks)
        same = status == 0 and all(
            abs(read_summary(place/"small.summary")[0][name]/alone[name] - 1.0) < 1.0e-8
            for name in ("minimum_gap", "friction_torque", "maximum_pressure"))
        checks.that(f"32 x 4 elements on {ranks} ranks: the same answer {wrong[:200]}", same)
    call(folder, "--output", "one", "few.nml")
    status, log, wrong = call(folder, "few.nml", ranks=16)
    gaps = [read_summary(place/"few.summary")[0]["minimum_gap"] for place in (folder, folder/"one")]
    checks.that(f"8 x 2 elements on 16 ranks: status {status}, {wrong.strip()[:300]}", status == 0)
    checks.below("their answer", gaps[0]/gaps[1] - 1.0, 1.0e-8)
    checks.that("it says that ranks have nothing to do", "warning: " in log and "have nothing to do" in log)


def check_memory(checks, folder):
    """What a run refuses for want of memory, --check refuses too; what is free changes from one call to the next."""
    large = CASE | {"mesh": {"circumferential_elements": 10000, "axial_elements": 4800}}
    (folder/"large.nml").write_text(str(Case(large)), encoding="utf-8")
    complaints = []
    for options in (("--check",), ()):
        status, _, wrong = call(folder, *options, "large.nml")
        complaints.append(re.sub(r"machine that has [0-9.]+ [GM]B free", "machine", wrong))
        checks.that(f"{options or 'run'}: status {status}: {wrong.strip()[:150]}", status == 1 and "of memory" in wrong)
    checks.that("both say the same", complaints[0] == complaints[1] and "rank(s) on a machine; what" in complaints[0])


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        for check in (check_names, check_folders, check_odd_files, check_encoding, check_older_results, check_ranks, check_memory):
            check(checks, pathlib.Path(name))
    checks.close()


if __name__ == "__main__":
    main()
