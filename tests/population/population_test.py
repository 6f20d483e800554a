#!/usr/bin/env python3
"""A population of bearings: every member is valid input, ends as a run must, and what it says holds.

  population_test.py --rules          no run: a thousand members are what the page says they are, outcomes have their words
  population_test.py --members N      the first N members of the population, with fewer elements; --after M: without the first M
  population_test.py --scenes WORD    case files of scenes/ whose names begin with the word, against the outcome in their
                                      first line: a better one passes, and is to be written there
"""

import argparse
import math
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent/"verification"))

from gfb_run import GFB, Checks  # noqa: E402 (found only now; it says where the following is)
from gfb.bench.population import members, page, trial  # noqa: E402
from gfb.program import DONE, call  # noqa: E402
from gfb.running import write_case  # noqa: E402

SCENES = pathlib.Path(__file__).resolve().parent/"scenes"
SECONDS = 5.0      # CPU time of a member's run at most: how many are stopped depends on the machine, and is no claim
SCENE_SECONDS = 600.0
EVERY = 2          # member that is run with fewer factorizations too
# From the best to the worst: an outcome may move up.
REFUSED = "refused"  # by any name: where a film closes, rounding decides which sentence comes first
RANKS = {trial.ANSWER: 0, **{name: 1 for name in (*trial.REFUSALS, REFUSED)}, trial.NO_REASON: 2, trial.GAVE_UP: 3, trial.BOUND: 4,
         trial.BROKEN: 5, trial.INVALID: 6}
SMALL = {"axial_elements": 4, "arc_elements": 4, "flat_elements": 1}


def check_rules(checks):
    """Ranges and geometry of the members, without a run."""
    some = members.random_set(1000, members.MODELS)
    checks.that("the first members do not depend on how many are asked for", some[:10] == members.random_set(10, members.MODELS))
    for words, value, low, high in (
            ("radius", lambda g: g["bearing"]["radius"], 8.0e-3, 50.0e-3),
            ("L/D", lambda g: g["bearing"]["length"]/g["bearing"]["radius"]/2.0, 0.5, 1.5),
            ("C/R", lambda g: g["bearing"]["clearance"]/g["bearing"]["radius"], 0.0005, 0.003),
            ("bumps", lambda g: g["bump_foil"]["bumps"], 8, 40),
            ("foil", lambda g: g["bump_foil"]["thickness"], 50.0e-6, 200.0e-6),
            ("speed", lambda g: g["operation"]["speed_rpm"], 5.0e3, 120.0e3),
            ("load over D L", lambda g: math.hypot(*g["operation"]["load"])/g["bearing"]["radius"]/2.0/g["bearing"]["length"],
             2.0e3, 4.0e5),
            ("arcs over a pitch", lambda g: g["bump_foil"]["half_length"]*g["bump_foil"]["bumps"]/math.pi/g["bearing"]["radius"],
             0.5, 0.9)):
        found = [value(one.groups) for one in some]
        checks.that(f"{words}: {min(found):.4g} to {max(found):.4g}, within {low:g} .. {high:g}",
                    low <= min(found) and max(found) <= high and max(found) - min(found) > 0.9*(high - low)*0.9)
    for model in dict.fromkeys(members.TURN):
        of_model = [one for one in some if one.model == model]
        edges = {(one.groups["top_foil"]["fixed_edge"], one.groups["bump_foil"]["fixed_edge"]) for one in of_model
                 if "top_foil" in one.groups}
        checks.that(f"{len(of_model)} of {model}, {len(edges)} pairs of edges", len(of_model) >= 200
                    and (len(edges) == 4 or model == members.FOUNDATION))
    grid = members.engineer_set(10000, members.MODELS)
    checks.that(f"the engineer's grid has {len(grid)} members", len(grid) == 144 + 24 and len({str(one) for one in grid}) == len(grid))


