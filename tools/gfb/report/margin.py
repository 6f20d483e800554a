"""One thing that may limit a bearing or a machine: how it is, against what, and whether that is kept."""

from __future__ import annotations

import dataclasses

NO_ANSWER, STOPPED = "no answer", "stopped"  # of a part of a study: there is none; it was stopped before
ONSET = "onset_speed_rpm"
SIGNS = {"kept": "✓ kept", "broken": "✗ broken", "unknown": "? no limit known", "missing": "✗ no answer",
         "stopped": "… stopped"}


@dataclasses.dataclass
class Margin:
    """One thing that may limit a bearing."""

    subject: str                   # in a word or two
    value: str                     # how it is, in words
    limit: str = ""                # against what, in words; empty where none is known
    factor: float | None = None    # how many times the limit is kept, below 1 broken; None: it is, or is not
    is_broken: bool = False
    where: str = ""                # part of a study
    result: str = ""               # its name, where it is one result that is compared
    body: str = "bearing"          # what it limits

    @property
    def state(self) -> str:
        """Which of SIGNS."""
        if self.limit in (NO_ANSWER, STOPPED):
            return "missing" if self.limit == NO_ANSWER else "stopped"
        return "broken" if self.is_broken else "kept" if self.limit else "unknown"

    @property
    def sign(self) -> str:
        """The state in words, which need no colour."""
        return SIGNS[self.state]

    @property
    def times(self) -> str:
        """The margin in words."""
        return f"{self.factor:.3g} times" if self.factor is not None else ""

    @property
    def against(self) -> str:
        """The limit and the margin in words."""
        return ": ".join(filter(None, (self.limit, self.times)))

    def words(self) -> str:
        """All of it."""
        needed = "" if self.factor is None else f": {self.factor:.3g} {'of' if self.is_broken else 'times'} what is needed"
        return f"{self.value}{f' ({self.where})' if self.where else ''}, {self.limit}{needed}"


def compared(subject: str, value: str, limit: str, factor: float, where: str = "", result: str = "") -> Margin:
    """What is kept by a factor of 1 and more."""
    return Margin(subject, value, limit, factor, not factor >= 1.0, where, result)
