"""`gfb.optimize`: the best values of keys by the program's derivatives (`&sensitivity`), under bounds on results."""

from __future__ import annotations

import csv
import dataclasses
import hashlib
import importlib
import math
import os
import pathlib
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Union

import numpy

from gfb import bundle
from gfb.case import Case, CaseError
from gfb.members import find_member, run_member
from gfb.program import WRONG_INPUT, find_program, unit_of_key
from gfb.running import Result
from gfb.tables import plain_table, readable, readable_unit
from gfb.tool import say, without

Bounds = tuple["float | None", "float | None"]
Quantity = Union[str, Callable[[Case], float]]  # a result, or a closed form

TOLERANCE = 1.0e-4         # of the objective over its value at the start, and of bounds over themselves
MOST_RUNS = 200
STEP = 1.0e-5              # of a variable's range: central differences of closed forms
ELEMENT = re.compile(r"(\w+%\w+)(?:\((\d+|:)\))?")
LOAD = "operation%load"    # its magnitude is meant
METHODS = ("bundle", "SLSQP")


@dataclasses.dataclass
class Variable:
    """What is varied: keys, or elements of lists, that share one value."""

    name: str
    places: Sequence[tuple[str, int | None]]  # key, number in its list
    low: float
    high: float
    start: float

    def put(self, case: Case, value: float) -> None:
        """Writes a value into a case."""
        for key, number in self.places:
            if number is not None:
                values: list[Any] = list(case.listed(key))
                values[number - 1] = value
                case[key] = tuple(values)
            elif key == LOAD:
                force = [float(part) for part in case[key]]
                case[key] = tuple(part*value/math.hypot(*force) for part in force)
            else:
                case[key] = value


@dataclasses.dataclass(eq=False)
class Run:
    """One set of values and what the program said."""

    variables: numpy.ndarray              # 0 at the lower bounds, 1 at the upper ones
    values: dict[str, float]              # of objective and constraints; empty where there is no answer
    gradients: dict[str, numpy.ndarray]   # by the variables
    units: dict[str, str]
    stem: pathlib.Path                    # of its files
    words: str = ""                       # why there is no answer


@dataclasses.dataclass
class Row:
    """A variable or a result, before and after."""

    name: str
    unit: str
    before: float
    after: float
    low: float | None
    high: float | None
    at: str            # the bound that it has reached, or broken; empty: none


@dataclasses.dataclass
class Optimum:
    """What was found."""

    case: Case                       # the best one
    variables: list[Row]
    results: list[Row]               # the objective first
    finer: list[Row]                 # the same results by plain runs on the finer mesh
    runs: list[Run]                  # all of them, in their order
    computed: int                    # of these now; the others were there
    within: bool                     # whether the best one keeps all bounds
    ending: str                      # why the search ended

    @property
    def no_answer(self) -> int:
        """Runs that gave none."""
        return sum(not run.values for run in self.runs)

    @property
    def active(self) -> list[str]:
        """Variables and constraints at a bound."""
        return [row.name for row in (*self.variables, *self.results) if row.at]

    def table(self) -> str:
        """The answer in words and numbers."""
        heads = ["name", "unit", "before", "after", "lower", "upper", "at"]
        text = plain_table("results", heads, cells(self.results)) + "\n" + plain_table("variables", heads, cells(self.variables))
        if self.finer:
            text += "\n" + plain_table("results on the finer mesh", heads, cells(self.finer))
            text += f"change of {self.finer[0].name}: {change(self.results[0])}, on the finer mesh {change(self.finer[0])}\n"
        text += f"\n{len(self.runs)} runs, {self.no_answer} without an answer, {self.computed} computed now; ended: {self.ending}\n"
        return text if self.within else text + "no run keeps all bounds: this is the one that breaks them least\n"


def cells(rows: Sequence[Row]) -> list[list[str]]:
    """Rows of a table, in units that people read."""
    table = []
    for row in rows:
        unit, scale = readable_unit(row.unit, row.name)
        numbers = (row.before, row.after, row.low, row.high)
        table.append([row.name, unit, *("" if number is None else f"{number*scale:.5g}" for number in numbers), row.at])
    return table


