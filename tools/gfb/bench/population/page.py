"""The page of tools/bench population: outcomes, their cost, second ways, the worst."""

import csv
import statistics
import textwrap

from gfb.bench.population.members import MODELS
from gfb.bench.population.trial import (AGAINST, ANSWER, BELOW, BOUND, BY_GAP, CHEAP, FALLING, LEAST, LIGHTER, OPEN,
                                        OUTCOMES, REFUSALS, RISING, SECOND_WAYS, SLOWER, THIN, THINNER, TURNED, imbalance)
from gfb.tables import markdown_table, plain_table
from gfb.tool import stop

WORST = 10
FILES = {"random": "population", "engineer": "population_engineer", "hot": "population_hot", "tilted": "population_tilted"}  # page and table, without .md and .csv
MORE = {"random": " What refusals cost, and what was\ntried on members that are lost: [population_refusals.md](population_refusals.md).", "engineer": "", "hot": "", "tilted": ""}
SAID = {
    "random": "Bearings drawn from a fixed seed: radius 8 to 50 mm, L/D 0.5 to 1.5, C/R 0.0005 to 0.003, 8 to 40 bumps of a pitch "
              "of 1.5 to 10 mm,\nfoils of 50 to 200 um, friction 0 to 0.3, either fixed edge, 5,000 to 120,000 rpm, loads in all "
              "directions of 0.02 to 4 bar\nover the projected area W/(D L), which is beyond what many carry. 6 elements a bump or "
              "more, 96 around or more, 8 over the width.",
    "engineer": "One bearing: radius 15 mm, length 30 mm, clearance 25 um, 26 bumps of 0.1 mm (half length 1.4 mm, height "
                "0.45 mm), top foil 0.1 mm,\nfriction 0.1, both foils fixed at the trailing edge; 20, 60, 100 and 140 N in twelve "
                "directions at 40,000, 80,000 and 120,000 rpm.",
    "hot": "The bearings of [population.md](population.md) with heat, rigid ones among them, two in five of three pads of a preload up to 0.6: air of\n"
           "1 to 3 bar and 293 to 500 K by Sutherland's law, conductances of shaft 0.05 to 3 W/K, sleeve 0.2 to 10 W/K, bumps 50 to 500 W/(m2 K),\n"
           "expansions of 8e-6 to 16e-6 1/K, carry-over 0.5 to 0.95. The default mesh of each.",
    "tilted": "The bearings of [population.md](population.md), tilted in all directions by 0.1 to 1 times C/L: half of the clearance at the ends.",
}
COLUMNS = ("member", "model", "outcome", "CPU [s]", "factorizations", "smallest gap [um]", "second way", "shown by")
HEAD = """# Population: {name}

Written by `tools/bench population --set {name} --count {count} --seconds {seconds:g} --docs`{kept}.

{said}

Each run: one rank, one thread, at most {seconds:g} s of CPU time; one that takes more is stopped and counts as *CPU bound* (on a busy
machine the system's limit may strike before that by the times given here). *lost*: the run ends with status 2, but its
sentence names nothing of the bearing; *gave up*: nor did its search find anything within `maximum_factorizations`. *suction*: the film draws the free edge to the shaft at every height from its rest up to near
the shaft. *emptied*: the pressure falls to nothing on cells that are too large.
Factorizations and CPU times are medians; the ratio is that of the medians of refusals to
those of answers of the same model. Times depend on the machine and on what else runs there. All members, one by one, with the
program that found the second way: [{table}]({table}).{more}

"""


def write(members, rows, options, folder):
    """Leaves the page; returns its tables for the terminal."""
    tables = [outcome_table(members, rows), ratio_table(members, rows), shown_table(members, rows),
              worst_table(members, rows)]
    kept = f"; of these members the {len(members)} that were run" if options.count != len(members) else ""
    text = HEAD.format(name=options.set, count=options.count, kept=kept, said=SAID[options.set], seconds=options.seconds,
                       table=f"{FILES[options.set]}.csv", more=MORE[options.set])
    text += facts(members, rows) + "\n"
    for table in [*tables, open_table(members, rows), nameless_table(members, rows)]:
        text += f"## {table[0]}\n\n" + markdown_table(*table) + "\n" + notes(table[0])
    folder.mkdir(parents=True, exist_ok=True)
    (folder/f"{FILES[options.set]}.md").write_text(text.rstrip("\n") + "\n", encoding="utf-8")
    write_members(members, rows, folder/f"{FILES[options.set]}.csv")
    return facts(members, rows) + "\n" + "\n".join(plain_table(*table) for table in tables)


