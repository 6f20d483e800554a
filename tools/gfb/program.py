"""The program gfb: where it is, how it is called, and what it says of itself: its version, its keys."""

from __future__ import annotations

import dataclasses
import functools
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sysconfig
import time
from collections.abc import Mapping, Sequence
from typing import Union

from gfb.tool import ROOT, RunError, stop

PathLike = Union[str, "os.PathLike[str]"]
DONE, WRONG_INPUT, NOT_CONVERGED = 0, 1, 2  # status of the program
OUT_OF_TIME = 124                           # of a run that its time limit has stopped
MACHINE_FAILED = 3
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
CELLS = re.compile(r"(?<!\\)\|")  # what parts a row of a table that the program prints


# --- where it is ---

def find_program(given: PathLike | None = None) -> str:
    """The program: the one given, that of the environment variable GFB, one on the path, that of a wheel beside this Python,
    or that of this checkout."""
    for name in (given, os.environ.get("GFB"), "gfb", os.path.join(sysconfig.get_path("scripts"), "gfb"), ROOT/"build/release/gfb"):
        found = shutil.which(name) if name else None
        if found:
            return os.path.abspath(found)
    raise FileNotFoundError("gfb is not found: install it, set GFB, or call tools/run once")


def find_gfb(given: str | None = None) -> str:
    """For tools that measure and document a checkout: the program named, or that of the release build; stops where there is none."""
    if given is None:
        path = ROOT/"build/release/gfb"
        if not os.access(path, os.X_OK):
            stop(f"there is no {path}: call tools/run once, or name the program with --gfb")
        return str(path)
    found = shutil.which(given)
    return os.path.abspath(found) if found else stop(f"--gfb {given}: no such program")


def launcher(path: PathLike) -> str:
    """What starts several ranks of a program: what the environment variable GFB_MPIEXEC names, that of its wheel, or mpiexec."""
    return os.environ.get("GFB_MPIEXEC") or shutil.which(str(pathlib.Path(path).resolve().with_name("gfb-mpiexec"))) or "mpiexec"


# --- its calls ---

@dataclasses.dataclass
class Called:
    """A command that has ended."""

    status: int
    log: str        # standard output
    complaint: str  # standard error
    wall: float     # of the whole process, from its start to its end [s]
    cpu: float      # user and system time of the process [s], where no other process of the tool ends meanwhile


def call(command: Sequence[object], seconds: float | None = None, environment: Mapping[str, str] | None = None, folder: PathLike | None = None,
         text: str | None = None) -> Called:
    """Runs a command to its end, in a folder and on a text where they are given; subprocess.TimeoutExpired after so many seconds."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(list(map(str, command)), stdin=subprocess.DEVNULL if text is None else None, input=text, capture_output=True,
                          encoding="utf-8", errors="replace", cwd=folder, timeout=seconds, check=False,
                          env={**ENVIRONMENT, **os.environ, **(environment or {})})
    wall, after = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return Called(done.returncode, done.stdout, done.stderr, wall, cpu)


def command_of(gfb: PathLike, path: PathLike, folder: PathLike, ranks: int = 1, options: Sequence[str] = (), petsc: Sequence[str] = ()) -> list[str]:
    """The command line that runs a case file; petsc: options of PETSc's own."""
    dash = ["--"]*str(path).startswith("-")
    command = [str(gfb), *options, "--output", str(folder), *dash, str(path), *(["--petsc", *petsc] if petsc else [])]
    return [launcher(gfb), "-n", str(ranks), *command] if ranks > 1 else command


def stem_of(path: PathLike, folder: PathLike, options: Sequence[str] = (), status: int = DONE) -> pathlib.Path:
    """What the names of a run's result files begin with."""
    ending = ".branches" if "--branches" in options else ""
    ending += ".unconverged" if status == NOT_CONVERGED else ""
    return pathlib.Path(folder)/(pathlib.Path(path).stem + ending)


# --- what it says of itself ---

def words_of(gfb: PathLike) -> str:
    """What the program calls itself, with version and commit."""
    return said(os.fspath(gfb), "--version", os.stat(gfb).st_mtime_ns).partition(",")[0].strip()


@functools.lru_cache
def said(path: str, option: str, _: int) -> str:
    """What a program, written then, prints."""
    done = call([path, option])
    if done.status != DONE:
        raise RunError(f"{path} {option} ended with status {done.status}:\n{done.complaint}", MACHINE_FAILED)
    return done.log


def printed_table(gfb: PathLike, name: str) -> str:
    """A table that the program prints: 'keys' or 'results'. Raises RunError where it prints none."""
    table = said(os.fspath(gfb), f"--{name}", os.stat(gfb).st_mtime_ns)
    if not table.startswith("| "):
        raise RunError(f"{gfb} --{name}: no table; is it gfb?", WRONG_INPUT)
    return table.strip() + "\n"


def table_rows(printed: str) -> list[list[str]]:
    """The cells of a table that the program prints, without its head."""
    return [[cell.strip() for cell in CELLS.split(line)[1:-1]] for line in printed.strip().splitlines()[2:]]


@dataclasses.dataclass(frozen=True)
class Key:
    """A row of `gfb --keys`."""

    group: str
    name: str
    kind: str
    unit: str
    default: str
    meaning: str


def read_keys(gfb: PathLike) -> dict[str, Key]:
    """{group%key: its row} of all keys that the program knows, in its order."""
    rows = (Key(group.strip("`&"), name.strip("`"), *rest) for group, name, *rest in table_rows(printed_table(gfb, "keys")))
    return {f"{key.group}%{key.name}": key for key in rows}


def unit_of_key(gfb: PathLike, name: str) -> str:
    """The unit of a key, or of an element of a list, `group%key(2)`; empty where it has none."""
    key = read_keys(gfb).get(name.lower().partition("(")[0])
    return key.unit if key else ""
