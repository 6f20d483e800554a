"""`gfb.Case`: a case file as Python values, checked by the program itself."""

from __future__ import annotations

import copy
import os
import pathlib
import re
import shutil
import subprocess
import sysconfig
from collections.abc import Iterator, Mapping, Sequence
from typing import Union

from gfb.files import read_text
from gfb.namelist import namelist_value
from gfb.tool import ROOT

Value = Union[str, bool, int, float, Sequence[float], Sequence[str]]
TOKENS = re.compile(r"'(?:[^']|'')*'|\"(?:[^\"]|\"\")*\"|![^\n]*|[&/=,]|[^\s&/=,!'\"]+")

MOST_VALUES = 1_000_000  # of all keys; the program takes 10,000 of one
SHOWN = 40               # letters of a word that is wrong


class CaseError(ValueError):
    """A case file that is wrong; its text is the program's: file, line, group, key, rule."""


def program(given: str | os.PathLike[str] | None = None) -> str:
    """The program: the one given, that of the environment variable GFB, one on the path, that of a wheel beside this Python,
    or that of this checkout."""
    for name in (given, os.environ.get("GFB"), "gfb", os.path.join(sysconfig.get_path("scripts"), "gfb"), ROOT/"build/release/gfb"):
        found = shutil.which(name) if name else None
        if found:
            return os.path.abspath(found)
    raise FileNotFoundError("gfb is not found: install it, set GFB, or call tools/run once")


def launcher(path: str) -> str:
    """What starts several ranks of a program: what the environment variable GFB_MPIEXEC names, that of its wheel, or mpiexec."""
    return os.environ.get("GFB_MPIEXEC") or shutil.which(str(pathlib.Path(path).resolve().with_name("gfb-mpiexec"))) or "mpiexec"


class Case:
    """Groups of keys, as the case file has them: `case["bearing%radius"] = 19.05e-3`.

    `Case.template("equilibrium")` has working values, `Case.read(path)` those of a file. `str(case)` is the file."""

    def __init__(self, groups: Mapping[str, Mapping[str, Value]] | None = None) -> None:
        self.groups: dict[str, dict[str, Value]] = {name: dict(keys) for name, keys in (groups or {}).items()}

    @classmethod
    def template(cls, analysis: str, gfb: str | os.PathLike[str] | None = None) -> Case:
        """The required keys of an analysis with working values."""
        done = subprocess.run([program(gfb), "--template", analysis], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise CaseError(done.stderr.strip())
        return cls.parse(done.stdout)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Case:
        """A case file."""
        return cls.parse(read_text(path))

    @classmethod
    def parse(cls, text: str) -> Case:
        """The text of a case file. What is wrong in it is told by `check`; what is no value of a namelist is a CaseError."""
        case, group, key, found = cls(), "", "", 0
        lists: dict[tuple[str, str], list[Value]] = {}
        words = [word for word in TOKENS.findall(text) if not word.startswith("!")]
        for i, word in enumerate(words):
            following = words[i + 1] if i + 1 < len(words) else ""
            if i > 0 and words[i - 1] == "&":
                group, key = word.lower(), ""
                case.groups.setdefault(group, {})
            elif word == "/":
                group, key = "", ""
            elif group and following == "=":
                key = word.lower()
                case.groups[group][key] = ()
                lists[group, key] = []
            elif group and key and word not in "&=,":
                times, value = python_value(word)
                found += times
                if found > MOST_VALUES:
                    raise CaseError(f"&{group}: {key}: more than {MOST_VALUES:,} values in one case")
                lists[group, key] += times*[value]
        for (group, key), values in lists.items():
            case.groups[group][key] = values[0] if len(values) == 1 else tuple(values)  # type: ignore[assignment]
        return case

    def is_thrust(self) -> bool:
        """Whether the bearing is a thrust bearing."""
        return self.groups.get("bearing", {}).get("kind") == "thrust"

    def copy(self) -> Case:
        """Another case with the same keys."""
        return copy.deepcopy(self)

    def __getitem__(self, name: str) -> Value:
        group, key = split(name)
        return self.groups[group][key]

    def __setitem__(self, name: str, value: Value) -> None:
        group, key = split(name)
        self.groups.setdefault(group, {})[key] = value

    def __delitem__(self, name: str) -> None:
        group, key = split(name)
        del self.groups[group][key]

    def __contains__(self, name: str) -> bool:
        group, key = split(name)
        return key in self.groups.get(group, {})

    def __iter__(self) -> Iterator[str]:
        return (f"{group}%{key}" for group, keys in self.groups.items() for key in keys)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Case) and str(self) == str(other)

    def __str__(self) -> str:
        return "".join(f"&{group}\n" + "".join(f"  {key} = {namelist_value(value)}\n" for key, value in keys.items()) + "/\n"
                       for group, keys in self.groups.items())

    def write(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """Writes the case file."""
        path = pathlib.Path(path)
        path.write_text(str(self), encoding="utf-8")
        return path

    def check(self, strict: bool = False, gfb: str | os.PathLike[str] | None = None) -> str:
        """What the scene needs, as `gfb --check` says; raises CaseError with all mistakes. strict: warnings are mistakes."""
        done = subprocess.run([program(gfb), "--check", *(["--strict"] if strict else []), "-"], input=str(self),
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise CaseError(done.stderr.strip() or done.stdout.strip())
        return done.stdout


def split(name: str) -> tuple[str, str]:
    """Group and key of `group%key`."""
    group, mark, key = name.partition("%")
    if not (group and mark and key):
        raise KeyError(f"{name}: a key is named 'group%key', such as 'bearing%radius'")
    return group.lower(), key.lower()


def python_value(word: str) -> tuple[int, Value]:
    """A value of a case file, and how often it stands there (3*1.0)."""
    repeat = re.fullmatch(r"(\d{1,9})\*(.+)", word, re.DOTALL)
    times, word = (int(repeat[1]), repeat[2]) if repeat else (1, word)
    if word[0] in "'\"":
        return times, word[1:-1].replace(word[0]*2, word[0])
    if word.lower().strip(".") in ("true", "t", "false", "f"):
        return times, word.lower().strip(".").startswith("t")
    try:
        return times, int(word) if re.fullmatch(r"[+-]?\d+", word) else float(re.sub("[dD]", "e", word))
    except ValueError:
        raise CaseError(f"'{word[:SHOWN]}' is no value of a namelist") from None
