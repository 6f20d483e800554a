"""Runs of tools/bench population: how a member ends, what that costs, and whether a refusal is shown a second way."""

import math
import os
import pathlib
import resource
import signal
import subprocess
import tempfile

from gfb.program import DONE, ENVIRONMENT, NOT_CONVERGED, WRONG_INPUT, command_of
from gfb.results import read_history, read_summary
from gfb.running import write_case

ANSWER, NO_REASON, GAVE_UP, BOUND, BROKEN, INVALID = "answer", "lost", "gave up", "CPU bound", "broke off", "wrong input"
REFUSALS = {"touch-down": ("touches down",), "fold": ("ends in a fold",), "emptied": ("film is emptied",),
            "suction": ("draws the free edge",), "heated": ("no steady temperature",)}
SUCTION, HEATED = "suction", "heated"
OUTCOMES = (ANSWER, *REFUSALS, NO_REASON, GAVE_UP, BOUND, BROKEN, INVALID)
NOT_FOUND = ("no equilibrium found", "no answer found")  # what the log says where there is no answer
TOUCH_DOWN_SHARE = 1.0e-4  # touch_down_gap over the clearance, by default
BY_SIGNAL = 128            # plus the signal's number: the status of a run that a signal has stopped
THIN = 2.0                 # a film this many times touch_down_gap has touched down
RISING = (0.1, 0.25, 0.5, 0.75, 1.0)  # of the load or the speed, in the sweeps that must stop
LIGHTER = (0.003, 0.01, 0.03, 0.1, 0.25, 0.5, 0.75, 1.0)  # where a tenth of the load has no answer either
FALLING = (4.0, 2.5, 1.6, 1.25, 1.0)
SLOWER = (2.0, 1.6, 1.3, 1.15, 1.0)   # of the speed, where the film thins as it falls
TURNED = tuple(7.5*step for step in range(12, -1, -1))  # of the load's direction, from where it has an answer [deg]
TURNED_BACK = tuple(-angle for angle in TURNED)
BY_GAP, BELOW, AGAINST, OPEN = "by its last film", "by a fold below it", "contradicted", "not shown"
THINNER = (4.0, 3.0, 2.5, 2.0, 1.6, 1.3, 1.15, 1.0)  # of a foil's thickness, from where it is stiff
TOP_FOIL, BUMP_FOIL = "top_foil%thickness", "bump_foil%thickness"
BY_SWEEP = {"load": "by a load sweep", "speed_rpm": "by a speed sweep", "load_angle": "by a turned load",
            TOP_FOIL: "by a thicker foil", BUMP_FOIL: "by a thicker foil"}
REST = (("load_angle", TURNED), ("load_angle", TURNED_BACK), (TOP_FOIL, THINNER), (BUMP_FOIL, THINNER))
SWEEPS = {"touch-down": (("load", RISING), ("speed_rpm", SLOWER), ("load", LIGHTER), *REST),
          "emptied": (("load", RISING), ("speed_rpm", SLOWER), *REST),
          "fold": (("load", RISING), ("speed_rpm", RISING), ("speed_rpm", SLOWER), *REST),
          HEATED: (("speed_rpm", RISING),),
          SUCTION: (("load", FALLING), ("load", RISING), ("speed_rpm", RISING), *REST)}
CHEAP, LEAST = 3.0, 30.0  # CPU time of a sweep: times that of the run that is to be shown, at least [s]
SECOND_WAYS = (BY_GAP, *dict.fromkeys(BY_SWEEP.values()), BELOW, AGAINST, OPEN)


def run_bounded(gfb, path, folder, seconds):
    """Runs a case file on one rank, for so many seconds of CPU time at most; status, log, CPU time."""
    def bound():
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 5))

    with open(pathlib.Path(folder)/"log", "w+", encoding="utf-8", errors="replace") as log:
        process = subprocess.Popen(command_of(gfb, path, folder, options=()), stdin=subprocess.DEVNULL,
                                   stdout=log, stderr=subprocess.STDOUT, preexec_fn=bound,
                                   env={**ENVIRONMENT, **os.environ})
        _, status, usage = os.wait4(process.pid, 0)  # its own usage, whatever else runs
        process.returncode = os.waitstatus_to_exitcode(status)
        log.seek(0)
        return process.returncode, log.read(), usage.ru_utime + usage.ru_stime


def reason_in(log):
    """The sentence of a run without an answer, on one line."""
    for line in log.splitlines():
        if any(words in line for words in NOT_FOUND):
            return line.strip()
    lines = [line.strip() for line in log.splitlines() if line.strip()]
    return lines[-1][:200] if lines else ""


