"""The whole study of one bearing: film, directions of the load, capacity and lift-off over the speed, vibrations, whirl, orbit under a
balance grade, misalignment, tolerances. Of a machine: modes and response under a balance grade, over the speed, and each bearing alone.

  tools/design CASE.nml          a page, results/CASE.design/CASE.html, and the same as a table

Each part is a case file beside its results, which tools/run and tools/report take, too. A line says when a part begins and how long it may take;
the page is there after the first one and fills. Ctrl-C loses nothing: called again, it computes what is not there yet, goes on with what was stopped,
and computes again what is another program's. A part that does not apply is left out, in words. Exit status: 0 the page is written, 1 the case is wrong.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import os
import pathlib
import re
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from gfb.case import Case, CaseError
from gfb.design_machine import answer_campbell, base_of, bearing_of, is_of_one_bearing, parts_of_machine, rows_of_point
from gfb.design_parts import DIRECTIONS, ORBIT_STEADY, ORBIT_TURNS, SPEEDS, WHIRL_SPEEDS, with_analysis
from gfb.design_work import Part, Progress, compute_all, duration, tilt_words
from gfb.report.answer import LAST_STATE, Results, carried_by, film_words, why_none
from gfb.report.machine import is_machine
from gfb.report.main import read_run, write_page
from gfb.report.thinnest import SAME
from gfb.report.margin import NO_ANSWER, ONSET, STOPPED, Margin, compared
from gfb.report.verdict import margins_of, not_computed, sentence
from gfb.results import read_history
from gfb.running import Result
from gfb.tool import RunError, draw_into_files, parser_of, say

SMALLEST_GAP = 4.0e-6                # m: the film at which load and tilt have reached their limit, where the case has none
GRADE = 2.5                          # mm/s, ISO 21940-11: of turbines
KEPT = ("highest_temperature", "largest_stress")  # limits of &capacity beside the film, of the bearing where it runs
IDLE = re.compile(r"&sensitivity: parameters(?:\(\d+\))? = '([\w%]+)'")  # a key whose tolerance is none of this case
# What a drawing leaves open, as a standard deviation: a length [m], or a part of the value.
TOLERANCES = {"bearing%clearance": (2.0e-6, 0.0), "bump_foil%height": (1.0e-5, 0.0), "ramp%height": (2.0e-6, 0.0),
              "bump_foil%thickness": (0.0, 0.03), "bump_foil%half_length": (0.0, 0.02), "top_foil%thickness": (0.0, 0.03),
              "model%foundation_stiffness": (0.0, 0.2), "model%crest_stiffness": (0.0, 0.2), "gas%viscosity": (0.0, 0.02),
              "contact%friction_top": (0.05, 0.0), "contact%friction_sleeve": (0.05, 0.0)}


@dataclasses.dataclass
class Design:
    """What a study found, or has found so far."""

    parts: list[Part]
    rows: list[tuple[str, str, str, bool]]  # question, answer, margin or verdict, whether that is a bad one
    folder: pathlib.Path
    name: str
    margins: list[Margin] = dataclasses.field(default_factory=list)
    verdict: str = ""         # what limits the bearing, in a sentence
    grade: float = GRADE      # of the balance [mm/s]
    seconds: int = 0          # for the pictures of a part; 0: as long as they take
    runs: dict[str, dict[str, Any]] = dataclasses.field(default_factory=dict, repr=False)  # what a part has found, by its name, read once
    shown: dict[pathlib.Path, Any] = dataclasses.field(default_factory=dict, repr=False)   # what the page has of a part, drawn once

    def fill(self, smallest_gap: float, gfb: str | os.PathLike[str] | None) -> None:
        """Answers, margins and verdict by what there is of the parts."""
        for part in self.parts:
            if part.stem and part.name not in self.runs:
                self.runs[part.name] = read_run(part.stem, gfb, pictures=False) | {"points": read_history(f"{part.stem}.h5")}
        self.rows = rows_of(self.parts, self.runs, self.grade)
        self.margins = margins_of_parts(self.parts, self.runs, smallest_gap)
        point = self.runs.get("point")
        left = not_computed(Results(point["summary"], point["used"]), self.margins) if point else []
        self.verdict = sentence(self.margins, open_questions=left)
        asked = [part for part in self.parts if part.case is not None]
        done = sum(part.name in self.runs for part in asked)
        if done < len(asked):  # what has not been looked at may break a limit
            self.verdict = f"Not finished, {done} of {len(asked)} parts are done. {self.verdict}"

    def table(self) -> str:
        """The answers as a Markdown table."""
        lines = ["| question | answer | margin |", "| --- | --- | --- |",
                 *(f"| {question} | {answer} | {'**' if bad else ''}{verdict}{'**' if bad and verdict else ''} |"
                   for question, answer, verdict, bad in self.rows)]
        return "\n".join(lines) + "\n"

    def page(self, gfb: str | os.PathLike[str] | None = None) -> pathlib.Path:
        """Writes the page of the study. Tolerances are of the film that the operating point shows."""
        for part in self.parts:
            if part.stem and part.stem not in self.shown:
                self.shown[part.stem] = read_run(part.stem, gfb, title=part.question, pictures=part.name != "tolerances", curve=part.name != "point",
                                                 seconds=self.seconds)
        runs = [self.shown[part.stem] for part in self.parts if part.stem]
        return write_page(runs, self.folder/f"{self.name}.html", self.rows, self.name, self.margins, self.verdict)


def design(case: Case, folder: str | os.PathLike[str] = "design", name: str = "design", smallest_gap: float | None = None, grade: float = GRADE,
           processes: int = 1, gfb: str | os.PathLike[str] | None = None, tell: Callable[[str], None] = say, seconds: int = 0,
           filled: Callable[[Design], object] | None = None) -> Design:
    """Runs all parts of the study that apply to a case with a load; grade: of the rotor's balance [mm/s]; seconds: after which the program
    stops a part, and no other picture of it is begun, 0: none is; filled: called with what there is after each part. Raises CaseError where the case itself is wrong."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    parts = parts_of_machine(case, smallest_gap, gap_of(case, smallest_gap), grade, gfb) if is_machine(case) else parts_of(case, smallest_gap, grade)
    if parts[0].case is not None:  # what is wrong with the case itself is said
        parts[0].case.check(gfb=gfb)
    for part in parts:
        check_part(part, gfb)
    found, gap = Design(parts, [], folder, name, grade=grade, seconds=seconds), gap_of(case, smallest_gap)
    progress, lock = Progress(sum(part.case is not None for part in parts), tell, seconds), threading.Lock()

    def after(part: Part, result: Result | None, new: bool) -> None:
        if part.name == "point" and result is not None and result.converged and (words := tilt_words(case, result.summary)):
            progress.hints["misalignment"] = words
        with lock:  # what another part has found meanwhile is not on this page yet
            part.stem = result.stem if result is not None else None
            if filled is not None and new:
                found.fill(gap, gfb)
                filled(found)

    compute_all(parts, lambda part: folder/f"{name}_{part.name}", processes, gfb, progress, after)
    found.fill(gap, gfb)
    return found


