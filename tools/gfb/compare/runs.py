"""Runs of tools/compare: the scenes, and results that are kept for programs and cases that do not change."""

import dataclasses
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from gfb.bearing_files import copied, names_of
from gfb.bench.runs import last_words
from gfb.case import Case
from gfb.program import DONE, ENVIRONMENT, NOT_CONVERGED, WRONG_INPUT, call, command_of
from gfb.tool import ROOT

sys.path[:0] = [str(ROOT/"tests"/name) for name in ("verification", "floating_point")]

import every_input  # noqa: E402 (found only now)
from scenes import SCENES  # noqa: E402

SECONDS = 3600  # no run here takes that long
FIRST = "before_restart"  # folder of what a run left that a second one goes on from
ENDED, LOG = "ended.txt", "log.txt"
DID_RUN = (DONE, WRONG_INPUT, NOT_CONVERGED)  # any other status: the machine failed, or the program was ended by a signal


@dataclasses.dataclass(frozen=True)
class Task:
    """A case and how it is run."""

    name: str
    text: str
    options: tuple = ()
    restart: bool = False  # a second run goes on where the first one ended
    files: tuple = ()      # (name, text) of what it names, such as a machine's bearings


@dataclasses.dataclass(frozen=True)
class Ended:
    """A run that has ended."""

    folder: pathlib.Path  # of what it left
    status: str           # of its runs
    seconds: float        # wall time of this call; 0: kept from an earlier one
    failed: str = ""      # the end of what it printed, where the machine failed or a signal ended it


def tasks(small):
    """All scenes: the small ones, the inputs and their variants, coarser where it must be quick."""
    made = [Task(scene.name, str(Case(scene.case)), tuple(scene.options), scene.restart) for scene in SCENES]
    for name in (*sorted(path.stem for path in every_input.INPUTS.glob("*.nml")), *every_input.VARIANTS):
        text = (every_input.INPUTS/f"{name.partition(':')[0]}.nml").read_text(encoding="utf-8")
        changes = every_input.changes_of(name, not small)
        made.append(Task(name.replace(":", "_"), every_input.changed(text, changes) if changes else text))
    for path in sorted((every_input.INPUTS/"machines").glob("*.nml")):
        text = path.read_text(encoding="utf-8")
        if names_of(text):
            text, files = copied(text, path.parent, path.stem)
            made.append(Task(path.stem, text, files=tuple(files.items())))
    return made


def fingerprint(program):
    """What the bits of a program's answers depend on: itself, its libraries, and the processor, to which BLAS adapts."""
    known = hashlib.sha256(pathlib.Path(program).read_bytes())
    known.update(os.environ.get("OPENBLAS_CORETYPE", "").encode())
    listed = subprocess.run(["ldd", program], capture_output=True, text=True, check=False).stdout
    for word in sorted(set(listed.split())):
        if word.startswith("/") and os.path.exists(word):
            about = os.stat(word)
            known.update(f"{os.path.realpath(word)} {about.st_size} {about.st_mtime_ns}\n".encode())
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    known.update("\n".join(sorted({line for line in lines if line.startswith(("model name", "flags"))})).encode())
    return known.hexdigest()[:16]


def kept_run(program, task, store):
    """A run's results, from the folder of the program if it has been made before."""
    key = hashlib.sha256(repr(dataclasses.astuple(task)).encode()).hexdigest()[:16]
    folder = store/f"{task.name}.{key}"
    if (folder/ENDED).exists():
        return Ended(folder, (folder/ENDED).read_text(encoding="utf-8"), 0.0)
    store.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=store) as place:
        ended = run(program, task, pathlib.Path(place)/"new")
        if not ended.failed:  # what failed is tried again
            shutil.rmtree(folder, ignore_errors=True)
            os.replace(ended.folder, folder)
    return dataclasses.replace(ended, folder=folder)


def run(program, task, folder):
    """Runs a task in a new folder, on one rank; the last file that is written says how it ended."""
    folder.mkdir(parents=True)
    for name, text in ((f"{task.name}.nml", task.text), *task.files):
        (folder/name).write_text(text, encoding="utf-8")
    begun = time.monotonic()
    statuses = [run_once(program, task, folder, ())]
    if task.restart:
        (folder/FIRST).mkdir()
        for path in folder.glob(f"{task.name}.*"):
            shutil.copy(path, folder/FIRST)
        statuses.append(run_once(program, task, folder, ("--restart",)))
    status = " ".join(map(str, statuses))
    (folder/ENDED).write_text(status, encoding="utf-8")
    failed = "" if all(one in DID_RUN for one in statuses) else last_words((folder/LOG).read_text(errors="replace"))
    return Ended(folder, status, time.monotonic() - begun, failed)


def run_once(program, task, folder, more):
    """One call of the program; its status. Names are the same for every program: results hold some of them."""
    command = command_of(program, f"{task.name}.nml", ".", options=("--quiet", *task.options, *more))
    # Two threads would add up in another order: here even what the user has set is overruled.
    done = call(command, SECONDS, ENVIRONMENT, folder)
    with open(folder/LOG, "a", encoding="utf-8") as log:
        log.write(done.log + done.complaint)
    return done.status