def write_members(members, rows, file):
    """Leaves a table of all members."""
    with open(file, "w", encoding="utf-8", newline="") as opened:
        table = csv.writer(opened, lineterminator="\n")
        table.writerow(COLUMNS)
        for member, row in zip(members, rows):
            gap = row["summary"].get("minimum_gap")
            table.writerow([member.name, member.model, row["outcome"], f"{row['cpu']:.1f}", median(factorizations([row]), "{:.0f}"),
                            "-" if gap is None else f"{1.0e6*gap:.4g}", row["shown"], row.get("shown_by", "")])


def read_ways(file):
    """{(member, model, outcome): (second way, program that found it)} of such a table."""
    try:
        with open(file, encoding="utf-8", newline="") as opened:
            rows = list(csv.DictReader(opened))
    except OSError as error:
        stop(f"{file} cannot be read: {error.strerror}")
    if not rows or tuple(rows[0]) != COLUMNS:
        stop(f"{file} is no table of tools/bench population: its columns are not {', '.join(COLUMNS)}")
    return {(row["member"], row["model"], row["outcome"]): (row["second way"], row["shown by"]) for row in rows if row["second way"]}


def notes(title):
    """What a table's words mean."""
    if title != SHOWN:
        return ""
    rising, falling, slower, lighter, thinner = (", ".join(f"{share:g}" for share in shares)
                                                 for shares in (RISING, FALLING, SLOWER, LIGHTER, THINNER))
    return (f"*{BY_GAP}*: the smallest gap of the last state is at most {THIN:g} touch_down_gap. *by a load sweep*: else a sweep of "
            f"the load, from a\ncold start at {rising} of it, ends for the same reason before the whole load; where the film draws "
            f"the edge to the shaft, also at\n{falling}, and it ends in a fold or there. *by a speed sweep*: else one of the speed, "
            f"at {rising}\nor {slower} of it. A touch-down that neither shows: a sweep of the load at\n"
            f"{lighter} of it, too; *{BELOW}*: that one ends in a fold before the load.\n"
            f"*by a turned load*: else the same load, from a cold start {TURNED[0]:g} degrees away and turned to its direction by "
            f"{TURNED[0] - TURNED[1]:g} degrees a step, ends on its\nway for the same reason or in a fold.\n*by a thicker foil*: else a sweep of the top foil's, or the "
            f"bumps', thickness from {thinner} of it ends so on its way.\nEach sweep has {CHEAP:g} times the CPU time of the refusal, {LEAST:g} s at least.\n"
            "*contradicted*: a sweep gets to the member itself. *not shown*: none of these.\n\n")


OUTCOME, RATIO, SHOWN, DEAR = "Outcomes", "Refusals against answers", "Second ways", f"The {WORST} most expensive"
UNSHOWN = "Refusals that nothing shows"
NAMELESS = "Neither answered nor refused by name, and refusals that the second way contradicts"


def facts(members, rows):
    """Sentences before the tables."""
    answers = [(member, row) for member, row in zip(members, rows) if row["outcome"] == ANSWER]
    named = sum(row["outcome"] in REFUSALS for row in rows)
    stopped = sum(row["outcome"] == BOUND for row in rows)
    text = (f"{len(rows)} members: {len(answers)} answers, {named} refused by name, {len(rows) - len(answers) - named} "
            f"lost,\n{stopped} of these stopped at the bound; {sum(row['cpu'] for row in rows):.0f} s of CPU time.\n")
    if answers:
        text += f"Force of the answers off the load by at most {max(imbalance(*one) for one in answers):.0e} of it.\n"
    shown = [row["shown"] for row in rows if row["outcome"] in REFUSALS]
    untried = shown.count("")
    text += (f"Of the {named} refusals {named - untried - shown.count(AGAINST) - shown.count(OPEN)} are shown a second way, "
             f"{shown.count(AGAINST)} contradicted, {shown.count(OPEN)} not shown"
             + (f"; {untried} were not tried" if untried else "") + ".\n")
    enlarged = sum(row["enlarged"] > 0 for row in rows)
    if enlarged:
        text += f"MUMPS' workspace was enlarged in {enlarged} of the runs.\n"
    return text


