"""What a page says of a machine: margins of each bearing and of the whole, the rows at a glance, and its picture to scale."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy

from gfb.case import Case
from gfb.report.answer import KELVIN, MOST, THINNEST, Results, is_number
from gfb.report.margin import ONSET, Margin, compared
from gfb.report.sketch import case_sketch
from gfb.report.sketch_lines import LINE, ROOM, SIDE, Drawing, line
from gfb.results import text_of

RPM = 30.0/math.pi
Sizes = dict[int, tuple[float, float, float]]  # {bearing: (length, radius, inner radius of a thrust bearing or 0)} [m]
WIDE, MIDDLE, TALL = SIDE + ROOM, 100.0, 78.0  # of the picture: its width, where the axis is, largest radius
SAME = 1.0e-9        # of a speed: one that differs less is it
LINEAR = 1.0/3.0     # of the thinnest film: a larger amplitude is more than a linear theory may say
SLEEVE = 7.0         # thickness of a sleeve
STEEL = 7800.0       # [kg/m3], of which discs are drawn
MOST_SEGMENTS, MOST_BEARINGS = 1000, 100


@dataclasses.dataclass
class MachineTables:
    """What of a machine's result file stands in no summary."""

    bearings: numpy.ndarray   # (bearing; z, length, radius, clearance, film that is wanted) [m]
    amplitude: numpy.ndarray  # of each bearing's response to unbalance at the machine's speed [m]; empty without one
    stress: float | None      # of the shaft's outer fibre [Pa]
    files: list[Case] = dataclasses.field(default_factory=list)  # of the bearings
    over_points: numpy.ndarray = dataclasses.field(default_factory=lambda: numpy.zeros((0, 0)))  # (point, bearing): amplitudes [m]


def is_machine(case: Case) -> bool:
    """Whether a case is of a machine."""
    return "shaft" in case.groups


def read_tables(file, case: Case) -> MachineTables | None:
    """Those of an open case file, whose echo is the case; None where there are none."""
    if "shaft/bearings" not in file:
        return None
    bearings = file["shaft/bearings"][...]
    amplitudes, amplitude = numpy.zeros((0, len(bearings))), numpy.zeros(0)
    if "dynamics/response" in file:
        own = float(file["history/speed_rpm"][-1]) if "history/speed_rpm" in file else float(case["machine%speed_rpm"])
        speeds = next((file[name][...].ravel() for name in ("dynamics/response_speed", "history/speed_rpm") if name in file), numpy.array([own]))
        table = file["dynamics/response"][...].reshape(len(speeds), -1, 5)
        amplitudes = numpy.array([largest_radius(one[:len(bearings)]) for one in table])
        amplitude = amplitudes[numpy.abs(speeds - own).argmin()] if numpy.abs(speeds - own).min() <= SAME*abs(own) else amplitude
    files = [Case.parse(text_of(file[f"scene/bearing_{number}"][()])) for number in range(1, len(bearings) + 1) if f"scene/bearing_{number}" in file]
    return MachineTables(bearings, amplitude, float(file["shaft/sections"][:, 6].max()), files, amplitudes)


def largest_radius(table: numpy.ndarray) -> numpy.ndarray:
    """The longer half axis of each ellipse, x = a cos(w t + p), y = b cos(w t + q): half of what goes with the speed and half of what goes
    against it."""
    x, y = table[:, 1]*numpy.exp(1j*table[:, 2]), table[:, 3]*numpy.exp(1j*table[:, 4])
    return 0.5*(numpy.abs(x + 1j*y) + numpy.abs(x - 1j*y))


def numbers_of(results: Results, name: str) -> list[tuple[int, float]]:
    """(bearing, value) of a result that each bearing has."""
    found, number = [], 1
    while (value := results.value(f"{name}_{number}")) is not None or number <= count_of(results):
        if value is not None:
            found.append((number, value))
        number += 1
    return found


def count_of(results: Results) -> int:
    """How many bearings the case names."""
    return min(len(results.case.listed("bearings%files")), MOST_BEARINGS) if "bearings%files" in results.case else 0


# --- margins ---

def machine_margins(results: Results) -> list[Margin]:
    """Of each bearing its film, of the whole whirl, response and heat."""
    found = [one for question in (films, whirl, response, temperature, stress) for one in question(results)]
    return [dataclasses.replace(one, body="machine") for one in found]


