"""Runs gfb: a case file from Python values, a call of the program, and the answer that it leaves."""

import dataclasses
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time
import types

import gfb
from gfb.namelist import namelist_value
from gfb.results import Answer, read_petsc_log, read_summary
from gfb.tool import ROOT, stop

DONE, WRONG_INPUT, NOT_CONVERGED = 0, 1, 2  # status of the program
MPIEXEC = os.environ.get("GFB_MPIEXEC", "mpiexec")
# One thread a process; Open MPI as root, on few cores, without ssh. What the user has set stays.
ENVIRONMENT = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}


def find_gfb(given=None):
    """The program: the one named, or that of the release build."""
    if given is None:
        path = ROOT/"build/release/gfb"
        if not os.access(path, os.X_OK):
            stop(f"there is no {path}: call tools/run once, or name the program with --gfb")
        return str(path)
    path = shutil.which(given)
    if path is None:
        stop(f"--gfb {given}: no such program")
    return os.path.abspath(path)


# --- case files ---

def case_text(groups):
    """A case file from {group: {key: value}}; numbers read back exactly, what is None is left out."""
    text = ""
    for group, keys in groups.items():
        if keys is not None:
            lines = "".join(f"  {key} = {namelist_value(value)}\n" for key, value in keys.items() if value is not None)
            text += f"&{group}\n{lines}/\n"
    return text


def write_case(folder, name, groups):
    """Writes a case file into a folder; its path."""
    path = pathlib.Path(folder)/f"{name}.nml"
    path.write_text(case_text(groups), encoding="utf-8")
    return path


# --- calls of the program ---

@dataclasses.dataclass
class Called:
    """A command that has ended."""

    status: int
    log: str        # standard output
    complaint: str  # standard error
    wall: float     # of the whole process, from its start to its end [s]
    cpu: float      # user and system time of the process [s], where no other process of the tool ends meanwhile


def call(command, seconds=None, environment=None, folder=None):
    """Runs a command to its end, in a folder where one is given; subprocess.TimeoutExpired after so many seconds."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(list(map(str, command)), stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8",
                          errors="replace", cwd=folder, timeout=seconds, check=False,
                          env={**ENVIRONMENT, **os.environ, **(environment or {})})
    wall, after = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return Called(done.returncode, done.stdout, done.stderr, wall, cpu)


def command_of(gfb, path, folder, ranks=1, options=(), petsc=()):
    """The command line that runs a case file; petsc: options of PETSc's own."""
    command = [gfb, *options, "--output", str(folder), str(path), *(["--petsc", *petsc] if petsc else [])]
    return [MPIEXEC, "-n", str(ranks), *command] if ranks > 1 else command


def stem_of(path, folder, options=(), status=DONE):
    """What the names of a run's result files begin with."""
    ending = ".branches" if "--branches" in options else ""
    ending += ".unconverged" if status == NOT_CONVERGED else ""
    return pathlib.Path(folder)/(pathlib.Path(path).stem + ending)


def run_file(gfb, path, folder, ranks=1, options=(), petsc=(), seconds=None, environment=None):
    """Runs a case file; the answer, however the run ended."""
    done = call(command_of(gfb, path, folder, ranks, options, petsc), seconds, environment)
    return answer_of(done, stem_of(path, folder, options, done.status))


def answer_of(done, stem):
    """What a call of the program left behind."""
    summary = stem.with_name(stem.name + ".summary")
    has_answer = done.status in (DONE, NOT_CONVERGED) and summary.exists()
    values, units = read_summary(summary) if has_answer else ({}, {})
    return Answer(done.status, done.log, done.complaint, stem, values, units, done.wall, done.cpu)


def run_case(gfb, groups, folder, name, petsc=(), may_stop=False):
    """Writes a case file and runs it on one rank; ends the tool where it does not converge, unless it may."""
    path = write_case(folder, name, groups)
    answer = run_file(gfb, path, folder, options=("--quiet",), petsc=petsc)
    if answer.status not in ((DONE, NOT_CONVERGED) if may_stop else (DONE,)):
        stop(f"{path}: gfb ended with status {answer.status}:\n{answer.log}{answer.complaint}", 3)
    return answer


def run_logged(gfb, groups, folder, name, may_stop=False):
    """The same, and PETSc's log of the run: {stage: {event: (calls, seconds)}}."""
    log = pathlib.Path(folder)/"log.csv"
    answer = run_case(gfb, groups, folder, name, petsc=("-log_view", f":{log}:ascii_csv"), may_stop=may_stop)
    return answer, read_petsc_log(log)


def start_time(gfb, repetitions=3):
    """CPU time of a call that computes nothing, the smallest of a few [s]."""
    return min(call([gfb, "--version"]).cpu for _ in range(repetitions))


class _Callable(types.ModuleType):
    """This module, which as `gfb.run(case)` is the function of gfb.door, too."""

    def __call__(self, *values, **options):
        try:
            from gfb import door  # its packages only where they are needed
        except ModuleNotFoundError as error:
            raise gfb.missing("gfb.run", error) from None
        return door.run(*values, **options)


sys.modules[__name__].__class__ = _Callable