def median(numbers, form="{:.1f}"):
    """The median in words."""
    return form.format(statistics.median(numbers)) if numbers else "-"


def of(members, rows, model, outcomes):
    """Rows of a model that ended in one of the ways."""
    return [row for member, row in zip(members, rows) if member.model == model and row["outcome"] in outcomes]


def factorizations(rows):
    """Where they are known."""
    return [row["summary"]["factorizations"] for row in rows if "factorizations" in row["summary"]]


def outcome_table(members, rows):
    """Numbers, shares and costs of all outcomes."""
    table = []
    for model in MODELS:
        total = len(of(members, rows, model, OUTCOMES))
        for outcome in OUTCOMES:
            some = of(members, rows, model, (outcome,))
            if some:
                cpu = [row["cpu"] for row in some]
                table.append([model, outcome, f"{len(some)}", f"{100.0*len(some)/total:.0f} %", median(cpu),
                              f"{max(cpu):.1f}", median(factorizations(some), "{:.0f}")])
    return OUTCOME, ["model", "outcome", "members", "share", "CPU [s]", "most [s]", "factorizations"], table


def ratio_table(members, rows):
    """Costs of refusals over those of answers."""
    table = []
    for model in MODELS:
        answers = of(members, rows, model, (ANSWER,))
        for words, outcomes in (("by name", tuple(REFUSALS)), ("lost", OUTCOMES[1 + len(REFUSALS):])):
            refused = of(members, rows, model, outcomes)
            if answers and refused:
                table.append([model, words, *(ratio(refused, answers, get) for get in
                                              (lambda some: [row["cpu"] for row in some], factorizations))])
    return RATIO, ["model", "refused", "CPU time", "factorizations"], table


def ratio(refused, answers, get):
    """Of two medians, in words."""
    above, below = get(refused), get(answers)
    return f"{statistics.median(above)/max(statistics.median(below), 1.0e-9):.1f}" if above and below else "-"


def shown_table(members, rows):
    """Refusals by what shows them."""
    table = []
    for model in MODELS:
        for outcome in REFUSALS:
            some = of(members, rows, model, (outcome,))
            if some:
                table.append([model, outcome, *(f"{sum(row['shown'] == way for row in some)}" for way in SECOND_WAYS)])
    return SHOWN, ["model", "refusal", *SECOND_WAYS], table


def open_table(members, rows):
    """Numbers of the refusals that no second way shows."""
    table = []
    for model in MODELS:
        for outcome in REFUSALS:
            names = [str(member.name) for member, row in zip(members, rows)
                     if member.model == model and row["outcome"] == outcome and row["shown"] == OPEN]
            if names:
                table.append([model, outcome, ", ".join(names)])
    return UNSHOWN, ["model", "refusal", "members"], table


def shortened(words, width):
    """Words of a table's cell, not longer than this."""
    return textwrap.shorten(words.replace("|", "/").rstrip(": "), width, placeholder=" ...")


def worst_table(members, rows):
    """The most expensive runs."""
    order = sorted(zip(members, rows), key=lambda one: -one[1]["cpu"])[:WORST]
    return DEAR, ["member", "how it ended", "CPU [s]", "factorizations"], [
        [f"{member.model} {member.name}", shortened(row["reason"] or row["outcome"], 160), f"{row['cpu']:.1f}",
         median(factorizations([row]), "{:.0f}")] for member, row in order]


def nameless_table(members, rows):
    """Every member whose end says nothing of the bearing, or something else than the second way."""
    some = [(member, row) for member, row in zip(members, rows)
            if row["outcome"] not in (ANSWER, *REFUSALS) or row["shown"] == AGAINST]
    return NAMELESS, ["member", "how it ended", "CPU [s]"], [
        [f"{member.model} {member.name}", shortened(f"{row['outcome']}: {row['reason']}", 240),
         f"{row['cpu']:.1f}"] for member, row in some]