def films(results: Results) -> Iterator[Margin]:
    """The thinnest film of each bearing, against the one that its file wants."""
    tables = results.machine
    for number, gap in numbers_of(results, "minimum_gap"):
        subject, words = f"film of bearing {number}", f"{THINNEST} {1.0e6*gap:.4g} um"
        wanted = float(tables.bearings[number - 1, 4]) if tables and number <= len(tables.bearings) else 0.0
        if wanted > 0.0:
            yield compared(subject, words, f"{1.0e6*wanted:.3g} um are wanted", gap/wanted)
        else:
            yield Margin(subject, words)


def whirl(results: Results) -> Iterator[Margin]:
    """The growth of the least damped mode, and the onset against the speed."""
    growth, frequency, onset, speed = (results.value("growth_rate"), results.value("whirl_frequency"), results.value(ONSET),
                                       results.key("machine%speed_rpm"))
    if growth is not None:
        how = "" if frequency is None else f" at {frequency/(2.0*math.pi):.4g} Hz"
        size = "" if not frequency else f" with a logarithmic decrement of {-2.0*math.pi*growth/frequency:.3g}"
        yield Margin("whirl", f"the least damped mode{how}", f"it {'grows' if growth >= 0.0 else 'dies out'}{size}", None, growth >= 0.0,
                     result="growth_rate")
    if onset is not None and speed:
        yield compared("whirl", f"onset of whirl at {onset:,.0f} rpm", f"the speed is {speed:,.0f} rpm", onset/speed, result=ONSET)


def response(results: Results) -> Iterator[Margin]:
    """How far unbalance moves each journal, over its film: beyond a third linear theory says little."""
    tables, gaps = results.machine, {number: gap for number, gap in numbers_of(results, "minimum_gap") if not is_thrust(results.summary, number)}
    if tables is None or not len(tables.amplitude):
        return
    number, share = max(((i, size/gaps[i]) for i, size in enumerate(tables.amplitude, 1) if gaps.get(i, 0.0) > 0.0),
                        key=lambda one: one[1], default=(0, 0.0))
    if number:
        yield compared("unbalance", f"{1.0e6*tables.amplitude[number - 1]:.3g} um of amplitude in bearing {number}, {share:.3g} of its film",
                       "linear theory reaches to a third", LINEAR/share if share > 0.0 else MOST)


def is_thrust(summary: dict[str, Any], number: int) -> bool:
    """Whether a bearing holds the shaft along its axis."""
    return f"force_z_{number}" in summary


def temperature(results: Results) -> Iterator[Margin]:
    """The hottest film of each bearing against what its file allows, by the rise over the gas around; where none says how hot it may be,
    the hottest of all."""
    hot, limited = numbers_of(results, "maximum_film_temperature"), False
    for number, most in hot:
        own = Results({}, results.machine.files[number - 1]) if results.machine and number <= len(results.machine.files) else None
        limit = own.key("capacity%highest_temperature") if own else None
        ambient = own.key("thermal%ambient_temperature", 20.0 + KELVIN) if own else None
        if limit and ambient and most > ambient:
            limited = True
            yield compared("temperature", f"hottest film of bearing {number} {most - KELVIN:.4g} °C", f"{limit - KELVIN:.4g} °C are allowed",
                           (limit - ambient)/(most - ambient))
    if hot and not limited:
        number, most = max(hot, key=lambda one: one[1])
        yield Margin("temperature", f"hottest film {most - KELVIN:.4g} °C, in bearing {number}")


def stress(results: Results) -> Iterator[Margin]:
    """Of the shaft, under its loads at rest; no case has a strength."""
    if results.machine is not None and results.machine.stress is not None:
        yield Margin("stress", f"bending stress of the shaft {1.0e-6*results.machine.stress:.3g} MPa")


def left_open(results: Results, subjects: set[str]) -> list[str]:
    """What may limit a machine, too, and was not asked for."""
    if not numbers_of(results, "minimum_gap"):
        return []
    return [one for one in ("whirl", "unbalance", "temperature") if one not in subjects]


def total_loss(results: Results) -> float | None:
    """The watts of all bearings together."""
    whole = results.value("power_loss")
    parts = [value for _, value in numbers_of(results, "power_loss")]
    return whole if whole is not None else sum(parts) if parts else None


# --- at a glance ---