def check_part(part: Part, gfb: str | os.PathLike[str] | None) -> None:
    """Leaves a part out whose case is wrong, in the program's words; keys without an effect go out of its tolerances."""
    while part.case is not None:
        try:
            part.case.check(gfb=gfb)
            break
        except CaseError as error:
            if not without_idle_keys(part.case, str(error)):
                part.case, part.left_out = None, " ".join(line.partition(": ")[2] for line in str(error).splitlines())


# --- the parts ---

def parts_of(case: Case, smallest_gap: float | None, grade: float) -> list[Part]:
    """All parts of the study; the first one is the operating point."""
    thrust = case.is_thrust()
    speed = float(case["operation%speed_rpm"])
    gap = gap_of(case, smallest_gap)
    whirl = "whirl over the speed" if "rotor%mass" in case else "critical mass over the speed"
    limits = {key: case[f"capacity%{key}"] for key in KEPT if f"capacity%{key}" in case}
    if smallest_gap or "capacity%smallest_gap" in case:  # else none is the case's own
        limits["smallest_gap"] = gap
    given: dict[str, Any] = {"capacity": limits} if limits else {}
    parts = [with_analysis(case, "point", "at the operating point", "linear_dynamics", ("dynamics", "rotor", "foil_damping"), **given)]
    if thrust:
        parts.append(Part("directions", "load from every direction", left_out="a runner is pressed along its axis"))
    else:
        angle = math.degrees(math.atan2(*reversed(case["operation%load"])))
        parts.append(with_analysis(case, "directions", "load from every direction", "equilibrium", sweep={
            "parameter": "load_angle", "values": tuple(angle + 360.0*i/DIRECTIONS for i in range(DIRECTIONS))}))
    parts += [
        with_analysis(case, "capacity", f"load capacity over the speed, to a film of {1.0e6*gap:.3g} um", "load_capacity",
                      capacity={"smallest_gap": gap}, sweep={"parameter": "speed_rpm", "values": tuple(part*speed for part in SPEEDS)}),
        with_analysis(case, "misalignment", f"misalignment left, to a film of {1.0e6*gap:.3g} um", "misalignment_allowance",
                      capacity={"smallest_gap": gap})]
    if "shaft_contact" in case.groups:
        carried: dict[str, Any] = {"capacity": {"contact_part": case["capacity%contact_part"]}} if "capacity%contact_part" in case else {}
        parts.append(with_analysis(case, "lift_off", "lift-off speed", "lift_off", **carried))
    else:
        parts.append(Part("lift_off", "lift-off speed", left_out="the case has no &shaft_contact: roughness and pressure of the asperities"))
    if thrust:
        parts.append(Part("whirl", whirl, left_out="a runner does not whirl along its axis"))
    else:
        parts.append(with_analysis(case, "whirl", whirl, "linear_dynamics", ("dynamics", "rotor", "foil_damping"), sweep={
            "parameter": "speed_rpm", "values": tuple(part*speed for part in WHIRL_SPEEDS)}))
    parts += [orbit_of(case, grade, speed, thrust, given), tolerances_of(case)]
    return parts