def change(row: Row) -> str:
    """By how much a value has changed."""
    return f"{100.0*(row.after/row.before - 1.0):+.3g} %" if row.before else f"{row.after - row.before:.4g} {row.unit}"


class Enough(Exception):
    """The search may run no more."""


# --- the search ---

def optimize(case: Case, *, minimize: Quantity | None = None, maximize: Quantity | None = None, vary: Mapping[str, tuple[float, float]],
             subject_to: Mapping[Quantity, Bounds] | None = None, folder: str | os.PathLike[str] = "optimize", name: str = "optimize",
             method: str = "bundle", tolerance: float = TOLERANCE, most_runs: int = MOST_RUNS, finer: Mapping[str, Any] | None = None,
             gfb: str | os.PathLike[str] | None = None, tell: Callable[[str], None] = say) -> Optimum:
    """The values of keys, each between two bounds, that make a result smallest or largest while others keep theirs.

    A result has derivatives by `&sensitivity`, or is a function of the case, a closed form. finer: keys of the mesh on which the change is
    checked by plain runs; by default twice the elements, empty: no check. Runs are kept: called again, the same case is not run twice.
    Raises CaseError where the case, or what is asked for, is wrong, or the start has no answer."""
    try:
        importlib.import_module("scipy")
    except ModuleNotFoundError as error:
        raise without("gfb.optimize", error) from None
    if (minimize is None) == (maximize is None):
        raise CaseError("gfb.optimize: name one of minimize and maximize")
    if method not in METHODS:
        raise CaseError(f"gfb.optimize: method = {method!r}: must be one of {', '.join(METHODS)}")
    wanted: Quantity = minimize if minimize is not None else maximize  # type: ignore[assignment]
    bounds = dict(subject_to or {})
    runner = Runner(case, variables_of(case, vary), list(dict.fromkeys([wanted, *bounds])), pathlib.Path(folder), name, gfb, most_runs, tell)
    start = runner.start()
    goal = Goal(start, word(wanted), 1.0 if maximize is None else -1.0, {word(key): pair for key, pair in bounds.items()}, tolerance)
    runner.goal = goal
    runner.report(start)
    try:
        if method == "bundle":
            ending = bundle.minimise(lambda place: scaled(goal, runner.at(place)), start.variables, tolerance)
        else:
            ending = slsqp(runner, goal, start.variables, tolerance)
    except Enough:
        ending = f"after {most_runs} runs"
    best = goal.best(runner.runs)
    runner.keep_list(goal)
    return Optimum(runner.case_at(best.variables), variable_rows(runner, best, tolerance), result_rows(goal, start, best),
                   finer_rows(runner, goal, start, best, finer), runner.runs, runner.computed, goal.worst(best) <= tolerance, ending)


def scaled(goal: Goal, run: Run) -> tuple[numpy.ndarray, numpy.ndarray] | None:
    """What the search sees of a run."""
    return goal.of(run) if run.values else None


