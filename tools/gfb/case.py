"""`gfb.Case`: a case file as Python values, checked by the program itself."""

from __future__ import annotations

import copy
import os
import pathlib
from collections.abc import Iterable, Iterator, Mapping, MutableMapping
from typing import Any

from gfb.files import read_text
from gfb.namelist import CaseError, case_text, groups_of, namelist_value
from gfb.program import DONE, PathLike, call, find_program


class Case(MutableMapping[str, Any]):
    """A case file as a mapping: `case["bearing%radius"] = 19.05e-3`, of numbers in SI units, words, truth values, and sequences of them.

    `Case.template("equilibrium")` has working values, `Case.read(path)` those of a file, `Case({"bearing": {"radius": 19.05e-3}})` those
    given; what is None there is left out. `str(case)` is the file. A group stays when its last key is deleted; `del case.groups["sweep"]`
    takes it out. Two cases are equal that have the same groups, keys and values, in whatever order."""

    __slots__ = ("groups",)
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, groups: Mapping[str, Mapping[str, Any] | None] | None = None) -> None:
        self.groups: dict[str, dict[str, Any]] = {
            name.lower(): {key.lower(): value for key, value in keys.items() if value is not None}
            for name, keys in (groups or {}).items() if keys is not None}

    @classmethod
    def template(cls, analysis: str, gfb: PathLike | None = None) -> Case:
        """The required keys of an analysis with working values."""
        done = call([find_program(gfb), "--template", analysis])
        if done.status != DONE:
            raise CaseError(done.complaint.strip())
        return cls.parse(done.log)

    @classmethod
    def read(cls, path: PathLike) -> Case:
        """A case file. Those of a machine's bearings are named by their whole paths then: the case may be run in any folder."""
        case = cls.parse(read_text(path))
        if "bearings%files" in case:
            folder = pathlib.Path(path).resolve().parent
            case["bearings%files"] = tuple(str(folder/file) for file in case.listed("bearings%files"))
        return case

    @classmethod
    def parse(cls, text: str) -> Case:
        """The text of a case file. What is wrong in it is found by `check`; what is no value of a namelist is a CaseError."""
        return cls(groups_of(text))

    def is_thrust(self) -> bool:
        """Whether the bearing is a thrust bearing."""
        return self.get("bearing%kind") == "thrust"

    def listed(self, name: str) -> tuple[Any, ...]:
        """The values of a key that may have several."""
        value = self[name]
        return tuple(value) if isinstance(value, Iterable) and not isinstance(value, str) else (value,)

    def copy(self) -> Case:
        """Another case with the same keys."""
        return copy.deepcopy(self)

    def __getitem__(self, name: str) -> Any:
        group, key = split(name)
        try:
            return self.groups[group][key]
        except KeyError:
            raise KeyError(name) from None

    def __setitem__(self, name: str, value: Any) -> None:
        group, key = split(name)
        self.groups.setdefault(group, {})[key] = value

    def __delitem__(self, name: str) -> None:
        if name not in self:
            raise KeyError(name)
        group, key = split(name)
        del self.groups[group][key]

    def __contains__(self, name: object) -> bool:
        group, _, key = name.lower().partition("%") if isinstance(name, str) else ("", "", "")
        return key in self.groups.get(group, {})

    def __iter__(self) -> Iterator[str]:
        return (f"{group}%{key}" for group, keys in self.groups.items() for key in keys)

    def __len__(self) -> int:
        return sum(map(len, self.groups.values()))

    def clear(self) -> None:
        """Takes all groups out."""
        self.groups.clear()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Case):
            return NotImplemented
        return self.groups.keys() == other.groups.keys() and \
            {key: namelist_value(value) for key, value in self.items()} == {key: namelist_value(value) for key, value in other.items()}

    def __repr__(self) -> str:
        counts = [f"{number} {word}{'s'*(number != 1)}" for number, word in ((len(self.groups), "group"), (len(self), "key"))]
        return f"<gfb.Case {self.get('scene%analysis', 'without an analysis')}: {', '.join(counts)}>"

    def __str__(self) -> str:
        return case_text(self.groups)

    def write(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """Writes the case file."""
        path = pathlib.Path(path)
        path.write_text(str(self), encoding="utf-8")
        return path

    def check(self, strict: bool = False, gfb: PathLike | None = None) -> str:
        """What the scene needs, as `gfb --check` says; raises CaseError with all mistakes. strict: warnings are mistakes."""
        done = call([find_program(gfb), "--check", *(["--strict"] if strict else []), "-"], text=str(self))
        if done.status != DONE:
            raise CaseError(done.complaint.strip() or done.log.strip())
        return done.log


def split(name: str) -> tuple[str, str]:
    """Group and key of `group%key`."""
    group, _, key = name.lower().partition("%") if isinstance(name, str) else ("", "", "")
    if not (group and key):
        raise KeyError(f"{name}: a key is named 'group%key', such as 'bearing%radius'")
    return group, key
