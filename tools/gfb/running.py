"""`gfb.run`: the program run on a case, and what that leaves behind."""

from __future__ import annotations

import dataclasses
import functools
import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union, overload

import numpy

from gfb.case import Case
from gfb.namelist import CaseError
from gfb.program import DONE, MACHINE_FAILED, NOT_CONVERGED, WRONG_INPUT, Called, PathLike, call, command_of, find_program, stem_of
from gfb.results import COST, read_film, read_history, read_petsc_log, read_summary
from gfb.tool import RunError, stop, without

if TYPE_CHECKING:
    import xarray

    from gfb.result_names import NumberName, TextName

SAID = 2000  # letters of the end of what a run that failed has said


@dataclasses.dataclass(repr=False, eq=False)
class Result:
    """What a run left behind: `result["minimum_gap"]` of its summary, `result.data` and `result.film` as `gfb.read` gives them."""

    status: int                # of the program: 0 an answer, 2 none
    log: str                   # its standard output
    complaint: str             # its standard error
    stem: pathlib.Path         # of the result files, without ending
    summary: dict[str, Any]    # name: number, or words
    units: dict[str, str]      # name: unit
    wall: float = 0.0          # of the whole process [s]
    cpu: float = 0.0           # user and system time [s]

    @overload
    def __getitem__(self, name: NumberName) -> float: ...
    @overload
    def __getitem__(self, name: TextName) -> str: ...
    @overload
    def __getitem__(self, name: str) -> Union[float, str]: ...

    def __getitem__(self, name: str) -> Any:
        return self.summary[name]

    def __repr__(self) -> str:
        ended = f"{len(self.summary)} results" if self.converged else self.reason or f"status {self.status}"
        return f"<gfb.Result {self.stem}: {ended}>"

    @property
    def converged(self) -> bool:
        """Whether an answer was found."""
        return self.status == DONE

    @property
    def reason(self) -> str:
        """Why there is no answer, in the program's words; empty where there is one."""
        words = ": ".join(str(self.summary[name]) for name in ("outcome", "reason") if name in self.summary)
        return "" if self.converged else words or self.complaint.strip()

    @functools.cached_property
    def data(self) -> xarray.Dataset:
        """The case's result file, as `gfb.read` gives it; read once."""
        return dataset(f"{self.stem}.h5")

    @functools.cached_property
    def film(self) -> xarray.Dataset:
        """The film's fields, as `gfb.read` gives them; read once."""
        return dataset(f"{self.stem}.film.vtkhdf")

    @property
    def force(self) -> numpy.ndarray:
        """Of the film, and of solid contact, on the sleeve: x and y [N]."""
        return self.vector("force")

    @property
    def torque(self) -> numpy.ndarray:
        """Of the film, and of solid contact, on the shaft: about x and y [N m]."""
        return self.vector("torque")

    @property
    def eccentricity(self) -> numpy.ndarray:
        """Of the sleeve relative to the shaft: x and y [m]."""
        return self.vector("eccentricity")

    def vector(self, name: str) -> numpy.ndarray:
        """The components of a vector in the summary."""
        return numpy.array([self.summary[f"{name}_x"], self.summary[f"{name}_y"]])

    def physical(self) -> dict[str, float]:
        """Numbers of the summary without those of the cost."""
        return {name: value for name, value in self.summary.items() if name not in COST and isinstance(value, float)}

    def history(self) -> dict[str, numpy.ndarray]:
        """The columns of the history; without xarray."""
        return read_history(f"{self.stem}.h5")

    def film_arrays(self) -> dict[str, numpy.ndarray]:
        """The film's fields on (station, row); without xarray."""
        return read_film(f"{self.stem}.film.vtkhdf")


def dataset(path: str) -> xarray.Dataset:
    """A result file as a dataset; ImportError, in words, where xarray is missing."""
    try:
        from gfb.reading import read  # needs xarray, without which a case can be run
    except ModuleNotFoundError as error:
        raise without("gfb.Result", error) from None
    return read(path)


def run(case: Case | PathLike, folder: PathLike = "results", name: str = "case", ranks: int = 1, options: Sequence[str] = (),
        gfb: PathLike | None = None) -> Result:
    """Runs a Case, which gets the name, or a case file. No answer is a Result that has not converged; raises CaseError
    where the case is wrong, and RunError where a file or the machine failed."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    path = case.write(folder/f"{name}.nml") if isinstance(case, Case) else pathlib.Path(case)
    result = run_file(find_program(gfb), path, folder, ranks, options)
    if result.status == WRONG_INPUT:
        raise CaseError(result.complaint.strip())
    if result.status not in (DONE, NOT_CONVERGED):
        raise RunError(f"status {result.status}: {(result.complaint or result.log).strip()[-SAID:]}", result.status)
    return result


# --- for the tools and tests of a checkout: whatever the status ---

def write_case(folder: PathLike, name: str, groups: Mapping[str, Mapping[str, Any] | None]) -> pathlib.Path:
    """Writes a case file, {group: {key: value}}, into a folder; its path."""
    return Case(groups).write(pathlib.Path(folder)/f"{name}.nml")


def run_file(gfb: PathLike, path: PathLike, folder: PathLike, ranks: int = 1, options: Sequence[str] = (), petsc: Sequence[str] = (),
             seconds: float | None = None, environment: Mapping[str, str] | None = None) -> Result:
    """Runs a case file; what it left behind, however the run ended."""
    done = call(command_of(gfb, path, folder, ranks, options, petsc), seconds, environment)
    return result_of(done, stem_of(path, folder, options, done.status))


def result_of(done: Called, stem: pathlib.Path) -> Result:
    """What a call of the program left behind."""
    has_answer = done.status in (DONE, NOT_CONVERGED) and os.path.exists(f"{stem}.summary")
    values, units = read_summary(f"{stem}.summary") if has_answer else ({}, {})
    return Result(done.status, done.log, done.complaint, stem, values, units, done.wall, done.cpu)


def run_case(gfb: PathLike, groups: Mapping[str, Mapping[str, Any] | None], folder: PathLike, name: str, petsc: Sequence[str] = (),
             may_stop: bool = False) -> Result:
    """Writes a case file and runs it on one rank; ends the tool where it does not converge, unless it may."""
    path = write_case(folder, name, groups)
    result = run_file(gfb, path, folder, options=("--quiet",), petsc=petsc)
    if result.status not in ((DONE, NOT_CONVERGED) if may_stop else (DONE,)):
        stop(f"{path}: gfb ended with status {result.status}:\n{result.log}{result.complaint}", MACHINE_FAILED)
    return result


def run_logged(gfb: PathLike, groups: Mapping[str, Mapping[str, Any] | None], folder: PathLike, name: str,
               may_stop: bool = False) -> tuple[Result, dict[str, dict[str, tuple[float, float]]]]:
    """The same, and PETSc's log of the run: {stage: {event: (calls, seconds)}}."""
    log = pathlib.Path(folder)/"log.csv"
    result = run_case(gfb, groups, folder, name, petsc=("-log_view", f":{log}:ascii_csv"), may_stop=may_stop)
    return result, read_petsc_log(log)


def start_time(gfb: PathLike, repetitions: int = 3) -> float:
    """CPU time of a call that computes nothing, the smallest of a few [s]."""
    return min(call([gfb, "--version"]).cpu for _ in range(repetitions))
