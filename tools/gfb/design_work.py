"""How the parts of a study are run: in which order, what is said of each, how long one may take, and what is kept where it is stopped."""

from __future__ import annotations

import concurrent.futures
import contextlib
import dataclasses
import pathlib
import re
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from gfb.case import Case, CaseError
from gfb.members import ENDINGS, find_member, older_programs
from gfb.program import MACHINE_FAILED, NOT_CONVERGED, OUT_OF_TIME, PathLike, find_program, words_of
from gfb.results import read_summary
from gfb.running import Result, run
from gfb.tool import RunError

PAUSE = 10.0  # s between lines while parts compute
# What costs minutes is last: first parts with a known number of states, then searches, a tilt with its unknowns, and time.
ORDER = ("point", "tolerances", "directions", "campbell", "whirl", "lift_off", "capacity", "misalignment", "orbit")
TILT_FACTORIZATIONS = (60, 800)  # of a misalignment on shells, as those of docs/manual/design.md took


@dataclasses.dataclass
class Part:
    """One part of the study."""

    name: str                 # of its files
    question: str
    case: Case | None = None
    left_out: str = ""        # why there is no case, or no answer
    stem: pathlib.Path | None = None  # of its results, where there are any
    states: int = 0           # that it computes; 0: that shows on the way
    work: str = ""            # what it does
    goes_on: bool = False     # from where another call was stopped
    stopped: str = ""         # by what, where it was before its end


class Progress:
    """Says when a part begins, with what it does and how long that may take, when it ends, and in between what is at work."""

    def __init__(self, number: int, tell: Callable[[str], None], seconds: int = 0, pause: float = PAUSE) -> None:
        self.number, self.tell, self.seconds, self.pause = number, tell, seconds, pause
        self.begun, self.at_work = 0, dict[str, float]()  # question: when it began
        self.takes: dict[str, float] = {}                  # question: about how long, where that is known [s]
        # Of parts of this call that have ended, and whose number of states is known: [states, seconds], of the whole and of a bearing of it alone.
        self.taken = {False: [0, 0.0], True: [0, 0.0]}
        self.hints: dict[str, str] = {}                    # of a part's time, by its name
        self.lock = threading.Lock()

    def begin(self, part: Part) -> None:
        """The line before a part."""
        with self.lock:
            self.begun += 1
            self.at_work[part.question] = time.monotonic()
            if part.states and self.each(part) and not part.goes_on:
                self.takes[part.question] = part.states*self.each(part)
            limit = f"; its limit is {duration(self.seconds)}" if self.seconds else ""
            self.tell(f"{self.begun} of {self.number} begins: {part.question}: {part.work}; {self.expected(part)}{limit}")

    def each(self, part: Part) -> float:
        """What a state of such a part took so far [s]; 0 where that is not known."""
        states, spent = self.taken[is_alone(part.name)]
        return spent/max(1, states)

    def expected(self, part: Part) -> str:
        """The time of a part, from what states took in this call; nothing is made up where that says nothing."""
        if part.goes_on:
            return "it goes on where it was stopped, how long is not known"
        if part.name in self.hints:
            return self.hints[part.name]
        each = self.each(part)
        if not each:
            return "how long is not known yet"
        if part.states == 0:
            return f"how long is not known, for how many states it takes is found on the way; one took {duration(each)} so far"
        return f"about {duration(part.states*each)}, as one state took {duration(each)} so far"

    def so_far(self, question: str, spent: float) -> str:
        """How long a part is at work, of how long, or beyond what it was thought to take."""
        words, takes = f"{question} for {duration(spent)}", self.takes.get(question)
        if takes is None:
            return words
        return f"{words} of about {duration(takes)}" if spent <= takes else f"{words}, longer than the {duration(takes)} it was thought to take"

    def end(self, part: Part, words: str = "") -> None:
        """The line after a part."""
        with self.lock:
            took = time.monotonic() - self.at_work.pop(part.question)
            if part.states and not (words or part.goes_on):
                taken = self.taken[is_alone(part.name)]
                taken[0], taken[1] = taken[0] + part.states, taken[1] + took
            self.tell(f"{part.question}: {words or 'done'} after {duration(took)}")

    @contextlib.contextmanager
    def watching(self) -> Iterator[None]:
        """A line after every pause, meanwhile, of what is at work."""
        over = threading.Event()

        def watch() -> None:
            while not over.wait(self.pause):
                with self.lock:
                    now = time.monotonic()
                    if self.at_work:
                        self.tell("at work: " + ", ".join(self.so_far(question, now - began) for question, began in self.at_work.items()))

        watcher = threading.Thread(target=watch, daemon=True)
        watcher.start()
        try:
            yield
        finally:
            over.set()
            watcher.join()


