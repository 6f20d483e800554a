"""`gfb.run` and `gfb.study`: the program called from Python, once or over the values of keys."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import functools
import itertools
import os
import pathlib
import signal
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy
import xarray

from gfb.case import Case, CaseError, launcher, program
from gfb.reading import read
from gfb.results import Unreadable, open_results, read_summary, reading, text_of

MEMBER_NAME = "{study}_{number:04d}"
DONE, WRONG_INPUT, NOT_CONVERGED = 0, 1, 2
ENDINGS = {DONE: ".summary", NOT_CONVERGED: ".unconverged.summary"}
BATCH = 50  # members that one call of the program computes: what is lost of them where it is killed is the one it is at


OUT_OF_TIME, SIGNALS = 124, 128  # status of a run that its time limit has stopped; of one that a signal has, less its number
AGAIN = ("stopped", "out_of_time", "failed")  # how runs end of which another call may find the answer


class RunError(RuntimeError):
    """A file or the machine failed, or the run was stopped; its text is the program's."""

    def __init__(self, words: str, status: int) -> None:
        super().__init__(words)
        self.status = status


@dataclasses.dataclass
class Result:
    """What a run left behind."""

    converged: bool
    stem: pathlib.Path  # of the files, without ending
    log: str

    @property
    def data(self) -> xarray.Dataset:
        """The case's result file, as `gfb.read` gives it."""
        return read(f"{self.stem}.h5")

    @property
    def film(self) -> xarray.Dataset:
        """The film's fields."""
        return read(f"{self.stem}.film.vtkhdf")

    @property
    def summary(self) -> dict[str, Any]:
        """Name and value of every result."""
        return read_summary(f"{self.stem}.summary")[0]

    def __getitem__(self, name: str) -> Any:
        return self.summary[name]


