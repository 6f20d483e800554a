"""What limits a bearing and by how much: the sentence with which the page of a run, of several, of a study, the studio and the terminal begin,
and the margins behind it. A limit is one that the case or the study gives, or that the bearing's own stability sets; where there is none,
that is said."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from gfb.report.answer import KELVIN, Results, carried_by, film_words, place_words
from gfb.report.machine import is_machine, left_open, machine_margins
from gfb.report.margin import ONSET, Margin, compared

OWN_TOUCH_DOWN = 2.0e-4  # of the clearance: at or below it `touch_down_gap` is the solver's own, no limit of a design
AT_LIMIT = ("load_capacity", "misalignment_allowance")  # analyses that end where film or heat is at its limit
LOWEST_SUPPLY = "lift_off_supply_pressure"  # at which the film is at its limit, too
FILM, HEAT, STRESS = "film_margin", "temperature_margin", "stress_margin"
WORST = "at the worst point"  # of a sweep


def margins_of(results: Results, smallest_gap: float | None = None) -> list[Margin]:
    """The margins of one run; smallest_gap: a film that a study wants [m]."""
    found = all_margins(results, smallest_gap)
    return at_last_point(found) if "sweep" in results.case.groups else found


def all_margins(results: Results, smallest_gap: float | None = None) -> list[Margin]:
    """The same, of a sweep those of its last point beside those of all points."""
    if is_machine(results.case):
        return machine_margins(results)
    found = list(film(results, smallest_gap))
    for question in (load, lift_off, whirl, foils, misalignment, temperature, stress):
        found += question(results)
    return found


def at_last_point(margins: list[Margin]) -> list[Margin]:
    """Those of a sweep: what gfb compared itself is of its worst point; an onset is of all points, and stands for the whirl of the last one, which may lie beyond the case's speed."""
    onset = [one for one in margins if one.result == ONSET]
    others = [one for one in margins if one not in onset and not (onset and one.subject == "whirl")]
    return [*onset, *(dataclasses.replace(one, where=one.where or "at the last point") for one in others)]


def worst_factor(results: Results, name: str) -> float | None:
    """A margin that gfb found at the worst point of a sweep; None where there is no sweep, or no such margin."""
    return results.value(name) if "sweep" in results.case.groups else None


def film(results: Results, smallest_gap: float | None) -> Iterator[Margin]:
    """The thinnest film, of a shaft that moves the thinnest of all time."""
    over_time = results.value("minimum_gap_over_time")
    gap = results.value("minimum_gap") if over_time is None else over_time
    if gap is None or results.case.get("scene%analysis") in AT_LIMIT or results.value(LOWEST_SUPPLY) is not None:
        return
    words = film_words(gap, place_words(results) if over_time is None else "")
    clearance, touch_down = results.key("bearing%clearance", 0.0) or 0.0, results.key("solver%touch_down_gap", 0.0) or 0.0
    given = smallest_gap or results.key("capacity%smallest_gap")
    factor = None if smallest_gap else worst_factor(results, FILM)
    if given and factor is not None:
        yield compared("film", film_words(factor*given), f"{1.0e6*given:.3g} um are wanted", factor, WORST, FILM)
    elif given and given > 0.0:
        yield compared("film", words, f"{1.0e6*given:.3g} um are wanted", gap/given, result=FILM)
    elif clearance > 0.0 and touch_down > OWN_TOUCH_DOWN*clearance:
        yield compared("film", words, f"below {1.0e6*touch_down:.3g} um it touches down", gap/touch_down)
    else:
        yield Margin("film", words)
    why = results.summary.get("not_reached", {}).get("value", "")
    if over_time is not None and isinstance(why, str) and why:
        yield Margin("motion", "the motion asked for", f"not reached: {why}", None, True)


def load(results: Results) -> Iterator[Margin]:
    """Capacity against the case's load."""
    capacity, wanted = results.value("load_capacity"), carried_by(results.case)
    if capacity is not None:
        words = f"load capacity {capacity:.4g} N"
        yield compared("load", words, f"the load is {wanted:.4g} N", capacity/wanted, result="load_capacity") if wanted else Margin("load", words)


