"""Lists of a case as a table: a row for each segment of a shaft, each disc, bearing, load or unbalance; pure, without the page."""

from __future__ import annotations

from typing import Any

Values = dict[str, Any]
# Groups whose keys are lists of one thing each, and the key that says how many there are.
COUNTED = {"shaft": "lengths", "discs": "positions", "bearings": "files", "loads": "positions", "unbalance": "positions"}
MOST_ROWS = 100  # that are shown


def columns_of(group: str, keys: dict[str, Any]) -> list[str]:
    """The keys of a group that are columns of its table, that which counts first."""
    if group not in COUNTED:
        return []
    return [COUNTED[group], *(name for name, key in keys.items() if name != COUNTED[group] and key.kind.startswith("list"))]


def shown_columns(group: str, keys: dict[str, Any], values: Values) -> list[str]:
    """Those that the table has: given ones, and such as must be; none where nothing is counted."""
    if group not in COUNTED or row_count(group, values) == 0:
        return []
    return [name for name in columns_of(group, keys) if name in values or keys[name].default in ("", "``")]


def listed(value: Any) -> list[Any]:
    """The values of a key, none where it is not given."""
    return [] if value is None else list(value) if isinstance(value, (tuple, list)) else [value]


def row_count(group: str, values: Values) -> int:
    """How many rows there are."""
    return min(len(listed(values.get(COUNTED[group]))), MOST_ROWS)


def cell(values: Values, group: str, name: str, row: int) -> tuple[Any, bool]:
    """The value of a cell, None where the key is not given, and whether it stands there for all rows."""
    there = listed(values.get(name))
    if not there:
        return None, False
    if len(there) == 1 and row_count(group, values) > 1:
        return there[0], True
    return (there[row] if row < len(there) else None), False


def joined(values: list[Any]) -> Any:
    """A value of a key: alone, or several; None where there is none."""
    return None if not values else values[0] if len(values) == 1 else tuple(values)


def with_cell(values: Values, group: str, name: str, row: int, value: Any) -> Any:
    """The key's new value where a cell has another one; an empty cell in a column that has no other value takes the key out."""
    there, rows = listed(values.get(name)), row_count(group, values)
    if value is None:
        return None if name != COUNTED[group] and len(there) <= 1 else joined(there)
    if not there and rows > 1:
        return value  # one for all
    if len(there) == 1 and rows > 1:
        if row == 0:
            return value
        there = there*rows
    there += [value]*(row + 1 - len(there))
    there[row] = value
    return joined(there)


def with_row(values: Values, group: str, keys: list[str]) -> Values:
    """{key: new value} of the keys that change where a row like the last one is put behind it; a value that stands for all stays alone."""
    rows = row_count(group, values)
    changed = {}
    for name in keys:
        there = listed(values.get(name))
        if name == COUNTED[group] or len(there) == rows > 1:
            changed[name] = joined([*there, there[-1]])
    return changed


def without_row(values: Values, group: str, keys: list[str], row: int) -> Values:
    """{key: new value} of the keys that change where a row goes; the last one stays."""
    rows = row_count(group, values)
    if rows < 2:
        return {}
    return {name: joined([value for i, value in enumerate(listed(values.get(name))) if i != row])
            for name in keys if len(listed(values.get(name))) == rows}
