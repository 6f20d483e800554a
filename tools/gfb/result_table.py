"""The names of results that `gfb --results` lists, as types: a type checker and an editor know them."""

import re

from gfb.program import table_rows

NAME = re.compile(r"`([^`]+)`")
TRUTH = "true/false"  # the unit of what a summary has as one of these words
HEAD = '''"""Names of results, written by tools/manual from gfb --results: of a number, and of words. Those that have a number, a key or another
name in them, such as minimum_gap_2, are not listed."""

from typing import Literal

'''


def names_module(printed):
    """The text of gfb/result_names.py."""
    numbers, words = names_of(printed)
    return HEAD + f"NumberName = {literal(numbers)}\n\nTextName = {literal(words)}\n"


def names_of(printed):
    """Names of numbers, and of words, each once and in the program's order; not those that stand for many."""
    found: dict[str, bool] = {}
    for cell, unit, *_ in table_rows(printed):
        names, units = NAME.findall(cell), unit.split(", ")
        for i, name in enumerate(names):
            if "<" not in name:
                found.setdefault(name, units[min(i, len(units) - 1)] in ("", TRUTH))
    return [name for name, is_text in found.items() if not is_text], [name for name, is_text in found.items() if is_text]


def literal(names):
    """A Literal of them, a line each."""
    return "Literal[\n" + "".join(f'    "{name}",\n' for name in names) + "]"