def lift_off(results: Results) -> Iterator[Margin]:
    """Lift-off against the case's speed, or its supply: by how much that is above the gas around."""
    lowest, supply, around = results.value(LOWEST_SUPPLY), results.key("feed%supply_pressure"), results.key("gas%ambient_pressure")
    if lowest is not None and supply and around:
        words, has = f"lift-off at a supply of {1.0e-5*lowest:.4g} bar", f"it has {1.0e-5*supply:.4g} bar"
        yield (compared("lift-off", words, has, (supply - around)/(lowest - around), result=LOWEST_SUPPLY) if lowest > around else
               Margin("lift-off", "no supply is needed", has, result=LOWEST_SUPPLY))
    off, speed = results.value("lift_off_speed_rpm"), results.key("operation%speed_rpm")
    if off is not None and off > 0.0:
        words = f"lift-off at {off:,.0f} rpm"
        yield compared("lift-off", words, f"the speed is {speed:,.0f} rpm", speed/off, result="lift_off_speed_rpm") if speed else Margin("lift-off", words)


def whirl(results: Results) -> Iterator[Margin]:
    """Critical mass against the rotor's, its growth, and the onset against the speed."""
    critical, mass = results.value("critical_mass"), results.key("rotor%mass")
    speed, onset = results.key("operation%speed_rpm"), results.value(ONSET)
    growth, damped = results.value("growth_rate"), results.value("damping_ratio")
    frequency = results.value("whirl_frequency") or results.value("axial_frequency")
    if critical is not None:
        words = f"critical mass {critical:.4g} kg"
        axial = results.value("axial_gap") is not None
        yield compared("hammer" if axial else "whirl", words, f"this bearing carries {mass:.4g} kg of the rotor", critical/mass, result="critical_mass") if mass else Margin("hammer" if axial else "whirl", words)
    if growth is not None:
        how = "" if frequency is None else f" at {frequency/(2.0*math.pi):.4g} Hz"
        ratio = "" if damped is None else f" with a damping ratio of {damped:.3g}"
        yield Margin("whirl" if results.value("axial_gap") is None else "axial vibration", f"rotor's least damped mode{how}",
                     f"it {'grows' if growth >= 0.0 else 'dies out'}{ratio}", None, growth >= 0.0, result="growth_rate")
    if onset is not None and speed:
        yield compared("whirl", f"onset of whirl at {onset:,.0f} rpm", f"the speed is {speed:,.0f} rpm", onset/speed, result=ONSET)


def foils(results: Results) -> Iterator[Margin]:
    """Whether foils stay in their equilibrium."""
    unstable = results.value("stability")
    if unstable is not None:
        yield Margin("foils", "foils at rest", "stable" if unstable == 0.0 else "they leave this equilibrium", None, unstable != 0.0, result="stability")


def not_computed(results: Results, margins: Sequence[Margin]) -> list[str]:
    """What may limit such a bearing, too, and was not asked for."""
    there = {one.subject for one in margins}
    if is_machine(results.case):
        return left_open(results, there)
    if results.value("minimum_gap") is None:
        return []
    apply = {"whirl": results.value("axial_gap") is None, "misalignment": True, "temperature": True,
             "stress": results.case.get("model%foil") in ("shell", "beam", "plate")}
    return [subject for subject, applies in apply.items() if applies and subject not in there]


def misalignment(results: Results) -> Iterator[Margin]:
    """The tilt that is left; none is known that it must exceed."""
    words = results.words("misalignment_allowance")
    if words:
        yield Margin("misalignment", f"{words} of tilt left")


def temperature(results: Results) -> Iterator[Margin]:
    """How hot film and top foil are, against what the case allows: the factor is that of the rise over the gas around."""
    film = results.value("maximum_film_temperature")
    if film is None:
        return
    limit, ambient = results.key("capacity%highest_temperature"), results.key("thermal%ambient_temperature", 20.0 + KELVIN) or 0.0
    if limit is None:
        yield Margin("temperature", f"hottest film {film - KELVIN:.4g} °C")
        return
    hottest = max(film, results.value("maximum_top_foil_temperature") or film)
    factor = worst_factor(results, HEAT)
    where = "" if factor is None else WORST
    if factor is not None:
        hottest = ambient + (limit - ambient)/factor
    words, allowed = f"film and top foil at most {hottest - KELVIN:.4g} °C", f"{limit - KELVIN:.4g} °C are allowed"
    if hottest > ambient and results.case.get("scene%analysis") not in AT_LIMIT:
        yield compared("temperature", words, allowed, (limit - ambient)/(hottest - ambient), where, HEAT)
    else:
        yield Margin("temperature", words, allowed, where=where, result=HEAT)