def check_words(checks):
    """Outcomes by status and log, and the page that is made of them."""
    said = "no equilibrium found: "
    for expected, status, log in (
            (trial.ANSWER, 0, ""), ("touch-down", 2, said + "the shaft touches down: the film is thinner than 0.003 um"),
            ("fold", 2, "2.nml\n" + said + "the branch of answers ends in a fold: beyond it the top foil moves on by itself"),
            ("fold", 2, said + "the branch of answers ends in a fold: beyond it the shaft moves on by itself"),
            ("emptied", 2, said + "the film is emptied: its pressure falls to 0.06 Pa behind a gap of 0.7 um"),
            ("suction", 2, said + "the film draws the free edge of the top foil to the shaft"),
            (trial.NO_REASON, 2, said + "lost at 20 % of the load: fixed at 5 heights the free edge of the top foil needs 2 N or more"),
            (trial.GAVE_UP, 2, said + "lost at 20 % of the load: the search gave up, after 1500 factorizations (maximum_factorizations in &solver)"),
            (trial.NO_REASON, 2, said + "no step converges, however short"), (trial.BROKEN, 76, ""), (trial.BROKEN, -11, ""),
            (trial.BOUND, -24, ""), (trial.INVALID, 1, "")):
        checks.that(f"status {status} '{log[-30:]}' is {expected}", trial.outcome_of(status, log) == expected)
    some = members.random_set(6, members.MODELS)
    rows = [{"outcome": outcome, "status": 0, "cpu": cpu, "reason": "", "enlarged": 0, "shown": shown, "cpu_shown": 0.0,
             "shown_by": "0.1.0" if cpu == 4.0 else "", "summary": {"factorizations": 100.0*cpu, "force_x": one.groups["operation"]["load"][0],
                         "force_y": one.groups["operation"]["load"][1]}}
            for one, (outcome, cpu, shown) in zip(some, ((trial.ANSWER, 2.0, ""), (trial.ANSWER, 1.0, ""),
                                                         ("touch-down", 6.0, trial.BY_GAP),
                                                         ("touch-down", 4.0, trial.BY_SWEEP["load"]), (trial.BOUND, 9.0, ""),
                                                         ("fold", 6.0, trial.OPEN)))]
    with tempfile.TemporaryDirectory() as folder:
        table = page.write(some, rows, argparse.Namespace(set="random", seconds=9.0, count=20), pathlib.Path(folder))
        text = (pathlib.Path(folder)/"population.md").read_text(encoding="utf-8")
        ways = page.read_ways(pathlib.Path(folder)/"population.csv")
    for words in ("--count 20 --seconds 9 --docs`; of these members the 6 that were run.", "6 members: 2 answers, 3 refused by name, 1 lost",
                  "Of the 3 refusals 2 are shown a second way, 0 contradicted, 1 not shown.", "| beam | fold | 5 |", "| beam | by name | 3.0 | 3.0 |",
                  "| elastic_foundation | by name | 4.0 | 4.0 |", "| shell 4 | CPU bound | 9.0 |", "| shell | CPU bound | 1 | 100 % | 9.0 | 9.0 | 900 |"):
        checks.that(f"the page has '{words}'", words in text)
    checks.that(f"the table of all members has the second ways {ways}", ways == {
        ("2", members.BEAM, "touch-down"): (trial.BY_GAP, ""), ("3", members.FOUNDATION, "touch-down"): (trial.BY_SWEEP["load"], "0.1.0"),
        ("5", members.BEAM, "fold"): (trial.OPEN, "")})
    checks.that("the terminal has the same", "3 refused by name" in table)


def small(member):
    """A member with few elements: how it ends is tested here, not where its shaft floats."""
    bumps = member.groups["bump_foil"]["bumps"]
    mesh = {key: SMALL.get(key, 4*bumps) for key in member.groups["mesh"]}
    return members.Member(member.name, member.model, {**member.groups, "mesh": mesh})