def machine_glance(results: Results) -> Iterator[tuple[str, str, str, bool]]:
    """(what, how much, margin or verdict, whether that is a bad one)."""
    margins = machine_margins(results)
    gaps = numbers_of(results, "minimum_gap")
    if gaps:
        number, gap = min(gaps, key=lambda one: one[1])
        yield THINNEST, f"{1.0e6*gap:.4g} um", f"in bearing {number}", False
    for number, gap in gaps:
        force = [results.value(f"force_{axis}_{number}") for axis in "xy"]
        force = [one for one in [*force, results.value(f"force_z_{number}")] if one is not None]
        margin = next(one for one in margins if one.subject == f"film of bearing {number}")
        yield f"bearing {number}", f"{math.hypot(*force):.4g} N on {1.0e6*gap:.4g} um", margin.against, margin.is_broken
    loss = total_loss(results)
    if loss is not None:
        parts = " + ".join(f"{value:.4g}" for _, value in numbers_of(results, "power_loss"))
        yield "power loss of all bearings", f"{loss:.4g} W", parts, False
    for one in margins:
        if one.subject in ("whirl", "unbalance", "temperature", "stress"):
            yield one.subject, one.value, one.against, one.is_broken
    speed, number = results.key("machine%speed_rpm"), 1
    while (critical := results.value(f"critical_speed_{number}")) is not None:
        factor = results.value(f"amplification_factor_{number}")
        yield (f"critical speed {number}", f"{critical:,.0f} rpm", "; ".join(filter(None, (
            f"amplification factor {factor:.3g}" if factor is not None else "", f"the speed is {speed/critical:.3g} times it" if speed else ""))), False)
        number += 1
    mass, centre = results.value("mass"), results.value("centre_of_mass")
    if mass is not None and centre is not None:
        yield "shaft with discs", f"{mass:.4g} kg", f"centre of mass at {1.0e3*centre:.4g} mm", False


# --- its picture ---

def numbers(case: Case, name: str, count: int | None = None, default: float | None = None) -> list[float]:
    """Numbers of a list of the case, one for all where one alone is given; ValueError where there is no such list."""
    values = case.listed(name) if name in case else (() if default is None else (default,))
    if len(values) > MOST_SEGMENTS or not all(map(is_number, values)):
        raise ValueError(f"{name}: no list of numbers")
    if count is not None and len(values) == 1:
        values = values*count
    if count is not None and len(values) != count:
        raise ValueError(f"{name}: not one value for each")
    return [float(one) for one in values]


def draw_machine(case: Case, sizes: Sizes | None = None) -> Drawing:
    """Shaft, discs, sleeves and loads to scale; sizes: of bearings whose files are known. ValueError where its numbers give no machine."""
    lengths = numbers(case, "shaft%lengths")
    outer, inner = numbers(case, "shaft%outer_diameters", len(lengths)), numbers(case, "shaft%inner_diameters", len(lengths), 0.0)
    if not lengths or not min(lengths) > 0.0 or not min(outer) > 0.0:
        raise ValueError("no shaft")
    whole = sum(lengths)
    places = numbers(case, "discs%positions", None, None) if "discs%positions" in case else []
    masses, polar = (numbers(case, f"discs%{name}", len(places), default) if places else [] for name, default in (("masses", None), ("polar_inertias", 0.0)))
    discs = [disc_size(mass, inertia) for mass, inertia in zip(masses, polar)]
    tallest = max([0.5*max(outer), *(radius for radius, _ in discs), *(radius for _, radius, _ in (sizes or {}).values())])
    scale = min((WIDE - 24.0)/whole, TALL/tallest)
    drawing, begin = Drawing(), 0.5*(WIDE - scale*whole)
    facing = numbers(case, "bearings%facing", len(case.listed("bearings%positions")), 1.0) if "bearings%positions" in case else []

    def box(look, groups, left, right, low, high):
        drawing.add(look, groups, line([(begin + scale*left, MIDDLE - scale*low), (begin + scale*right, MIDDLE - scale*low),
                                        (begin + scale*right, MIDDLE - scale*high), (begin + scale*left, MIDDLE - scale*high)], True))

    first = 0.0
    for length, thick, bore in zip(lengths, outer, inner):
        box("shaft", "shaft", first, first + length, -0.5*thick, 0.5*thick)
        if 0.0 < bore < thick:
            box("shaft line", "shaft", first, first + length, -0.5*bore, 0.5*bore)
        first += length
    for middle, (radius, width) in zip(places, discs):
        box("ramp", "discs", middle - 0.5*width, middle + 0.5*width, -radius, radius)
    for number, middle in enumerate(numbers(case, "bearings%positions") if "bearings%positions" in case else [], 1):
        here = diameter_at(middle, lengths, outer)
        length, radius, inner_radius = (sizes or {}).get(number) or (here, 0.5*here, 0.0)
        left, right, low, high = middle - 0.5*length, middle + 0.5*length, radius, radius + SLEEVE/scale
        if inner_radius > 0.0:  # a plate behind its pads
            left, right, low, high = middle - facing[number - 1]*SLEEVE/scale, middle, inner_radius, radius
        for side in (1.0, -1.0):
            box("pad", "bearings", min(left, right), max(left, right), side*low, side*high)
        drawing.notes.append(("fine", f"bearing {number} at {1.0e3*middle:.4g} mm"))
    draw_loads(drawing, case, begin, scale)
    drawing.add("axis line", "machine", line([(begin - 10.0, MIDDLE), (begin + scale*whole + 10.0, MIDDLE)]))
    drawing.low = MIDDLE + max(scale*tallest, 0.5*scale*max(outer) + SLEEVE) + LINE + 4.0
    drawing.notes.insert(0, ("note", f"shaft of {1.0e3*whole:.4g} mm, z →, x ↑"))
    return drawing


