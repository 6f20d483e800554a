"""The program's own table of keys, and their values as they are typed and read, with units."""

import dataclasses
import decimal
import re

from gfb import program
from gfb.case import Case, CaseError
from gfb.tables import ALSO_TYPED, readable_unit, units_of

WORD = re.compile(r"'([^']*)'")
QUANTITY = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?)(?:\s+([^,*]+)|([A-Za-z][^,*]*))?")
DIGITS = 12  # of a number in a field: a change of unit and back shows the number that was typed


@dataclasses.dataclass(frozen=True)
class Key(program.Key):
    """A row of `gfb --keys`, and its value in a field."""

    @property
    def choices(self):
        """The words of which one is the value; empty where it is no such key."""
        return ("true", "false") if self.kind == "logical" else tuple(WORD.findall(self.kind)) if re.fullmatch("`[^`]*`", self.kind) else ()

    @property
    def is_text(self):
        """Whether any words are a value."""
        return self.kind == "string" and self.default.startswith("`'")

    def shown(self, value):
        """A value as its field has it; empty where the case has none."""
        if value is None or value == ():
            return ""
        if isinstance(value, bool):
            return str(value).lower()
        if isinstance(value, str):
            return value
        values = value if isinstance(value, (tuple, list)) else (value,)
        return ", ".join(one if isinstance(one, str) else self.quantity(one) for one in values)

    def quantity(self, number):
        """A number in the first of its units in which it is not below 1, otherwise in that which is read."""
        if isinstance(number, bool):
            return str(number).lower()
        units = units_of(self.unit)
        unit = next((one for one, scale in units.items() if abs(number)*scale >= 1.0), readable_unit(self.unit)[0])
        words = f"{float(decimal.Decimal(repr(number))*decimal.Decimal(repr(units[unit]))):.{DIGITS}g}" if isinstance(number, float) else str(number)
        return words if unit in ("", "1") or number == 0 else f"{words} {unit}"

    def typed(self, words):
        """The value of a field's words; None where there are none. What is no value stays words, for the program to complain about."""
        words = words.strip()
        if not words:
            return None
        if self.kind == "logical":
            return {"true": True, "false": False}.get(words, words)
        if self.is_text or self.choices:
            return words
        parts = [self.number(one.strip()) for one in words.split(",")]
        if all(one is not None for one in parts):
            return parts[0] if len(parts) == 1 else tuple(parts)
        if self.kind.startswith("list") or "'" in words or "*" in words:
            try:
                return Case.parse(f"&a b = {words if any(one in words for one in chr(39) + '*') else quoted(words)} /")["a%b"]
            except (CaseError, KeyError):
                pass
        return words

    def number(self, words):
        """A number in SI units; None where these words are none."""
        found = QUANTITY.fullmatch(words)
        if not found:
            return None
        units, others = units_of(self.unit), ALSO_TYPED.get(self.unit, {})
        number, unit = re.sub("[dD]", "e", found[1]), unit_in(found)
        if unit in others:
            return float(decimal.Decimal(number)*decimal.Decimal(others[unit]))
        if unit not in units and unit:
            return None
        scale = units.get(unit, 1.0)
        if "real" not in self.kind and scale == 1.0 and re.fullmatch(r"[+-]?\d+", number):
            return int(number)
        return float(decimal.Decimal(number)/decimal.Decimal(repr(scale)))


    def unknown_unit(self, value):
        """What is wrong with a value that is a number with a unit of another kind; empty where that is not what is wrong."""
        words = ", ".join(map(str, value)) if isinstance(value, tuple) else value
        if not isinstance(words, str) or self.is_text or self.choices:
            return ""
        known = [one for one in (*units_of(self.unit), *ALSO_TYPED.get(self.unit, {})) if one not in ("", "1")]
        for found in filter(None, map(QUANTITY.fullmatch, map(str.strip, words.split(",")))):
            if unit_in(found) and unit_in(found) not in known:
                return f"{found[0]}: '{unit_in(found)}' is no unit of this key; it knows {' and '.join(filter(None, (', '.join(known[:-1]), known[-1])))}" if known \
                    else f"{found[0]}: this key is a number without a unit"
        return ""


def unit_in(found):
    """The unit of a quantity; empty where it has none."""
    return (found[2] or found[3] or "").strip()


def quoted(words):
    """Words between commas as strings of a namelist."""
    return ", ".join("'" + one.strip().replace("'", "''") + "'" for one in words.split(","))


def read_keys(gfb):
    """{group: {key: Key}} as the program lists them."""
    found: dict[str, dict[str, Key]] = {}
    for key in program.read_keys(gfb).values():
        found.setdefault(key.group, {})[key.name] = Key(**vars(key))
    return found