def slsqp(runner: Runner, goal: Goal, start: numpy.ndarray, tolerance: float) -> str:
    """SciPy's sequential quadratic programming. Without an answer the objective is infinite, so that its line search steps back; it asks
    for gradients only where that has ended."""
    from scipy.optimize import minimize
    count = goal.count()

    def seen(place: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
        found = scaled(goal, runner.at(numpy.clip(place, 0.0, 1.0)))
        return found or (numpy.append(math.inf, numpy.zeros(count)), numpy.full((count + 1, start.size), math.nan))

    def slope(place: numpy.ndarray) -> numpy.ndarray:
        gradients = seen(place)[1]
        if not numpy.isfinite(gradients).all():
            raise Enough
        return gradients

    kept = {"type": "ineq", "fun": lambda place: -seen(place)[0][1:], "jac": lambda place: -slope(place)[1:]}
    try:
        done = minimize(lambda place: seen(place)[0][0], start, jac=lambda place: slope(place)[0], method="SLSQP",
                        bounds=start.size*[(0.0, 1.0)], options={"ftol": tolerance, "maxiter": runner.most_runs},
                        constraints=[kept] if count else ())
    except Enough:
        if len(runner.runs) >= runner.most_runs:
            raise
        return "the steps tried have no answer"
    return str(done.message)


@dataclasses.dataclass
class Goal:
    """Objective and bounds in numbers of the size of one."""

    start: Run
    objective: str
    sign: float                   # -1: the largest value is wanted
    bounds: dict[str, Bounds]
    tolerance: float

    def size_of(self, name: str, bound: float | None = None) -> float:
        """What a result is divided by: its bound, or its value at the start."""
        return abs(bound or 0.0) or abs(self.start.values[name]) or 1.0

    def sides(self) -> list[tuple[str, float, float]]:
        """Result, bound and sign of each constraint, sign times (result - bound) not positive."""
        return [(name, bound, sign) for name, pair in self.bounds.items() for bound, sign in zip(pair, (-1.0, 1.0)) if bound is not None]

    def count(self) -> int:
        """Number of constraints."""
        return len(self.sides())

    def of(self, run: Run) -> tuple[numpy.ndarray, numpy.ndarray]:
        """Objective and constraints of a run with an answer, and their gradients."""
        size = self.sign/self.size_of(self.objective)
        values, gradients = [size*run.values[self.objective]], [size*run.gradients[self.objective]]
        for name, bound, sign in self.sides():
            size = sign/self.size_of(name, bound)
            values.append(size*(run.values[name] - bound))
            gradients.append(size*run.gradients[name])
        return numpy.array(values), numpy.array(gradients)

    def worst(self, run: Run) -> float:
        """The largest violation of a bound, over the bound."""
        return bundle.worst(self.of(run)[0])

    def best(self, runs: Sequence[Run]) -> Run:
        """The best run that keeps all bounds; where none does, the one that breaks them least."""
        answers = [run for run in runs if run.values]
        kept = [run for run in answers if self.worst(run) <= self.tolerance]
        return min(kept, key=lambda run: self.of(run)[0][0]) if kept else min(answers, key=self.worst)


# --- runs ---

class Runner:
    """Runs cases and remembers them."""

    def __init__(self, case: Case, variables: Sequence[Variable], quantities: Sequence[Quantity], folder: pathlib.Path, name: str,
                 gfb: str | os.PathLike[str] | None, most_runs: int, tell: Callable[[str], None]) -> None:
        if "sweep" in case.groups:
            raise CaseError("gfb.optimize: the case has a &sweep; its results are those of one point")
        self.case, self.variables, self.quantities = case, variables, quantities
        self.folder, self.name, self.gfb, self.most_runs, self.tell = folder, name, gfb, most_runs, tell
        self.goal: Goal | None = None
        self.runs: list[Run] = []
        self.known: dict[bytes, Run] = {}
        self.computed = 0
        folder.mkdir(parents=True, exist_ok=True)

    def case_at(self, place: numpy.ndarray) -> Case:
        """The case with values of the variables."""
        case = self.case.copy()
        case.groups.pop("sensitivity", None)
        for variable, part in zip(self.variables, place):
            variable.put(case, variable.low + float(part)*(variable.high - variable.low))
        return case

    def start(self) -> Run:
        """The run of the case as it stands; raises what is wrong with it."""
        place = numpy.array([(one.start - one.low)/(one.high - one.low) for one in self.variables])
        run = self.at(place)
        if run.values:
            return run
        raise CaseError(f"gfb.optimize: the case as it stands is no start: {run.words}")

    def at(self, place: numpy.ndarray) -> Run:
        """The run at values of the variables; Enough where it would be one too many."""
        if place.tobytes() not in self.known:
            if len(self.runs) >= self.most_runs:
                raise Enough
            run = self.run(place.copy())
            self.known[place.tobytes()] = run
            self.runs.append(run)
            if self.goal:
                self.report(run)
        return self.known[place.tobytes()]

    def asked(self, case: Case) -> Case:
        """The case with the derivatives that are wanted."""
        names = tuple(quantity for quantity in self.quantities if isinstance(quantity, str))
        keys = dict.fromkeys(key if number is None else f"{key}({number})" for one in self.variables for key, number in one.places)
        if names:
            case.groups["sensitivity"] = {"quantity": names, "parameters": tuple(keys)}
        return case

    def run(self, place: numpy.ndarray) -> Run:
        """Runs a case, or finds it; a rule that it breaks is no answer, too."""
        plain = self.case_at(place)
        result = self.member(self.asked(plain.copy()))
        run = Run(place, {}, {}, result.units, result.stem, words_of(result))
        if not result.converged:
            return run
        try:
            told = {word(quantity): self.told(quantity, place, result.summary) for quantity in self.quantities}
        except KeyError as error:
            run.words = error.args[0]
            return run
        run.values = {name: value for name, (value, _) in told.items()}
        run.gradients = {name: gradient for name, (_, gradient) in told.items()}
        return run

    def member(self, case: Case) -> Result:
        """What is left of a case, which is named by its text."""
        stem = self.folder/f"{self.name}_{hashlib.sha256(str(case).encode()).hexdigest()[:12]}"
        found = find_member(case, stem, self.gfb)
        if found is None:
            self.computed += 1
            try:
                found = run_member(case, stem, self.gfb, self.tell)
            except CaseError as error:
                return Result(WRONG_INPUT, "", str(error), stem, {}, {})
        return found

    def told(self, quantity: Quantity, place: numpy.ndarray, summary: Mapping[str, Any]) -> tuple[float, numpy.ndarray]:
        """Value and gradient by the variables, which go from 0 to 1; KeyError, in words, where one of them is missing."""
        if not isinstance(quantity, str):
            sides = [place + numpy.outer((-STEP, STEP), row) for row in numpy.eye(place.size)]
            return quantity(self.case_at(place)), numpy.array([(quantity(self.case_at(up)) - quantity(self.case_at(down)))/(2.0*STEP)
                                                               for down, up in sides])
        if quantity not in summary:
            raise KeyError(f"the answer has no {quantity}")
        gradient = []
        for one in self.variables:
            names = [f"d_{quantity}_d_{key.replace('%', '_')}" + (f"_{number}" if number else "") for key, number in one.places]
            for name in names:
                if not math.isfinite(summary.get(name, math.nan)):
                    raise KeyError(f"no derivative: {name}")
            gradient.append((one.high - one.low)*sum(summary[name] for name in names))
        return summary[quantity], numpy.array(gradient)

    def report(self, run: Run) -> None:
        """A line of progress."""
        results = ", ".join(f"{name} {' '.join(filter(None, shown(value, run.units.get(name, ''), name)))}" for name, value in run.values.items())
        best = self.goal and self.goal.best(self.runs)
        self.tell(f"run {len(self.runs)}: {results or run.words.partition(chr(10))[0]}" + (" (best)" if run is best else ""))

    def keep_list(self, goal: Goal) -> None:
        """All runs as a table beside their files."""
        with open(self.folder/f"{self.name}.csv", "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["run", "files", *(one.name for one in self.variables), *goal.start.values])
            for number, run in enumerate(self.runs):
                values = [one.low + part*(one.high - one.low) for one, part in zip(self.variables, run.variables)]
                writer.writerow([number + 1, run.stem.name, *values, *(run.values.get(name, "") for name in goal.start.values)])


def shown(value: float, unit: str, name: str) -> tuple[str, str]:
    """A result in a unit that people read."""
    number, unit = readable(value, unit, name)
    return f"{number:.5g}", unit


def words_of(result: Result) -> str:
    """Why there is no answer; empty where there is one."""
    return "" if result.converged else result.complaint if result.status == WRONG_INPUT else f"no answer, {result.stem.name}.summary"


def word(quantity: Quantity) -> str:
    """What a result is called."""
    return quantity if isinstance(quantity, str) else quantity.__name__


def variables_of(case: Case, vary: Mapping[str, tuple[float, float]]) -> list[Variable]:
    """The variables of a search: keys, elements of lists, several with commas that share a value; (:) is a variable an element."""
    variables = []
    for name, (low, high) in vary.items():
        parts = [ELEMENT.fullmatch(part.strip().lower()) for part in name.split(",")]
        if not all(parts) or not low < high:
            raise CaseError(f"gfb.optimize: {name!r}: ({low}, {high}): must be group%key, or an element group%key(3) or all (:) of a list, "
                            "with a lower and a higher bound")
        keys = [(str(part[1]), part[2]) for part in parts if part]
        for key, _ in keys:
            if key not in case:
                raise CaseError(f"gfb.optimize: {key} must stand in the case")
        if any(number == ":" for _, number in keys):
            counts = {len(case.listed(key)) for key, _ in keys}
            if len(counts) > 1:
                raise CaseError(f"gfb.optimize: {name}: lists of {' and '.join(map(str, sorted(counts)))} values share none")
            for i in range(1, counts.pop() + 1):
                places = [(key, i if number == ":" else int(number)) for key, number in keys]
                variables.append(variable_of(case, ", ".join(f"{key}({k})" for key, k in places), places, low, high))
        else:
            variables.append(variable_of(case, name, [(key, int(number) if number else None) for key, number in keys], low, high))
    if not variables:
        raise CaseError("gfb.optimize: nothing is varied")
    return variables


def variable_of(case: Case, name: str, places: Sequence[tuple[str, int | None]], low: float, high: float) -> Variable:
    """One variable; it starts at the mean of what stands in the case."""
    values: list[Any] = []
    for key, number in places:
        if number is None and key == LOAD:
            values.append(math.hypot(*case[key]))
        elif number is None:
            values.append(case[key])
        elif not 1 <= number <= len(case.listed(key)):
            raise CaseError(f"gfb.optimize: {key}({number}): the case has {len(case.listed(key))} values of it")
        else:
            values.append(case.listed(key)[number - 1])
    if not all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        raise CaseError(f"gfb.optimize: {name}: must be a number; of a list say which, (3), or all, (:)")
    start = float(numpy.mean(values))
    if not 0.0 < start and (LOAD, None) in places:
        raise CaseError("gfb.optimize: a load of zero has no direction")
    if not low <= start <= high:
        raise CaseError(f"gfb.optimize: {name}: starts at {start:g}, must be within its bounds {low:g} and {high:g}")
    return Variable(name, places, float(low), float(high), start)


# --- the answer ---

def used_of(run: Run) -> pathlib.Path:
    """The case file of a run with all its defaults."""
    return run.stem.with_name(run.stem.name + ".used.nml")


def variable_rows(runner: Runner, best: Run, tolerance: float) -> list[Row]:
    """Variables before and after, with the units that the program says."""
    rows, gfb = [], find_program(runner.gfb)
    for one, part in zip(runner.variables, best.variables):
        at = "lower" if part <= tolerance else "upper" if part >= 1.0 - tolerance else ""
        rows.append(Row(one.name, unit_of_key(gfb, one.places[0][0]), one.start, one.low + float(part)*(one.high - one.low), one.low, one.high, at))
    return rows


def result_rows(goal: Goal, start: Run, best: Run) -> list[Row]:
    """Results before and after, the objective first; at a bound within ten tolerances, which is where a search stops."""
    rows = []
    for name in dict.fromkeys([goal.objective, *goal.bounds]):
        low, high = goal.bounds.get(name, (None, None))
        at = ""
        for bound, side, sign in ((low, "lower", -1.0), (high, "upper", 1.0)):
            if bound is not None:
                beyond = sign*(best.values[name] - bound)/goal.size_of(name, bound)
                at = f"{side}, broken" if beyond > goal.tolerance else side if beyond >= -10.0*goal.tolerance else at
        rows.append(Row(name, best.units.get(name, ""), start.values[name], best.values[name], low, high, at))
    return rows


def finer_rows(runner: Runner, goal: Goal, start: Run, best: Run, finer: Mapping[str, Any] | None) -> list[Row]:
    """The results of both ends by plain runs on a finer mesh; not a number where one has no answer."""
    if finer is None:
        mesh = Case.read(used_of(start)).groups["mesh"]
        finer = {f"mesh%{key}": 2*value for key, value in mesh.items() if key.endswith("_elements") and isinstance(value, int)}
    if not finer:
        return []
    ends = []
    for run in (start, best):
        case = runner.case_at(run.variables)
        for key, value in finer.items():
            case[key] = value
        result = runner.member(case)
        answer = result.summary if result.converged else {}
        values = {word(one): answer.get(one, math.nan) if isinstance(one, str) else one(case) for one in runner.quantities}
        ends.append(Run(run.variables, values, {}, result.units, result.stem, words_of(result)))
        runner.tell(f"finer mesh: {words_of(result) or f'{result.stem.name}.summary'}")
    return result_rows(goal, *ends)
