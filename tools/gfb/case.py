"""`gfb.Case`: a case file as Python values, checked by the program itself."""

from __future__ import annotations

import copy
import os
import pathlib
import re
import tempfile
from collections.abc import Iterable, Iterator, Mapping, MutableMapping
from typing import Any

from gfb.bearing_files import NAME
from gfb.files import read_text
from gfb.namelist import CaseError, case_text, groups_of, namelist_value
from gfb.program import DONE, PathLike, call, find_program


BEARING = re.compile(r"bearing_(\d{1,4})")  # of a machine, as a key's group
FILES = "bearings%files"


class Case(MutableMapping[str, Any]):
    """A case file as a mapping: `case["bearing%radius"] = 19.05e-3`, of numbers in SI units, words, truth values, and sequences of them.

    `Case.template("equilibrium")` has working values, `Case.read(path)` those of a file, `Case({"bearing": {"radius": 19.05e-3}})` those
    given; what is None there is left out. `str(case)` is the file. A group stays when its last key is deleted; `del case.groups["sweep"]`
    takes it out. Two cases are equal that have the same groups, keys and values, in whatever order.

    Of a machine `case["bearings%files"]` has the names of its bearings' files, or cases, which are written beside it as
    `<case>.bearing_<n>.nml`; `case["bearing_1%bearing%clearance"]` is a key of the first one."""

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
        case = cls.parse(done.log)
        if FILES in case:  # that of an equilibrium fits
            case[FILES] = tuple(cls.template("equilibrium", gfb) for _ in case.listed(FILES))
        return case

    @classmethod
    def read(cls, path: PathLike) -> Case:
        """A case file. Those of a machine's bearings are named by their whole paths then: the case may be run in any folder."""
        case = cls.parse(read_text(path))
        if FILES in case:
            folder = pathlib.Path(path).resolve().parent
            case[FILES] = tuple(str(folder/file) for file in case.listed(FILES))
        return case

    @classmethod
    def parse(cls, text: str) -> Case:
        """The text of a case file. What is wrong in it is found by `check`; what is no value of a namelist is a CaseError."""
        return cls(groups_of(text))

    def is_thrust(self) -> bool:
        """Whether the bearing is a thrust bearing."""
        return self.get("bearing%kind") == "thrust"

    def bearing(self, number: int) -> Case:
        """The case of a machine's bearing, from 1 on, as it stands here or in its file."""
        files = self.listed(FILES)
        if not 1 <= number <= len(files):
            raise KeyError(f"bearing_{number}: the case has {len(files)}")
        one = files[number - 1]
        return one if isinstance(one, Case) else Case.read(one)

    def put_bearing(self, number: int, case: Case) -> None:
        """Another case for a machine's bearing."""
        self.bearing(number)
        files = list(self.listed(FILES))
        files[number - 1] = case
        self[FILES] = tuple(files)

    def listed(self, name: str) -> tuple[Any, ...]:
        """The values of a key that may have several."""
        value = self[name]
        return tuple(value) if isinstance(value, Iterable) and not isinstance(value, (str, Case)) else (value,)

    def copy(self) -> Case:
        """Another case with the same keys."""
        return copy.deepcopy(self)

    def __getitem__(self, name: str) -> Any:
        group, key = split(name)
        if number := bearing_number(group):
            return self.bearing(number)[key]
        try:
            return self.groups[group][key]
        except KeyError:
            raise KeyError(name) from None

    def __setitem__(self, name: str, value: Any) -> None:
        group, key = split(name)
        if number := bearing_number(group):
            one = self.bearing(number).copy()
            one[key] = value
            self.put_bearing(number, one)
            return
        self.groups.setdefault(group, {})[key] = value

    def __delitem__(self, name: str) -> None:
        if name not in self:
            raise KeyError(name)
        group, key = split(name)
        if number := bearing_number(group):
            one = self.bearing(number).copy()
            del one[key]
            return self.put_bearing(number, one)
        del self.groups[group][key]

    def __contains__(self, name: object) -> bool:
        group, _, key = name.lower().partition("%") if isinstance(name, str) else ("", "", "")
        if (number := bearing_number(group)) and FILES in self:
            return number <= len(self.listed(FILES)) and key in self.bearing(number)
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
            {key: compared(value) for key, value in self.items()} == {key: compared(value) for key, value in other.items()}

    def __repr__(self) -> str:
        counts = [f"{number} {word}{'s'*(number != 1)}" for number, word in ((len(self.groups), "group"), (len(self), "key"))]
        return f"<gfb.Case {self.get('scene%analysis', 'without an analysis')}: {', '.join(counts)}>"

    def __str__(self) -> str:
        return self.text()

    def text(self, stem: str = "case") -> str:
        """The case file as it is written as `<stem>.nml`."""
        if not self.holds_bearings():
            return case_text(self.groups)
        files = tuple(NAME.format(stem=stem, number=number) if isinstance(one, Case) else one for number, one in enumerate(self.listed(FILES), 1))
        return case_text(self.groups | {"bearings": self.groups["bearings"] | {"files": files}})

    def holds_bearings(self) -> bool:
        """Whether bearings of a machine are cases here, not names of files."""
        return FILES in self and any(isinstance(one, Case) for one in self.listed(FILES))

    def bearing_texts(self) -> tuple[str, ...]:
        """What the files of a machine's bearings hold."""
        return tuple(str(one) if isinstance(one, Case) else read_text(one) for one in (self.listed(FILES) if FILES in self else ()))

    def write(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """Writes the case file, and beside it those of the bearings that are cases here."""
        path = pathlib.Path(path)
        for number, one in enumerate(self.listed(FILES) if FILES in self else (), 1):
            if isinstance(one, Case):
                one.write(path.with_name(NAME.format(stem=path.stem, number=number)))
        path.write_text(self.text(path.stem), encoding="utf-8")
        return path

    def check(self, strict: bool = False, gfb: PathLike | None = None) -> str:
        """What the scene needs, as `gfb --check` says; raises CaseError with all mistakes. strict: warnings are mistakes."""
        command = [find_program(gfb), "--check", *(["--strict"] if strict else [])]
        if not self.holds_bearings():
            done = call([*command, "-"], text=str(self))
        else:
            with tempfile.TemporaryDirectory() as folder:
                done = call([*command, self.write(pathlib.Path(folder)/"case.nml").name], folder=folder)
        if done.status != DONE:
            raise CaseError(done.complaint.strip() or done.log.strip())
        return done.log


def bearing_number(group: str) -> int:
    """The number of a machine's bearing of which a key is; 0 where it is the case's own."""
    found = BEARING.fullmatch(group)
    return int(found[1]) if found else 0


def compared(value: Any) -> Any:
    """A value as it is compared with another."""
    if isinstance(value, Case):
        return str(value)
    if isinstance(value, (tuple, list)) and any(isinstance(one, Case) for one in value):
        return tuple(map(compared, value))
    return namelist_value(value)


def split(name: str) -> tuple[str, str]:
    """Group and key of `group%key`."""
    group, _, key = name.lower().partition("%") if isinstance(name, str) else ("", "", "")
    if not (group and key):
        raise KeyError(f"{name}: a key is named 'group%key', such as 'bearing%radius'")
    return group, key
