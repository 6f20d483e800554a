"""Members of a study: cases that are run once, and found again by another call where this program has computed them to their end."""

from __future__ import annotations

import pathlib
import signal
import tempfile
import warnings
from collections.abc import Callable, Iterator, Sequence

import h5py

from gfb.case import Case
from gfb.program import DONE, NOT_CONVERGED, OUT_OF_TIME, PathLike, call, find_program, words_of
from gfb.results import Unreadable, open_results, read_summary, reading, text_of
from gfb.running import Result, run
from gfb.tool import RunError

MEMBER_NAME = "{study}_{number:04d}"
ENDINGS = {DONE: "", NOT_CONVERGED: ".unconverged"}  # of a stem, by the status
BATCH = 50  # members that one call of the program computes: what is lost of them where it is killed is the one it is at
AGAIN = ("stopped", "out_of_time", "failed")  # how runs end of which another call may find the answer


def warn(words: str) -> None:
    """A warning of the call of the user."""
    warnings.warn(words, stacklevel=3)


def run_members(cases: Sequence[Case], stems: Sequence[pathlib.Path], gfb: PathLike | None) -> None:
    """Runs members one after another in one call of the program, which starts once for all; what it leaves out is missing.
    A member alone is none of several. Raises RunError where it is stopped: those that it has not reached are left to another call."""
    if len(cases) < 2:
        return
    paths = [one.write(f"{stem}.nml") for one, stem in zip(cases, stems)]
    side = f"{stems[0].name}.batch"
    done = call([find_program(gfb), "--quiet", "--groups", "1", "--name", side, "--output", stems[0].parent, "--", *paths])
    for ending in (".h5", ".summary"):
        stems[0].with_name(side + ending).unlink(missing_ok=True)
    if done.status >= OUT_OF_TIME or -done.status in (signal.SIGINT, signal.SIGTERM):
        raise RunError(f"status {done.status}: the program was stopped; what has its answer stays, another call computes the rest", done.status)


def check_all(cases: Sequence[Case], gfb: PathLike | None) -> None:
    """One call of the program for all; the first case that is wrong raises CaseError."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [one.write(pathlib.Path(folder)/f"{number}.nml") for number, one in enumerate(cases)]
        right = all(call([find_program(gfb), "--check", "--groups", "1", "--", *paths[first:first + BATCH]]).status == DONE
                    for first in range(0, len(paths), BATCH))
    for one in [] if right else cases:
        one.check(gfb=gfb)


def kept_results(case: Case, stem: pathlib.Path) -> Iterator[tuple[str, Result]]:
    """Program, with version and commit, and result of what lies there of this very case, by what the files themselves say; damaged ones
    are none, nor those that another call may find the answer of."""
    for status, ending in ENDINGS.items():
        one = stem.with_name(stem.name + ending)
        try:
            with reading(f"{one}.h5"), open_results(f"{one}.h5") as file:
                if not is_of(file, case, stem.name):
                    continue
                version, commit = (text_of(file[f"provenance/{name}"][()]) for name in ("program_version", "commit"))
            summary, units = read_summary(f"{one}.summary")
        except (Unreadable, FileNotFoundError):
            continue
        if summary.get("outcome") not in AGAIN:
            yield f"gfb {version} ({commit})", Result(status, "", "", one, summary, units)


def is_of(file: h5py.File, case: Case, stem: str) -> bool:
    """Whether an open result is of this very case, and a machine's of these very bearings."""
    there = file["scene"]
    texts = case.bearing_texts()
    return text_of(there["case_file"][()]) == case.text(stem) and \
        [f"bearing_{number}" in there and text_of(there[f"bearing_{number}"][()]) for number in range(1, len(texts) + 1)] == list(texts)


def find_member(case: Case, stem: pathlib.Path, gfb: PathLike | None) -> Result | None:
    """A member that this program has computed to its end; None where that is not there."""
    own = words_of(find_program(gfb))
    return next((result for program, result in kept_results(case, stem) if program == own), None)


def older_programs(case: Case, stem: pathlib.Path, gfb: PathLike | None) -> list[str]:
    """Programs of other versions whose results of a member lie there."""
    own = words_of(find_program(gfb))
    return [program for program, _ in kept_results(case, stem) if program != own]


def run_member(case: Case, stem: pathlib.Path, gfb: PathLike | None, tell: Callable[[str], None] = warn) -> Result:
    """A member that is not there yet; raises what is wrong with it."""
    if others := older_programs(case, stem, gfb):
        tell(f"{stem.name}: there is a result of {', '.join(others)}; it is computed again by {words_of(find_program(gfb))}")
    return run(case, stem.parent, stem.name, gfb=gfb)
