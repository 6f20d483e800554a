#!/usr/bin/env python3
"""MPI that cannot start ends in a sentence and status 3; a rank that is killed or stopped does not hold its job."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import GFB, MPIEXEC, Checks  # noqa: E402
from gfb.bench.faults import CASE  # noqa: E402 (gfb_run has made it known)
from gfb.case import Case  # noqa: E402
from gfb.program import ENVIRONMENT  # noqa: E402

SECONDS = 900  # nothing here takes that long
SAID = "gfb: MPI could not start: "
NOWHERE = "/proc"  # where not even root makes a folder
SWEEP = CASE | {"sweep": {"parameter": "load", "values": tuple(10.0 + i % 20 for i in range(1500))}}


def call(folder, *words, ranks=1, **settings):
    """Status and complaints of a run under settings of the environment."""
    command = [GFB, *words]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", check=False,
                          timeout=SECONDS, env={**ENVIRONMENT, **os.environ, **settings})
    return done.returncode, done.stderr


def check_start(checks, folder):
    """Settings of Open MPI's that name what is not there, and no folder for its session."""
    (folder/"case.nml").write_text(str(Case(CASE)), encoding="utf-8")
    (folder/"sweep.nml").write_text(str(Case(CASE | {"sweep": {"parameter": "load", "values": (20.0, 30.0)}})), encoding="utf-8")
    faults = [{f"OMPI_MCA_{name}": "nonsense"} for name in ("pml", "btl")]
    of_folder = {"OMPI_MCA_orte_tmpdir_base": NOWHERE, "TMPDIR": NOWHERE}
    if "OpenRTE" in subprocess.run([MPIEXEC, "--version"], capture_output=True, encoding="utf-8", check=False).stdout:  # Open MPI 4
        faults += [of_folder]
    for settings in faults:
        for words in (("case.nml",), ("--version",), ("--groups", "1", "sweep.nml")):
            status, wrong = call(folder, *words, **settings)
            checks.that(f"{settings} {' '.join(words)}: status {status}", status == 3)
            checks.that("  one sentence says so", wrong.count(SAID) == 1 and wrong.rstrip().splitlines()[-1].startswith(SAID))
    for settings in faults[:2]:
        status, wrong = call(folder, "case.nml", ranks=2, **settings)
        checks.that(f"{settings}, 2 ranks: status {status}", status != 0 and SAID in wrong)
    if of_folder in faults:
        status, wrong = call(folder, "case.nml", **of_folder)
        checks.that(f"  it names the folder: {wrong.strip()}", f"nothing can be written in {NOWHERE}" in wrong)
    checks.that("no results of these", not list(folder.glob("*.summary")))


def check_folder(checks, folder):
    """A run that is alone finds another folder than that of TMPDIR, and leaves nothing in it."""
    for place in (NOWHERE, str(folder/"none")):
        for words in (("case.nml",), ("--groups", "1", "sweep.nml")):
            status, wrong = call(folder, *words, TMPDIR=place)
            checks.that(f"TMPDIR={place} {' '.join(words)}: status {status} {wrong.strip()}", status == 0 and not wrong)
    place = folder/"temporary"
    place.mkdir()
    checks.that("an input that is wrong keeps its status", call(folder, "none.nml", TMPDIR=str(place))[0] == 1)
    checks.that("a start that fails, too", call(folder, "case.nml", TMPDIR=str(place), OMPI_MCA_pml="nonsense")[0] == 3)
    call(folder, "case.nml", TMPDIR=str(place))
    checks.that("nothing is left of a session", not list(place.glob("gfb-*")))


def disturbed(folder, disturb):
    """Status of a long job of two ranks, and its ranks: it is disturbed at its second point, by its process and its last rank."""
    (folder/"long.nml").write_text(str(Case(SWEEP)), encoding="utf-8")
    with subprocess.Popen([MPIEXEC, "-n", "2", GFB, "long.nml"], cwd=folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8",
                          env={**ENVIRONMENT, **os.environ}) as process:
        for line in process.stdout:
            if line.startswith("point 2 of"):
                break
        ranks = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()[-2:]
        disturb(process, int(ranks[-1]))
        try:
            process.communicate(timeout=SECONDS)
            return process.returncode, ranks
        except subprocess.TimeoutExpired:
            process.kill()
            return 0, ranks


def check_killed_rank(checks, folder):
    """A rank that is killed does not hang the others."""
    status, _ = disturbed(folder, lambda _, rank: os.kill(rank, signal.SIGKILL))
    checks.that(f"a killed rank ends the job: status {status}", status != 0)


def check_stopped_rank(checks, folder):
    """MPI sees no rank that is stopped: the job waits for it, and a signal to the job ends it all the same."""
    def stop(process, rank):
        os.kill(rank, signal.SIGSTOP)
        process.send_signal(signal.SIGTERM)

    status, ranks = disturbed(folder, stop)
    checks.that(f"a stopped rank, SIGTERM: status {status}", status != 0)
    checks.that("no rank is left", not any(pathlib.Path(f"/proc/{rank}/exe").exists() for rank in ranks))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        for check in (check_start, check_folder, check_killed_rank, check_stopped_rank):
            check(checks, pathlib.Path(name))
    checks.close()


if __name__ == "__main__":
    main()