def gap_of(case: Case, smallest_gap: float | None) -> float:
    """The film at which a limit is reached [m]."""
    return smallest_gap or (float(case["capacity%smallest_gap"]) if "capacity%smallest_gap" in case else SMALLEST_GAP)


def orbit_of(case: Case, grade: float, speed: float, thrust: bool, given: dict[str, Any]) -> Part:
    """The steady orbit under the unbalance that a grade allows: mass times grade over the angular speed; given: limits of the case."""
    question = f"orbit under balance grade G {grade:g}"
    if thrust or "rotor%mass" not in case:
        return Part("orbit", question, left_out="a runner is not followed over time" if thrust else "the case has no &rotor with a mass")
    unbalance = float(case["rotor%mass"])*1.0e-3*grade/(speed*math.pi/30.0)
    return with_analysis(case, "orbit", question, "transient", ("rotor", "foil_damping"), unbalance={"unbalance": unbalance},
                         transient={"turns": ORBIT_TURNS, "steady_tolerance": ORBIT_STEADY}, **given)


def tolerances_of(case: Case) -> Part:
    """What a drawing leaves open, and what that does to the film."""
    there = {key: case[key] for key in TOLERANCES if key in case and isinstance(case[key], float) and case[key] > 0.0}
    if case.groups.get("model", {}).get("foil") == "rigid":
        there = {key: value for key, value in there.items() if not key.startswith(("bump_foil", "top_foil", "contact", "model"))}
    return with_analysis(case, "tolerances", "what tolerances do to the thinnest film", "equilibrium", sensitivity={
        "parameters": tuple(there), "quantity": "minimum_gap",
        "tolerances": tuple(length or part*abs(there[key]) for key, (length, part) in TOLERANCES.items() if key in there)})


