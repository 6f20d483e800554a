"""The design study of a machine: its equilibrium, modes and response under a balance grade, the same over the speed, and what each bearing alone
could carry, and from which speed on it would whirl under its share of the weight."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Sequence
from typing import Any

from gfb.case import FILES, Case, CaseError
from gfb.design_parts import SPEEDS, WHIRL_SPEEDS, with_analysis
from gfb.design_work import Part
from gfb.report.machine import is_thrust

RPM = 30.0/math.pi
GRAVITY = 9.81      # [m/s2]
API = 6350.0e-6     # 4 W/N of API 617: 6350 g mm of each kg over the speed in rpm [kg m]
LEVERS = re.compile(r"^bearing (\d+) at .*\n(?:.*\n)??load by levers \(([^,]+), ([^)]+)\) N", re.M)
BODY = re.compile(r"^shaft with discs: (\S+) kg, centre of mass at (\S+) mm", re.M)
GROUPS = ("scene", "shaft", "discs", "bearings", "loads", "machine", "dynamics", "unbalance", "output")
WORK = {"point": "the equilibrium, its modes and the response", "campbell": f"the same at {len(WHIRL_SPEEDS)} speeds"}
Row = tuple[str, str, str, bool]


def permissible(mass: float, speed_rpm: float, grade: float) -> float:
    """What a balance grade leaves, ISO 21940-11: the mass times the grade over the angular speed [kg m]; grade in mm/s."""
    return mass*1.0e-3*grade*RPM/speed_rpm


def api_unbalance(mass: float, speed_rpm: float) -> float:
    """4 W/N of API 617, W the weight of a mass: the largest residual unbalance [kg m]."""
    return API*mass/speed_rpm


def understood(case: Case, gfb: str | os.PathLike[str] | None) -> tuple[float, float, dict[int, tuple[float, float]]]:
    """Mass [kg] and its centre [m], and {bearing: load by levers [N]}, as the program says them."""
    log = case.check(gfb=gfb)
    body = BODY.search(log)
    if not body:
        raise CaseError("gfb --check says nothing of a shaft with discs")
    return float(body[1]), 1.0e-3*float(body[2]), {int(one[1]): (float(one[2]), float(one[3])) for one in LEVERS.finditer(log)}


def parts_of_machine(case: Case, smallest_gap: float | None, gap: float, grade: float, gfb: str | os.PathLike[str] | None) -> list[Part]:
    """All parts; the first one is the operating point. gap: the film that bearings want whose files have none, smallest_gap: that all have
    to keep [m]."""
    mass, centre, loads = understood(case, gfb)
    speed, count = float(case["machine%speed_rpm"]), len(case.listed(FILES))
    one = Case({group: dict(keys) for group, keys in case.groups.items() if group in GROUPS})
    for number in range(1, count + 1):
        if smallest_gap or f"bearing_{number}%capacity%smallest_gap" not in one:
            one[f"bearing_{number}%capacity%smallest_gap"] = gap
    one.groups.get("dynamics", {}).pop("response_speeds", None)  # those of the study are others
    one["scene%analysis"], one.groups["unbalance"] = "linear_dynamics", unbalance_of(case, centre, permissible(mass, speed, grade))
    parts = [titled(case, one, "point", f"at {speed:,.0f} rpm under balance grade G {grade:g}")]
    swept = one.copy()
    swept.groups["sweep"] = {"parameter": "speed_rpm", "values": tuple(part*speed for part in WHIRL_SPEEDS)}
    parts.append(titled(case, swept, "campbell", "modes and response over the speed"))
    parts[-1].states = len(WHIRL_SPEEDS)
    for number in range(1, count + 1):
        parts += parts_of_bearing(one.bearing(number), number, loads.get(number), speed, case.get("machine%axial_load"))
    return parts


def titled(case: Case, one: Case, name: str, question: str) -> Part:
    """A part of the machine itself."""
    one["scene%title"] = f"{case.groups.get('scene', {}).get('title', '')}: {question}".lstrip(": ")
    return Part(name, question, one, states=1, work=WORK[name])


def unbalance_of(case: Case, centre: float, whole: float) -> dict[str, Any]:
    """Where the case has unbalances, their sizes so that they are so much together; without them at the centre of mass [kg m]."""
    if "unbalance%positions" not in case:
        return {"positions": centre, "values": whole}
    places = case.listed("unbalance%positions")
    values = case.listed("unbalance%values")
    values = values*len(places) if len(values) == 1 else values
    size = sum(map(abs, values)) or 1.0
    return dict(case.groups["unbalance"]) | {"values": tuple(whole*value/size for value in values)}


def parts_of_bearing(bearing: Case, number: int, load: tuple[float, float] | None, speed: float, axial_load: float | None) -> list[Part]:
    """Capacity and onset of a bearing alone, under its load by levers, of a thrust bearing under all that acts along the axis."""
    names = [(f"capacity_{number}", f"bearing {number} alone: load capacity over the speed, to a film of {1.0e6*bearing['capacity%smallest_gap']:.3g} um"),
             (f"whirl_{number}", f"bearing {number} alone: whirl over the speed under its share of the load")]
    alone, weight = bearing.copy(), math.hypot(*(load or (0.0, 0.0)))
    alone.groups.pop("sweep", None)
    alone.groups.setdefault("operation", {}).update(speed_rpm=speed)
    if bearing.is_thrust():
        alone["operation%axial_load"] = abs(axial_load or 0.0)
    elif load is None or not weight > 0.0:
        return [Part(name, question, left_out="nothing presses on it by levers") for name, question in names]
    else:
        alone["operation%load"] = load
    for key in ("operation%eccentricity", "operation%tilt", "operation%moment", "operation%axial_gap"):
        if key in alone:
            del alone[key]
    gap = alone["capacity%smallest_gap"]
    capacity = with_analysis(alone, "capacity", names[0][1], "load_capacity", capacity={"smallest_gap": gap}, sweep={
        "parameter": "speed_rpm", "values": tuple(part*speed for part in SPEEDS)})
    capacity.name = names[0][0]
    if bearing.is_thrust():
        return [capacity, Part(names[1][0], names[1][1], left_out="a runner does not whirl along its axis")]
    whirl = with_analysis(alone, "whirl", names[1][1], "linear_dynamics", ("foil_damping",), rotor={"mass": weight/GRAVITY}, sweep={
        "parameter": "speed_rpm", "values": tuple(part*speed for part in WHIRL_SPEEDS)})
    whirl.name = names[1][0]
    return [capacity, whirl]


# --- the answers ---

def rows_of_point(run: dict[str, Any], grade: float) -> list[Row]:
    """What stands at a glance, and the unbalance that ISO 21940 and API 617 allow."""
    mass, speed = run["summary"]["mass"]["value"], float(run["used"]["machine%speed_rpm"])
    own, other = permissible(mass, speed, grade), api_unbalance(mass, speed)
    rows = list(run["glance"])
    rows.append((f"unbalance of ISO 21940 grade G {grade:g}", f"{1.0e6*own:.3g} g mm", "of the whole shaft with discs; the response is to this one", False))
    rows.append(("unbalance of API 617, 4 W/N", f"{1.0e6*other:.3g} g mm", f"linear theory: {other/own:.3g} times the response", False))
    return rows


def answer_campbell(question: str, run: dict[str, Any]) -> list[Row]:
    """From which speed on it whirls, and where a journal moves most."""
    onset = run["summary"].get("onset_speed_rpm", {}).get("value")
    speeds, growth = ([float(value) for value in run["points"].get(name, ())] for name in ("speed_rpm", "growth_rate"))
    margin = next((one for one in run["margins"] if one.result == "onset_speed_rpm"), None)
    if onset is not None:
        words = f"onset of whirl at {onset:,.0f} rpm"
    else:
        grows = [speed for speed, rate in zip(speeds, growth) if rate >= 0.0]
        words = f"grows from {min(grows):,.0f} rpm on" if grows else f"dies out at all {min(speeds):,.0f} to {max(speeds):,.0f} rpm"
    rows: list[Row] = [(question, words, margin.against if margin else "", bool(margin and margin.is_broken))]
    amplitude = run.get("amplitudes")
    if amplitude is not None and len(amplitude):
        amplitude = amplitude*[not is_thrust(run["summary"], number) for number in range(1, amplitude.shape[1] + 1)]  # of journals
        point, number = (int(one) for one in divmod(int(amplitude.argmax()), amplitude.shape[1]))
        rows.append(("largest motion of a journal", f"{1.0e6*amplitude[point, number]:.3g} um in bearing {number + 1}", f"at {speeds[point]:,.0f} rpm", False))
    return rows


def base_of(name: str) -> str:
    """The name of a part without its bearing's number."""
    return re.sub(r"_\d+$", "", name)


def bearing_of(name: str) -> str:
    """The bearing of a part in words; empty where it is of the whole."""
    found = re.search(r"_(\d+)$", name)
    return f"bearing {found[1]} alone" if found else ""


def is_of_one_bearing(parts: Sequence[Part]) -> bool:
    """Whether a study is of a bearing, not of a machine."""
    return all(part.name != "campbell" for part in parts)