def is_alone(name: str) -> bool:
    """Whether a part is of one bearing of a machine."""
    return re.search(r"_\d+$", name) is not None


def place_of(name: str) -> int:
    """The place of a part, whatever its bearing's number."""
    return ORDER.index(re.sub(r"_\d+$", "", name))


def duration(seconds: float) -> str:
    """Seconds, or minutes, for a reader."""
    return f"{seconds/60.0:.1f} min" if seconds >= 99.5 else f"{seconds:.2g} s"


def compute_all(parts: Sequence[Part], stem_of: Callable[[Part], pathlib.Path], processes: int, gfb: PathLike | None, progress: Progress,
                filled: Callable[[Part, Result | None, bool], object]) -> None:
    """Computes parts, several at a time; filled: called with each that has ended. Where one fails, or Ctrl-C ends the call, no other begins."""

    def compute(part: Part, case: Case) -> None:
        stem = stem_of(part)
        result = find_member(case, stem, gfb)
        new = result is None
        if result is None:
            part.goes_on = restart_file(stem).exists()
            progress.begin(part)
            try:
                result = computed(part, case, stem, gfb, progress)
            finally:
                if result is None:
                    progress.end(part, part.stopped or "stopped")
            if result is not None:
                progress.end(part, part.stopped or ("" if result.converged else "no answer"))
        else:
            with progress.lock:
                progress.begun += 1
                progress.tell(f"{progress.begun} of {progress.number} is there already: {part.question}")
        filled(part, result, new)

    pool = concurrent.futures.ThreadPoolExecutor(max_workers=max(1, processes))
    with progress.watching():
        try:
            todo = sorted(((part, part.case) for part in parts if part.case is not None), key=lambda both: place_of(both[0].name))
            for future in concurrent.futures.as_completed([pool.submit(compute, *both) for both in todo]):
                future.result()
        finally:
            pool.shutdown(cancel_futures=True)


def computed(part: Part, case: Case, stem: pathlib.Path, gfb: PathLike | None, progress: Progress) -> Result | None:
    """The result of a part, which goes on from where another call was stopped; of one that its limit has stopped what it has, if that is anything."""
    if others := older_programs(case, stem, gfb):
        progress.tell(f"{stem.name}: there is a result of {', '.join(others)}; it is computed again by {words_of(find_program(gfb))}")
    limit, began = ["--time-limit", str(progress.seconds)] if progress.seconds else [], time.time()
    try:
        if restart_file(stem).exists():
            try:
                return run(case, stem.parent, stem.name, options=[*limit, "--restart"], gfb=gfb)
            except CaseError:
                pass  # of another case or program: from the beginning
            except RunError as error:
                if error.status != MACHINE_FAILED:
                    raise
        return run(case, stem.parent, stem.name, options=limit, gfb=gfb)
    except RunError as error:
        if error.status != OUT_OF_TIME:
            raise
        part.stopped = f"stopped by its limit of {duration(progress.seconds)}"
        return last_state(stem, began)


def restart_file(stem: pathlib.Path) -> pathlib.Path:
    """What a run that was stopped leaves for the next one."""
    return stem.with_name(f"{stem.name}.restart.h5")


def last_state(stem: pathlib.Path, began: float) -> Result | None:
    """What a run that began then and was stopped has left; None where that is nothing."""
    one = stem.with_name(stem.name + ENDINGS[NOT_CONVERGED])
    written = [pathlib.Path(f"{one}.{ending}") for ending in ("h5", "summary")]
    if not all(path.exists() and path.stat().st_mtime >= began for path in written):
        return None
    return Result(OUT_OF_TIME, "", "", one, *read_summary(written[1]))


def tilt_words(case: Case, point: dict[str, Any]) -> str:
    """How long a misalignment on shells may take, by the operating point's time a factorization: a tilt takes the whole width of a
    journal, and all pads of a thrust bearing instead of one."""
    if case.groups.get("model", {}).get("foil") != "shell" or not point["factorizations"]:
        return ""
    larger = int(case["pads%count"]) if case.is_thrust() else 2
    least, most = (number*larger*point["wall_time"]/point["factorizations"]/60.0 for number in TILT_FACTORIZATIONS)
    return (f"shells under a tilt, {larger} times the unknowns and {TILT_FACTORIZATIONS[0]} to {TILT_FACTORIZATIONS[1]} factorizations: "
            f"{least:.2g} to {most:.2g} min where nothing else runs")