def check_valid(checks, some):
    """gfb --check takes all members."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [write_case(folder, f"member_{number}", member.groups)
                 for number, member in enumerate(some)]
        done = call([GFB, "--check", "--groups", "1", *map(str, paths)])
    checks.that(f"members are valid {done.complaint.strip()}", done.status == 0)
    for path, member in zip(paths, some):
        checks.that(f"{member.model} {member.name} is valid", f"{path} is in order" in done.log)


def check_members(checks, after, count):
    """How members end, those after the first ones."""
    unnamed, some = 0, [small(member) for member in members.random_set(count, members.MODELS)[after:]]
    check_valid(checks, some)
    for number, member in enumerate(some):
        row = trial.try_case(GFB, member.groups, SECONDS)
        words = f"{member.model} {member.name}: {row['outcome']}, {row['cpu']:.1f} s {row['reason']}"
        checks.that(words, row["outcome"] not in (trial.BROKEN, trial.INVALID))
        unnamed += row["outcome"] in (trial.NO_REASON, trial.GAVE_UP, trial.BOUND)
        if number % EVERY == 0:
            check_bound(checks, member, row)
        if row["outcome"] == trial.ANSWER:
            checks.below(f"{member.name}: force = load", trial.imbalance(member, row), 1.0e-6)
            checks.that(f"{member.name}: the film is open", row["summary"]["minimum_gap"]
                        >= trial.TOUCH_DOWN_SHARE*member.groups["bearing"]["clearance"])
    print(f"{unnamed} of {len(some)} have neither answer nor reason within {SECONDS:g} s")


def check_others(checks, count):
    """Hot and tilted members: valid, and the first of them end within their bound of factorizations, few of them where they are hot."""
    hot, tilted = members.hot_set(40, members.MODELS), members.tilted_set(40, members.MODELS)
    check_valid(checks, hot + tilted)
    checks.that("hot members do not depend on how many are asked for", hot[:5] == members.hot_set(5, members.MODELS))
    for member in (*hot[:count], *tilted[:count]):
        mesh = {"circumferential_elements": 4*member.groups.get("bump_foil", {}).get("bumps", 16), "axial_elements": 8}
        if member.model == members.SHELL:
            mesh |= SMALL
        row = trial.try_case(GFB, {**member.groups, "mesh": mesh}, SECONDS)
        spent = row["summary"].get("factorizations", 0)
        checks.that(f"{member.model} {member.name}: {row['outcome']}, {spent:.0f} factorizations {row['reason']}",
                    row["outcome"] not in (trial.BROKEN, trial.INVALID) and spent <= 1500)


def check_bound(checks, member, row):
    """A search that may take fewer factorizations takes no more, and claims nothing of the bearing that it has not seen."""
    all_of_them = int(row["summary"].get("factorizations", 0))
    if all_of_them < 4:
        return
    for most, ends in ((3, (trial.GAVE_UP,)), (all_of_them//2, (trial.GAVE_UP, *trial.REFUSALS))):
        bounded = trial.try_case(GFB, {**member.groups, "solver": {"maximum_factorizations": most}}, SECONDS)
        spent = bounded["summary"].get("factorizations", 0)
        checks.that(f"{member.model} {member.name} with {most} of {all_of_them} factorizations: {bounded['outcome']} after {spent:.0f}",
                    bounded["outcome"] in ends and spent <= most)


def expected_outcome(path):
    """The word in a case file's first line."""
    found = re.match(r"! outcome: (.+)\n", path.read_text(encoding="utf-8"))
    return found[1] if found else "none is given"


def check_scene(checks, path):
    """How a named scene ends, beside what its case file says."""
    expected = expected_outcome(path)
    if expected not in RANKS:
        checks.that(f"{path.name}: outcome '{expected}' is one of {', '.join(RANKS)}", False)
        return
    with tempfile.TemporaryDirectory() as folder:
        status, log, cpu = trial.run_bounded(GFB, path, folder, SCENE_SECONDS)
    outcome = trial.outcome_of(status, log)
    better = ", better than its file says" if RANKS[outcome] < RANKS[expected] else ""
    checks.that(f"{path.stem}: {outcome} ({expected}){better}, {cpu:.1f} s, "
                f"workspace enlarged {log.count('workspace was too small')} times {'' if status == DONE else trial.reason_in(log)}",
                better or outcome == expected or expected == REFUSED and outcome in trial.REFUSALS)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rules", action="store_true")
    parser.add_argument("--members", metavar="N", type=int, default=0)
    parser.add_argument("--after", metavar="M", type=int, default=0)
    parser.add_argument("--scenes", metavar="WORD")
    arguments = parser.parse_args()
    checks = Checks()
    if arguments.rules:
        check_rules(checks)
        check_words(checks)
    if arguments.members:
        check_members(checks, arguments.after, arguments.members)
        check_others(checks, arguments.members//3 if arguments.after == 0 else 0)
    if arguments.scenes is not None:
        for path in sorted(SCENES.glob(f"{arguments.scenes}_*.nml")):
            check_scene(checks, path)
    checks.close()


if __name__ == "__main__":
    main()