def run(case: Case | str | os.PathLike[str], folder: str | os.PathLike[str] = "results", name: str = "case", ranks: int = 1,
        options: Sequence[str] = (), gfb: str | os.PathLike[str] | None = None) -> Result:
    """Runs a Case, which gets the name, or a case file. No answer is a Result that has not converged; raises CaseError
    where the case is wrong, and RunError where a file or the machine failed."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    path = case.write(folder/f"{name}.nml") if isinstance(case, Case) else pathlib.Path(case)
    path_of_gfb = program(gfb)
    command = [path_of_gfb, *options, "--output", str(folder), "--", str(path)]
    if ranks > 1:
        command = [launcher(path_of_gfb), "-n", str(ranks), *command]
    done = call(command)
    if done.returncode == WRONG_INPUT:
        raise CaseError(done.stderr.strip())
    if done.returncode not in (DONE, NOT_CONVERGED):
        raise RunError(f"status {done.returncode}: {(done.stderr or done.stdout).strip()[-2000:]}", done.returncode)
    ending = (".branches" if "--branches" in options else "") + (".unconverged" if done.returncode == NOT_CONVERGED else "")
    return Result(done.returncode == DONE, folder/(path.stem + ending), done.stdout)


def study(case: Case, values: Mapping[str, Sequence[Any]], folder: str | os.PathLike[str] = "study", name: str = "study",
          processes: int = 1, gfb: str | os.PathLike[str] | None = None) -> xarray.Dataset:
    """Runs a case for every combination of values of keys, `{"bearing%clearance": [3e-5, 4e-5], ...}`; a dataset of the
    summaries with a dimension a key. `status` is the program's; numbers are NaN where there is no answer. Called again,
    it computes what is not there yet, was stopped, or is another program's, of which it warns. All combinations are checked before the first is computed."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    cases = []
    for combination in itertools.product(*values.values()):
        one = case.copy()
        for key, value in zip(values, combination):
            one[key] = value
        cases.append(one)
    stems = [folder/MEMBER_NAME.format(study=name, number=number + 1) for number in range(len(cases))]
    check_all(cases, gfb)
    missing = [number for number, stem in enumerate(stems) if find_member(cases[number], stem, gfb) is None]
    others = [older for number in missing for older in older_programs(cases[number], stems[number], gfb)]
    if others:
        warn(f"{folder}: {len(others)} results of {', '.join(sorted(set(others)))} are computed again by {program_words(gfb)}")
    size = max(1, min(BATCH, -(-len(missing)//max(1, processes))))
    batches = [missing[first:first + size] for first in range(0, len(missing), size)]
    with concurrent.futures.ThreadPoolExecutor(max_workers=max(1, processes)) as pool:
        list(pool.map(lambda batch: run_batch([cases[number] for number in batch], [stems[number] for number in batch], gfb), batches))
    found = [find_member(one, stem, gfb) or run_member(one, stem, gfb) for one, stem in zip(cases, stems)]
    return table(values, found)


def warn(words: str) -> None:
    """A warning of the call of the user."""
    warnings.warn(words, stacklevel=3)


def check_all(cases: Sequence[Case], gfb: str | os.PathLike[str] | None) -> None:
    """One call of the program for all; the first case that is wrong raises CaseError."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [str(one.write(pathlib.Path(folder)/f"{number}.nml")) for number, one in enumerate(cases)]
        right = all(call([program(gfb), "--check", "--groups", "1", "--", *paths[first:first + BATCH]]).returncode == DONE
                    for first in range(0, len(paths), BATCH))
    for one in [] if right else cases:
        one.check(gfb=gfb)


def run_batch(cases: Sequence[Case], stems: Sequence[pathlib.Path], gfb: str | os.PathLike[str] | None) -> None:
    """Runs members one after another in one call of the program, which starts once for all; what it leaves out is missing.
    A member alone is no batch. Raises RunError where it is stopped: those that it has not reached are left to another call."""
    if len(cases) < 2:
        return
    for one, stem in zip(cases, stems):
        one.write(stem.with_name(stem.name + ".nml"))
    side = f"{stems[0].name}.batch"
    done = call([program(gfb), "--quiet", "--groups", "1", "--name", side, "--output", str(stems[0].parent), "--",
                 *(str(stem.with_name(stem.name + ".nml")) for stem in stems)])
    for ending in (".h5", ".summary"):
        stems[0].with_name(side + ending).unlink(missing_ok=True)
    if done.returncode >= OUT_OF_TIME or -done.returncode in (signal.SIGINT, signal.SIGTERM):
        raise RunError(f"status {done.returncode}: the program was stopped; what has its answer stays, another call computes the rest", done.returncode)


def call(command: Sequence[str]) -> subprocess.CompletedProcess[str]:
    """Calls the program to its end; one thread a process, where the user has said nothing else."""
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
                          env={"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", **os.environ})


@dataclasses.dataclass
class Kept:
    """What lies there of a member's case, whoever computed it."""

    status: int
    program: str  # with version and commit
    outcome: str  # how a run without an answer ended


def kept_results(case: Case, stem: pathlib.Path) -> Iterator[Kept]:
    """What lies there of this very case, by what the files themselves say; damaged ones are none."""
    for status, ending in ENDINGS.items():
        path = stem.with_name(stem.name + ending.replace(".summary", ".h5"))
        try:
            with reading(path), open_results(path) as file:
                if text_of(file["scene/case_file"][()]) == str(case):
                    version, commit = (text_of(file[f"provenance/{name}"][()]) for name in ("program_version", "commit"))
                    outcome = text_of(file["summary/outcome"][()]) if "outcome" in file["summary"] else ""
                    yield Kept(status, f"gfb {version} ({commit})", outcome)
        except (Unreadable, FileNotFoundError):
            pass


def find_member(case: Case, stem: pathlib.Path, gfb: str | os.PathLike[str] | None) -> tuple[int, dict[str, Any], dict[str, str]] | None:
    """Status, summary and units of a member that this program has computed to its end; None where that is not there."""
    for kept in kept_results(case, stem):
        if kept.program == program_words(gfb) and kept.outcome not in AGAIN:
            return (NOT_CONVERGED, {}, {}) if kept.status == NOT_CONVERGED else (DONE, *read_summary(stem.with_name(stem.name + ENDINGS[DONE])))
    return None


def older_programs(case: Case, stem: pathlib.Path, gfb: str | os.PathLike[str] | None) -> list[str]:
    """Programs of other versions whose results of a member lie there."""
    return [kept.program for kept in kept_results(case, stem) if kept.program != program_words(gfb) and kept.outcome not in AGAIN]


def program_words(gfb: str | os.PathLike[str] | None) -> str:
    """What the program calls itself, with version and commit."""
    path = program(gfb)
    return words_of(path, os.stat(path).st_mtime_ns)


@functools.lru_cache
def words_of(path: str, _: int) -> str:
    """The same of a file that was written then."""
    return call([path, "--version"]).stdout.partition(",")[0].strip()


def run_member(case: Case, stem: pathlib.Path, gfb: str | os.PathLike[str] | None,
               tell: Callable[[str], None] = warn) -> tuple[int, dict[str, Any], dict[str, str]]:
    """Status, summary and units of a member that is not there yet; raises what is wrong with it."""
    if others := older_programs(case, stem, gfb):
        tell(f"{stem.name}: there is a result of {', '.join(others)}; it is computed again by {program_words(gfb)}")
    if not run(case, stem.parent, stem.name, gfb=gfb).converged:
        return NOT_CONVERGED, {}, {}
    return DONE, *read_summary(stem.with_name(stem.name + ENDINGS[DONE]))


def reason_of(stem: pathlib.Path) -> str:
    """Why a member has no answer, in the program's words."""
    summary, _ = read_summary(stem.with_name(stem.name + ENDINGS[NOT_CONVERGED]))
    return ": ".join(str(summary[name]) for name in ("outcome", "reason") if name in summary)


def table(values: Mapping[str, Sequence[Any]], found: Sequence[tuple[int, dict[str, Any], dict[str, str]]]) -> xarray.Dataset:
    """The dataset of a study."""
    shape = tuple(map(len, values.values()))
    dims = tuple(values)
    names = [name for _, summary, _ in found for name, value in summary.items() if isinstance(value, float)]
    variables = {"status": (dims, numpy.reshape([status for status, _, _ in found], shape))}
    for name in dict.fromkeys(names):
        unit = next(units[name] for _, summary, units in found if name in summary)
        numbers = [summary.get(name, numpy.nan) for _, summary, _ in found]
        variables[name] = (dims, numpy.reshape(numbers, shape), {"units": unit})
    return xarray.Dataset(variables, coords={key: list(items) for key, items in values.items()})
