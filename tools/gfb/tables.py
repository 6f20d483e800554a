"""Tables for the terminal and for the documentation, and the units that people read and type."""

import math

# SI unit: unit that is read, and what to multiply with.
READABLE = {"Pa": ("kPa", 1.0e-3), "m": ("um", 1.0e6), "J": ("mJ", 1.0e3), "rad": ("mrad", 1.0e3), "N m": ("mN m", 1.0e3),
            "N/m": ("MN/m", 1.0e-6), "W/m2": ("kW/m2", 1.0e-3), "kg/s": ("g/s", 1.0e3)}
# The same for units in which drawings and data sheets have what a case file has in SI units, before those that are read.
TYPED = {"m": ("mm", 1.0e3), "rad": ("deg", 180.0/math.pi), "Pa": ("GPa", 1.0e-9)}
# What may be typed, too, and is never shown: SI unit: {unit: what it is in SI, as a decimal number, which is exact}.
ALSO_TYPED = {"m": {"mil": "25.4e-6", "inch": "25.4e-3", "in": "25.4e-3"}, "Pa": {"MPa": "1e6", "bar": "1e5"}}


def readable_unit(unit, of=""):
    """The unit in which people read what is in SI, and what to multiply with; of: a result's name, for stresses are no pressures."""
    return ("MPa", 1.0e-6) if unit == "Pa" and of.endswith("_stress") else READABLE.get(unit, (unit, 1.0))


def readable(values, unit, of=""):
    """Numbers in SI in the unit that people read, and that unit."""
    name, factor = readable_unit(unit, of)
    return values*factor, name


def units_of(unit):
    """{unit: what to multiply SI with} of all units in which a number is shown where it is typed, its own last."""
    return dict([*(one[unit] for one in (TYPED, READABLE) if unit in one), (unit, 1.0)])


def plain_table(title, heads, rows):
    """A table for the terminal; the first two columns are words."""
    widths = [max(len(row[i]) for row in [heads, *rows]) for i in range(len(heads))]
    text = title + "\n"
    for row in [heads, *rows]:
        cells = [cell.ljust(width) if i < 2 else cell.rjust(width)
                 for i, (cell, width) in enumerate(zip(row, widths))]
        text += "  ".join(cells).rstrip() + "\n"
    return text


def markdown_table(title, heads, rows):
    """The same for the documentation, its title left out."""
    del title
    lines = [heads, ["---"]*2 + ["---:"]*(len(heads) - 2), *rows]
    return "".join("| " + " | ".join(row) + " |\n" for row in lines)
