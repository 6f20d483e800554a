"""What `&sensitivity` found, the most influential key first: what its tolerance makes of a result, or 1 % of it where no tolerance is given."""

import math
import re

from gfb.case import Case
from gfb.tables import readable

MOST_BARS = 12  # of a result; what is left over moves it less
PER_CENT = 0.01
WORDS = {"minimum_gap": "thinnest film", "axial_gap": "axial gap"}


def sensitivities(summary, case, swept=None):
    """A block a result: its words, how far all tolerances move it, and bars; swept: values that keys have at this point of a sweep."""
    found: dict[str, dict[str, float]] = {}
    for one in summary.values():
        pair = re.fullmatch(r"derivative of (\w+) by (\S+)", one["meaning"])
        if pair and isinstance(one["value"], float) and math.isfinite(one["value"]):
            found.setdefault(pair[1], {})[pair[2]] = one["value"]
    tolerances = tolerances_of(case)
    return [block(quantity, derivatives, summary, tolerances, case, swept or {}) for quantity, derivatives in found.items() if quantity in summary]


def tolerances_of(case):
    """{key: its standard deviation}; of a whole list that of each value."""
    if "sensitivity%tolerances" not in case:
        return {}
    names, values = case["sensitivity%parameters"], case["sensitivity%tolerances"]
    names = re.split(r"[,\s]+", " ".join(names) if isinstance(names, tuple) else names)
    return dict(zip(filter(None, names), values if isinstance(values, tuple) else (values,)))


def tolerance_of(key, tolerances):
    """That of a key, such as bump_foil%crest_gap(7), which may be one of a list; None without."""
    return tolerances.get(key, tolerances.get(re.sub(r"\(\d+\)$", "(:)", key)))


def value_of(key, case: Case, swept):
    """A key's value, of the load its magnitude; None where it is not given."""
    name, _, number = key.rstrip(")").partition("(")
    if name in swept:
        return swept[name]
    value = case[name] if name in case else None
    if name == "operation%load" and isinstance(value, tuple):
        return math.hypot(*value)
    if isinstance(value, tuple):
        return value[int(number) - 1] if number and int(number) <= len(value) else None
    return value if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def block(quantity, derivatives, summary, tolerances, case, swept):
    """Bars of a result, the longest first: tolerances have their own measure, which every key must have."""
    by_tolerance = all(tolerance_of(key, tolerances) is not None for key in derivatives)
    effects, silent = [], 0
    for key, derivative in derivatives.items():
        step = tolerance_of(key, tolerances) if by_tolerance else PER_CENT*(value_of(key, case, swept) or 0.0)
        if step:
            effects.append((key, derivative*step))
        else:
            silent += 1
    effects.sort(key=lambda effect: -abs(effect[1]))
    value, unit = summary[quantity]["value"], summary[quantity]["unit"]
    largest = abs(effects[0][1]) if effects else 0.0
    bars = [{"key": key, "words": key.replace("%", ": ").replace("_", " "), "grows": effect > 0.0, "length": 100.0*abs(effect)/largest,
             "effect": signed(effect, unit, quantity), "share": f"{100.0*effect/value:+.3g} %" if value else ""}
            for key, effect in effects[:MOST_BARS] if effect]
    spread = summary.get(f"standard_deviation_{quantity}", {}).get("value")
    return {"quantity": WORDS.get(quantity, quantity.replace("_", " ")), "value": plain(value, unit, quantity), "by_tolerance": by_tolerance, "bars": bars,
            "spread": plain(spread, unit, quantity) if spread is not None else "", "left_out": len(effects) - len(bars), "silent": silent}


def plain(value, unit, of):
    """A number in the unit of a page; of: the result that it is of."""
    number, unit = readable(value, unit, of)
    return f"{number:.4g}" + (f" {unit}" if unit != "1" else "")


def signed(value, unit, of):
    """The same of a difference."""
    number, unit = readable(value, unit, of)
    return f"{number:+.3g}" + (f" {unit}" if unit != "1" else "")