def outcome_of(status, log):
    """A word for how a run ended."""
    if status == DONE:
        return ANSWER
    if status == WRONG_INPUT:
        return INVALID
    if status in (-signal.SIGXCPU, -signal.SIGKILL, BY_SIGNAL + signal.SIGXCPU):
        return BOUND
    if status != NOT_CONVERGED:
        return BROKEN
    reason = reason_in(log)
    nameless = GAVE_UP if "factorizations (maximum_factorizations" in reason else NO_REASON
    return next((name for name, sentences in REFUSALS.items() if any(words in reason for words in sentences)), nameless)


def try_case(gfb, groups, seconds):
    """How a case ends and what it costs."""
    with tempfile.TemporaryDirectory() as folder:
        path = write_case(folder, "case", groups)
        status, log, cpu = run_bounded(gfb, path, folder, seconds)
        outcome = outcome_of(status, log)
        row = {"outcome": outcome, "status": status, "cpu": cpu, "summary": {},
               "reason": reason_in(log) if status == NOT_CONVERGED else "", "enlarged": log.count("workspace was too small")}
        file = pathlib.Path(folder)/("case.summary" if outcome == ANSWER else "case.unconverged.summary")
        if file.exists():
            row["summary"] = {name: value for name, value in read_summary(file)[0].items() if isinstance(value, float)}
        if "sweep" in groups and file.with_suffix(".h5").exists():
            row["points"] = points_of(file.with_suffix(".h5"))
    return row


def points_of(file):
    """How many points of a sweep have an answer."""
    try:
        return len(read_history(file)["force_x"])
    except KeyError:  # there is no history without a point
        return 0


def shows_itself(member, row):
    """Whether the last film of a touch-down is as thin as that says."""
    thin = THIN*TOUCH_DOWN_SHARE*member.groups["bearing"]["clearance"]
    return row["outcome"] == "touch-down" and row["summary"].get("minimum_gap", math.inf) <= thin


def second_way(gfb, member, row):
    """Whether a refusal is shown another way, and the CPU time of that."""
    if row["outcome"] not in REFUSALS:
        return "", 0.0
    if shows_itself(member, row):
        return BY_GAP, 0.0
    spent = 0.0
    for parameter, shares in SWEEPS[row["outcome"]]:
        if parameter == TOP_FOIL and "contact" not in member.groups:
            break  # an elastic foundation
        again = try_case(gfb, swept(member, parameter, shares), max(LEAST, CHEAP*row["cpu"]))
        spent += again["cpu"]
        if again["outcome"] == ANSWER:
            return AGAINST, spent
        if again.get("points", 0) == 0:
            continue
        if again["outcome"] in ends_of(row["outcome"], parameter):
            return BY_SWEEP[parameter], spent
        if again["outcome"] == "fold" and shares is LIGHTER:
            return BELOW, spent  # no film of that branch is so thin: it ends before
    return OPEN, spent


def ends_of(outcome, parameter):
    """How a sweep ends that shows a refusal."""
    if outcome == SUCTION:
        return ("fold", SUCTION)
    if outcome == HEATED:
        return ("fold", HEATED, "touch-down")
    if parameter in (TOP_FOIL, BUMP_FOIL) or (outcome == "touch-down" and parameter == "load_angle"):
        return (outcome, "touch-down", "fold")
    return (outcome,)


def swept(member, parameter, shares):
    """A member's groups with a sweep of its load, the load's direction, its speed or a foil's thickness to what it has."""
    group, _, key = parameter.partition("%")
    if key:
        values = tuple(share*member.groups[group][key] for share in shares)
        return {**member.groups, group: {**member.groups[group], key: values[0]}, "sweep": {"parameter": parameter, "values": values}}
    operation = dict(member.groups["operation"])
    x, y = operation["load"]
    if parameter == "load_angle":
        values = tuple(math.degrees(math.atan2(y, x)) + turn for turn in shares)
        first = math.radians(values[0])
        operation["load"] = (member.load*math.cos(first), member.load*math.sin(first))
    elif parameter == "load":
        values = tuple(share*member.load for share in shares)
        operation["load"] = (shares[0]*x, shares[0]*y)
    else:
        values = tuple(share*operation[parameter] for share in shares)
        operation[parameter] = values[0]
    return {**member.groups, "operation": operation, "sweep": {"parameter": parameter, "values": values}}


def imbalance(member, row):
    """Of the film's force and the load, over the load."""
    load = member.groups["operation"]["load"]
    force = (row["summary"].get("force_x", math.inf), row["summary"].get("force_y", math.inf))
    return math.hypot(force[0] - load[0], force[1] - load[1])/math.hypot(*load)