def disc_size(mass: float, inertia: float) -> tuple[float, float]:
    """Radius and width of a disc of steel with a mass and a polar inertia."""
    if not 0.0 < mass < MOST or not 0.0 <= inertia < MOST:
        raise ValueError("no disc")
    radius = math.sqrt(2.0*inertia/mass) if inertia > 0.0 else (mass/(STEEL*math.pi))**(1.0/3.0)
    return radius, min(mass/(STEEL*math.pi*radius**2), radius)


def diameter_at(place: float, lengths: list[float], diameters: list[float]) -> float:
    """The shaft's diameter at a place."""
    last = 0.0
    for length, diameter in zip(lengths, diameters):
        last += length
        if place <= last:
            return diameter
    return diameters[-1]


def draw_loads(drawing: Drawing, case: Case, begin: float, scale: float) -> None:
    """Forces along x, which points up."""
    places = numbers(case, "loads%positions") if "loads%positions" in case else []
    forces = numbers(case, "loads%forces_x", len(places), 0.0) if places else []
    for place, force in zip(places[:MOST_BEARINGS], forces):
        if force:
            side = math.copysign(1.0, force)
            drawing.arrow("load", "loads", (begin + scale*place, MIDDLE + 46.0*side), (begin + scale*place, MIDDLE + 8.0*side))
    for place in numbers(case, "unbalance%positions") if "unbalance%positions" in case else []:
        drawing.add("turn", "unbalance", line([(begin + scale*place - 3.0, MIDDLE - 20.0), (begin + scale*place + 3.0, MIDDLE - 20.0),
                                               (begin + scale*place + 3.0, MIDDLE - 14.0), (begin + scale*place - 3.0, MIDDLE - 14.0)], True))


def machine_picture(case: Case, sizes: Sizes | None = None) -> dict | None:
    """The picture of a machine's case; None where its numbers give none."""
    try:
        return draw_machine(case, sizes).picture(WIDE) | {"words": "the machine to scale", "pads": [], "thinnest": None, "centre": None}
    except (ValueError, OverflowError, ZeroDivisionError):
        return None


def picture_of_case(case: Case, sizes: Sizes | None = None) -> dict | None:
    """The picture of a machine's case, or of a bearing's or a strip's; None where its numbers give none."""
    return machine_picture(case, sizes) if is_machine(case) else case_sketch(case)


def sizes_of_files(case: Case, read: Callable[[str], str]) -> Sizes:
    """Those of the files that a case names, as far as they can be read."""
    found: Sizes = {}
    for number, name in enumerate(case.listed("bearings%files") if "bearings%files" in case else (), 1):
        try:
            results = Results({}, name if isinstance(name, Case) else Case.parse(read(name)))
        except (ValueError, OSError):
            continue
        length, radius, inner = (results.key(f"bearing%{key}") for key in ("length", "radius", "inner_radius"))
        ring = results.key("bearing%outer_radius")
        if length and radius and min(length, radius) > 0.0:
            found[number] = (length, radius, 0.0)
        elif ring and inner and ring > inner > 0.0:
            found[number] = (ring - inner, ring, inner)
    return found


def sizes_of(tables: MachineTables | None, summary: dict) -> Sizes:
    """Those of a result; a thrust bearing has a force along z, and its table the length of its sectors along their radius."""
    if tables is None:
        return {}
    return {number: (float(row[1]), float(row[2]), float(row[2] - row[1]) if is_thrust(summary, number) else 0.0)
            for number, row in enumerate(tables.bearings, 1)}
