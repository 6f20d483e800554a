"""The case files of bearings that the case of a machine names: found from the folder of the machine's file, and copied with it."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Iterator, Sequence

from gfb.files import read_text
from gfb.namelist import CaseError, namelist_value, parts_of, python_value

GROUP, KEY = "bearings", "files"
NAME = "{stem}.bearing_{number}.nml"  # of a copy, beside the machine's


def places_of(text: str) -> Iterator[tuple[int, int, tuple[str, ...]]]:
    """Where each value of `files` begins and ends in the text of a case, and the names that it stands for; what is no text is none."""
    for kind, group, key, word, _ in parts_of(text):
        if kind != "value" or (group, key) != (GROUP, KEY):
            continue
        try:
            times, value = python_value(word[0])
        except CaseError:
            continue
        if isinstance(value, str) and times < 1000:
            yield word.start(), word.end(), times*(value,)


def names_of(text: str) -> tuple[str, ...]:
    """The names of the files as they are typed, in the order of the bearings; empty where the case is of no machine."""
    return tuple(name for _, _, names in places_of(text) for name in names)


def renamed(text: str, names: Sequence[str]) -> str:
    """The text with other names of the files; all else stays, line for line."""
    left, pieces, end = list(names), [], 0
    for begin, behind, old in places_of(text):
        pieces += [text[end:begin], ", ".join(namelist_value(left.pop(0)) for _ in old)]
        end = behind
    return "".join(pieces) + text[end:]


def whole_names(text: str, folder: str | os.PathLike[str]) -> tuple[str, ...]:
    """The names as they are seen from everywhere, of a file in that folder."""
    return tuple(str(pathlib.Path(folder)/name) for name in names_of(text))


def with_whole_names(text: str, folder: str | os.PathLike[str]) -> str:
    """The text of a case in that folder as it may be run, or checked, in any other."""
    return renamed(text, whole_names(text, pathlib.Path(folder).resolve()))


def copied(text: str, folder: str | os.PathLike[str], stem: str) -> tuple[str, dict[str, str]]:
    """The text of a case in that folder as it is written elsewhere as `<stem>.nml`, and {name: text} of the files of its bearings, which are
    to be written beside it."""
    names = names_of(text)
    new = [NAME.format(stem=stem, number=number) for number in range(1, len(names) + 1)]
    return renamed(text, new), {one: read_text(name) for one, name in zip(new, whole_names(text, folder))}


def write_copy(text: str, folder: str | os.PathLike[str], path: str | os.PathLike[str]) -> pathlib.Path:
    """Writes the text of a case of that folder under another path, with the files of its bearings beside it."""
    path = pathlib.Path(path)
    text, files = copied(text, folder, path.stem)
    for name, content in files.items():
        path.with_name(name).write_text(content, encoding="utf-8")
    path.write_text(text, encoding="utf-8")
    return path