def without_idle_keys(case: Case, complaint: str) -> bool:
    """Takes the keys that have no effect on the case out of its tolerances; whether there were some, and others are left."""
    idle = set(IDLE.findall(complaint))
    if not idle or "sensitivity%parameters" not in case:
        return False
    left = [both for both in zip(case.listed("sensitivity%parameters"), case.listed("sensitivity%tolerances")) if both[0] not in idle]
    if left:
        case["sensitivity%parameters"], case["sensitivity%tolerances"] = (tuple(one) for one in zip(*left))
    return bool(left)


# --- the answers ---

def rows_of(parts: Sequence[Part], runs: Mapping[str, dict[str, Any]], grade: float = GRADE) -> list[tuple[str, str, str, bool]]:
    """Question, answer, margin and whether it is a bad one, of all parts."""
    rows = []
    for part in parts:
        run = runs.get(part.name)
        if run is None:
            rows.append((part.question, *without_results(part)))
            continue
        if part.stopped:
            points = len(next(iter(run["points"].values()), ()))
            there = f"{LAST_STATE} is below" + (f"; {points} of {part.states} points" if part.states > 1 else "")
            rows.append((part.question, part.stopped, f"{there}; another call goes on", True))
        elif not run["converged"]:
            rows.append((part.question, NO_ANSWER, f"{why_none(run['summary'])}; {LAST_STATE} is below", True))
        elif part.name == "point":
            rows += run["glance"] if is_of_one_bearing(parts) else rows_of_point(run, grade)
        else:
            rows += ANSWERS[base_of(part.name)](part.question, run)
    return rows


def margins_of_parts(parts: Sequence[Part], runs: Mapping[str, dict[str, Any]], gap: float) -> list[Margin]:
    """The margins of all parts with an answer: those of a run, and of directions and speeds the worst, or that at the case's speed."""
    found: list[Margin] = []
    for part in parts:
        run = runs.get(part.name)
        if run is None or part.name == "tolerances":
            continue
        of_machine: dict[str, Any] = {"where": bearing_of(part.name)} | ({} if is_of_one_bearing(parts) else {"body": "machine"})
        if not run["converged"]:
            found.append(Margin(part.name.replace("_", "-"), part.question, STOPPED if part.stopped else NO_ANSWER))
        elif part.name == "directions":
            angles, films = column(run, "load_angle"), column(run, "minimum_gap")
            worst = first_of(films, min(films))
            found.append(compared("film", film_words(films[worst], f"under a load at {angles[worst] % 360.0:.0f} deg"),
                                  f"{1.0e6*gap:.3g} um are wanted", films[worst]/gap, "load from every direction"))
        elif base_of(part.name) == "capacity":
            found += [dataclasses.replace(margin, **of_machine) for margin in [margin_of_capacity(run)] if margin.limit]
        elif base_of(part.name) in ("whirl", "campbell"):  # its own speed is that of the operating point
            found += [dataclasses.replace(one, **of_machine) for one in run["margins"] if one.result == ONSET]
        elif is_machine(run["used"]):
            found += run["margins"]
        else:
            own = margins_of(Results(run["summary"], run["used"], run["place"]), gap)
            if part.name in ("misalignment", "lift_off"):  # where nobody runs it
                own = [one for one in own if one.subject not in ("temperature", "stress")]
            found += own if part.name == "point" else [dataclasses.replace(one, where=part.question) for one in own]
    return found


def at_own_speed(run: dict[str, Any]) -> int:
    """The point of a sweep that is nearest to the case's speed."""
    speeds, own = column(run, "speed_rpm"), float(run["used"]["operation%speed_rpm"])
    return min(range(len(speeds)), key=lambda i: abs(speeds[i] - own))


def without_results(part: Part) -> tuple[str, str, bool]:
    """Answer and margin of a part of which there is nothing: left out, stopped, or to come."""
    if part.stopped:
        return part.stopped, "before there was a state; another call goes on", True
    return ("left out", part.left_out, False) if part.case is None else ("not computed yet", "", False)


def column(run: dict[str, Any], name: str) -> list[float]:
    """A column of the points; empty where there is none."""
    return [float(value) for value in run["points"].get(name, ())]