def stress(results: Results) -> Iterator[Margin]:
    """The largest stress, against what the case allows."""
    most = [value for value in map(results.value, ("maximum_top_foil_stress", "maximum_bump_foil_stress")) if value is not None]
    if not most:
        return
    largest, limit, factor = max(most), results.key("capacity%largest_stress"), worst_factor(results, STRESS)
    if limit and factor:
        largest = limit/factor
    words = f"largest stress {1.0e-6*largest:.4g} MPa"
    if limit and largest > 0.0:
        yield compared("stress", words, f"{1.0e-6*limit:.4g} MPa are allowed", limit/largest, WORST if factor else "", STRESS)
    else:
        yield Margin("stress", words)


# --- the sentence ---

def colour_of(margins: Sequence[Margin]) -> str:
    """The worst state among margins, whose colour their sentence has; empty where none has a limit."""
    states = {one.state for one in margins}
    return "broken" if states & {"broken", "missing"} else "kept" if "kept" in states and "stopped" not in states else ""


def sentence(margins: Sequence[Margin], ended: str = "", open_questions: Sequence[str] = ()) -> str:
    """What limits the bearing, by how much, and for what no limit is known; ended: how a run without an answer did; open_questions: what
    was not computed."""
    if ended:
        return ended
    broken = [one for one in margins if one.state == "broken"]
    kept = [one for one in margins if one.state == "kept"]
    broken.sort(key=lambda one: one.factor if one.factor is not None else 1.0)  # what has a number says by how much
    missing, stopped = (list(dict.fromkeys(one.subject for one in margins if one.state == state)) for state in ("missing", "stopped"))
    known = {one.subject for one in broken + kept} | {*missing, *stopped}
    without = list(dict.fromkeys(one.subject for one in margins if one.subject not in known))
    words = []
    if broken:
        first, others = broken[0], list(dict.fromkeys(one.subject for one in broken if one.subject != broken[0].subject))
        words.append(f"{first.subject.capitalize()} limits this {first.body}: {first.words()}." + (f" Broken, too: {', '.join(others)}." if others else ""))
    elif kept:
        near = min(kept, key=lambda one: math.inf if one.factor is None else one.factor)
        words.append(f"All known limits are kept; {near.subject} is nearest to its own: {near.words()}." if len(kept) > 1
                     else f"The one known limit is kept, that of {near.subject}: {near.words()}.")
    if without:
        words.append(f"No limit is known for {', '.join(without)}" + ("." if known else f": {margins[0].value}."))
    if missing:
        words.append(f"No answer: {', '.join(missing)}.")
    if stopped:
        words.append(f"Stopped before the end: {', '.join(stopped)}.")
    if open_questions:
        words.append(f"Not computed: {', '.join(open_questions)}.")
    return " ".join(words)


def total_power(runs: Sequence[dict[str, Any]]) -> str:
    """The watts of several runs together; empty where one has none."""
    watts = [run["summary"].get("power_loss", {}).get("value") for run in runs]
    if len(watts) < 2 or not all(isinstance(one, float) and math.isfinite(one) for one in watts):
        return ""
    return f"Power loss of the {len(watts)} cases together: {sum(watts):.4g} W ({' + '.join(f'{one:.4g}' for one in watts)})."


def plain(runs: Sequence[dict[str, Any]], of: Callable[[dict[str, Any]], str] = lambda run: run["verdict"]) -> str:
    """The sentences of some runs for a terminal, a line each."""
    lines = [f"{run['name']}: {of(run)}" if len(runs) > 1 else of(run) for run in runs]
    return "\n".join(filter(None, [*lines, total_power(runs)]))
