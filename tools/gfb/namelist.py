"""The text of a case file: its groups and values from a text, and a text from Python values."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Union

Value = Union[str, bool, int, float, Sequence[float], Sequence[str]]
Groups = dict[str, dict[str, Any]]
TOKENS = re.compile(r"(?:\d+\*)?'(?:[^']|'')*'|(?:\d+\*)?\"(?:[^\"]|\"\")*\"|![^\n]*|[&/=,]|[^\s&/=,!'\"]+")

MOST_VALUES = 1_000_000  # of all keys; the program takes 10,000 of one
DEFAULT = "(default)"    # how the comment of a value that the case does not give ends, in the program's echo of it
SHOWN = 40               # letters of a word that is wrong


class CaseError(ValueError):
    """A case file that is wrong; its text is the program's: file, line, group, key, rule."""


def namelist_value(value: Any) -> str:
    """A Python value, or one of NumPy, as a namelist writes it."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Sequence):
        return ", ".join(map(namelist_value, value))
    raise TypeError(f"{value!r} is no value of a case file: a number, a truth value, words, or a sequence of them")


def case_text(groups: Mapping[str, Mapping[str, Any]]) -> str:
    """A case file of {group: {key: value}}; numbers read back exactly."""
    return "".join(f"&{group}\n" + "".join(f"  {key} = {namelist_value(value)}\n" for key, value in keys.items()) + "/\n"
                   for group, keys in groups.items())


Part = tuple[str, str, str, "re.Match[str]", "re.Match[str]"]


def parts_of(text: str) -> Iterator[Part]:
    """What a case file consists of, in its order: a kind, which is `group`, `key`, `equals`, `value`, `end` of a group or `comment`, the
    group and the key to which it belongs, its own words, and the last ones before it that are no comment. What stands outside of
    groups, or is of no key, is left out."""
    words = list(TOKENS.finditer(text))
    solid = [word[0] for word in words if word[0][0] != "!"] + ["", ""]
    group = key = ""
    i, before = 0, None  # solid words so far, and the last of them
    for word in words:
        said = word[0]
        if said[0] == "!":
            yield "comment", group, key, word, before or word
            continue
        i += 1
        if before and before[0] == "&":
            group, key = said.lower(), ""
            yield "group", group, key, word, before
        elif said == "/":
            if group:
                yield "end", group, key, word, before or word
            group = key = ""
        elif group and solid[i] == "=":
            key = said.lower()
            yield "key", group, key, word, before or word
        elif group and key and said not in "&,":
            yield "equals" if said == "=" else "value", group, key, word, before or word
        before = word


def groups_of(text: str) -> dict[str, dict[str, Value]]:
    """{group: {key: value}} of a case file. Which groups and keys there can be is the program's to say; what is no value of a namelist is
    a CaseError."""
    groups: dict[str, dict[str, Value]] = {}
    lists: dict[tuple[str, str], list[Any]] = {}
    found = 0
    for kind, group, key, word, _ in parts_of(text):
        if kind == "group":
            groups.setdefault(group, {})
        elif kind == "key":
            groups[group][key] = ()
            lists[group, key] = []
        elif kind == "value":
            times, value = python_value(word[0])
            found += times
            if found > MOST_VALUES:
                raise CaseError(f"&{group}: {key}: more than {MOST_VALUES:,} values in one case")
            lists[group, key] += times*[value]
    for (group, key), values in lists.items():
        groups[group][key] = values[0] if len(values) == 1 else tuple(values)
    return groups


class Places:
    """Where groups and values stand in a text."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.values: dict[tuple[str, str], list[int]] = {}  # (group, key): where the key begins, where its value begins, where it ends
        self.groups: dict[str, list[int]] = {}              # group: where it begins, where its '/' stands
        self.defaults: set[tuple[str, str]] = set()         # whose comment says so, as in an echo
        for kind, group, key, word, before in parts_of(text):
            if kind == "group":
                self.groups[group] = [before.start(), len(text)]
            elif kind == "end":
                self.groups[group][1] = word.start()
            elif kind == "key":
                self.values[group, key] = [word.start(), word.end(), word.end()]
            elif kind == "equals" and before.start() == self.values[group, key][0]:
                self.values[group, key][1:] = [word.end(), word.end()]
            elif kind == "value":
                place = self.values[group, key]
                if before[0] == "=" and place[1] == before.end():
                    place[1] = word.start()
                place[2] = word.end()
            elif kind == "comment" and key and word[0].endswith(DEFAULT) and "\n" not in text[self.values[group, key][2]:word.start()]:
                self.defaults.add((group, key))

    def words(self, group: str, key: str) -> str:
        """A value as it is typed, in one line."""
        _, begin, end = self.values[group, key]
        return " ".join(line.strip() for line in self.text[begin:end].splitlines())


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