def first_of(values: Sequence[float], value: float) -> int:
    """The first place of a value: pads that are alike have it once each, but for rounding."""
    return next(i for i, one in enumerate(values) if abs(one - value) <= SAME*abs(value))


def answer_directions(question: str, run: dict[str, Any]) -> list[tuple[str, str, str, bool]]:
    """The direction in which the film is thinnest."""
    angles, films = column(run, "load_angle"), column(run, "minimum_gap")
    worst, best = first_of(films, min(films)), first_of(films, max(films))
    return [(question, film_words(films[worst], f"with it at {angles[worst] % 360.0:.0f} deg"),
             f"{1.0e6*films[best]:.4g} um at {angles[best] % 360.0:.0f} deg", False)]


def margin_of_capacity(run: dict[str, Any]) -> Margin:
    """The capacity at the speed of the case, against its load where it has one."""
    wanted, there = carried_by(run["used"]), at_own_speed(run)
    capacity = column(run, "load_capacity")[there]
    words = f"load capacity {capacity:.4g} N at {column(run, 'speed_rpm')[there]:,.0f} rpm"
    return compared("load", words, f"the load is {wanted:.4g} N", capacity/wanted) if wanted else Margin("load", words)


def answer_capacity(question: str, run: dict[str, Any]) -> list[tuple[str, str, str, bool]]:
    """Capacities over the speed, and the margin at that of the case."""
    speeds, loads = column(run, "speed_rpm"), column(run, "load_capacity")
    margin, there = margin_of_capacity(run), at_own_speed(run)
    others = ", ".join(f"{load:.4g} N at {speed:,.0f}" for speed, load in zip(speeds, loads))
    return [(question, f"{loads[there]:.4g} N at {speeds[there]:,.0f} rpm", margin.against, margin.is_broken),
            ("", others + " rpm", "", False)]


def answer_whirl(question: str, run: dict[str, Any]) -> list[tuple[str, str, str, bool]]:
    """Critical masses and growth over the speed."""
    speeds, masses, growth = column(run, "speed_rpm"), column(run, "critical_mass"), column(run, "growth_rate")
    rows = []
    least = [i for i, mass in enumerate(masses) if mass == mass]
    if least:
        at = min(least, key=masses.__getitem__)
        rows.append((question, f"smallest critical mass {masses[at]:.4g} kg at {speeds[at]:,.0f} rpm", "", False))
    grows = [speeds[i] for i, rate in enumerate(growth) if rate >= 0.0]
    if growth:
        onset = run["summary"].get("onset_speed_rpm", {}).get("value", math.nan)
        words = f"onset at {onset:,.0f} rpm" if onset == onset else ("grows at " if grows else "dies out at all ") + \
            (", ".join(f"{speed:,.0f}" for speed in grows) if grows else f"{min(speeds):,.0f} to {max(speeds):,.0f}") + " rpm"
        margin = next((one for one in run["margins"] if one.result == ONSET), None)
        own = float(run["used"]["operation%speed_rpm"])
        rows.append(("the rotor's vibrations", words, margin.against if margin else "", margin.is_broken if margin else bool(grows) and min(grows) <= own))
    return rows or [(question, "no number", "see its log", False)]


def answer_orbit(question: str, run: dict[str, Any]) -> list[tuple[str, str, str, bool]]:
    """The orbit's size, and the film that is left."""
    size = {axis: run["summary"][f"orbit_{axis}"]["value"] for axis in "xy"}
    film, ending = run["summary"]["minimum_gap_over_time"]["value"], run["summary"].get("not_reached", {}).get("value", "")
    return [(question, f"{1.0e6*size['x']:.3g} x {1.0e6*size['y']:.3g} um", film_words(film) + (f"; not reached: {ending}" if ending else ""),
             bool(ending))]


def share_of(case: Case, key: str, tolerance: float) -> str:
    """A tolerance as a share of its key, which needs no unit; as it is where the key has not one value."""
    value = case.get(key)
    return f"{100.0*tolerance/abs(value):.2g} %" if isinstance(value, (int, float)) and value else f"{tolerance:.2g}"


def answer_tolerances(question: str, run: dict[str, Any]) -> list[tuple[str, str, str, bool]]:
    """The spread of the film, and the three keys that do most of it."""
    case, summary = run["used"], run["summary"]
    names = re.findall(r"\w+%\w+", " ".join(map(str, case.listed("sensitivity%parameters"))))
    tolerances = dict(zip(names, case.listed("sensitivity%tolerances")))
    shares = sorted(((abs(summary[f"d_minimum_gap_d_{key.replace('%', '_')}"]["value"])*value, key) for key, value in tolerances.items()
                     if f"d_minimum_gap_d_{key.replace('%', '_')}" in summary), reverse=True)
    spread = summary.get("standard_deviation_minimum_gap", {}).get("value", math.sqrt(sum(share**2 for share, _ in shares)))
    most = ", ".join(f"{key} {1.0e6*share:.2g} um (for {share_of(case, key, tolerances[key])})" for share, key in shares[:3])
    return [(question, f"± {1.0e6*spread:.2g} um, one standard deviation", most, spread > 0.5*summary["minimum_gap"]["value"])]


def answer_limit(question: str, run: dict[str, Any]) -> list[tuple[str, str, str, bool]]:
    """The row of a limit."""
    rows = [row for row in run["glance"] if row[0] in ("misalignment left", "lift-off speed")]
    return [(question, answer, verdict, bad) for _, answer, verdict, bad in rows]


ANSWERS = {"directions": answer_directions, "capacity": answer_capacity, "whirl": answer_whirl, "orbit": answer_orbit,
           "tolerances": answer_tolerances, "campbell": answer_campbell, "misalignment": answer_limit, "lift_off": answer_limit}


def main() -> int:
    """The command."""
    parser = parser_of("tools/design", __doc__)
    parser.add_argument("case", type=pathlib.Path, metavar="CASE.nml", help="a bearing with a load, or a machine")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="DIR", help="folder; default: results/CASE.design")
    parser.add_argument("--smallest-gap", type=float, metavar="M", help=f"film at which a limit is reached [m]; default: the case's, or {SMALLEST_GAP:g}")
    parser.add_argument("--grade", type=float, default=GRADE, metavar="G", help=f"balance grade of the rotor, ISO 21940 [mm/s]; default: {GRADE:g}")
    parser.add_argument("--seconds", type=seconds_of, default=0, metavar="S",
                        help="stop a part after so many seconds, and keep what it has, and its pictures after as many; default: none is")
    parser.add_argument("--processes", type=int, default=max(1, (os.cpu_count() or 2)//2), metavar="N", help="parts at a time")
    parser.add_argument("--gfb", help="the program; default: as gfb from Python finds it")
    options = parser.parse_args()
    draw_into_files()
    page = None

    def fill(found: Design) -> None:
        nonlocal page
        began, first = time.monotonic(), page is None
        page = found.page(options.gfb)
        drawn = f"drawn in {duration(time.monotonic() - began)}"
        if first or options.seconds:
            say(f"{page} is there and fills: {drawn}" if first else f"the page is {drawn}")

    try:
        case = Case.read(options.case)
        if not is_machine(case) and "operation%axial_load" not in case and "operation%load" not in case:
            raise CaseError(f"{options.case}: a study needs a load in &operation")
        found = design(case, options.output or pathlib.Path("results")/f"{options.case.stem}.design", options.case.stem,
                       options.smallest_gap, options.grade, options.processes, options.gfb, seconds=options.seconds, filled=fill)
    except CaseError as error:
        print(error, file=sys.stderr)
        return 1
    except (KeyboardInterrupt, RunError):
        say(f"stopped: {f'{page} has what there is; ' if page else ''}the same command goes on from here")
        raise
    print(f"{found.verdict}\n")
    print(found.table())
    print(f"written: {found.page(options.gfb)}")
    return 0


def seconds_of(words: str) -> int:
    """A limit of time: a whole number of seconds above zero."""
    if not words.isdigit() or int(words) == 0:
        raise argparse.ArgumentTypeError(f"{words}: a whole number of seconds above zero")
    return int(words)
