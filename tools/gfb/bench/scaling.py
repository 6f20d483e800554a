"""Large meshes: growth of time and memory, one rank and two, messages against ranks, and a page that reads them.

Strips and the bearing of [Gu2020], solved by gfb, and a condensed strip whose bumps are all different, which no case
file can ask for. Times are CPU times of each process by PETSc's log: bench_probe.c, compiled here and preloaded,
gives PETSc that clock, leaves waiting out, and counts the messages of MUMPS. Each measured row is kept in
build/bench/scaling.json, so that an interrupted run goes on with --reuse; a run that takes more than --seconds or
--memory, or would by the growth so far, is left out and the page says so.
"""

import hashlib
import os
import pathlib
import signal
import sys
import tempfile

from gfb.bench import bearing as bench_bearing
from gfb.bench import scaling_page as bench_scaling_page
from gfb.bench import strip as bench_strip
from gfb.bench.options import add_repetitions
from gfb.bench.runs import Bench, Limits
from gfb.tool import MEASURED, stop

TARGETS = (8.0e3, 3.0e4, 1.0e5, 3.0e5, 1.05e6, 3.2e6)  # unknowns of full order, of each level
QUICK = 1.2e5  # largest with --quick
GROWING = ("strip frictionless full", "strip full", "strip reduced", "strip longer", "bearing full", "bearing reduced")
BUMPS = 10  # of the strips that get finer
LONGER = {"arc_elements": 12, "flat_elements": 3, "axial_elements": 48}  # of strips that get longer
A_BUMP = 5*(LONGER["arc_elements"] + LONGER["flat_elements"])*(LONGER["axial_elements"]//2 + 1)
RANKS = (1, 2, 4, 8, 16, 32, 64)
COUNTING = 600.0  # seconds of CPU time, where only messages are counted
SMALL = 1.0e-2  # a run that takes less of the limits than this may be followed by any other


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--parts", metavar="LIST", default=",".join(MEASURES),
                        help="what to measure, of %(default)s; the page shows other parts as kept, with --reuse")
    parser.add_argument("--quick", action="store_true", help="small sizes, minutes; says little")
    parser.add_argument("--largest", metavar="UNKNOWNS", type=float, help="largest mesh; default: 3.2e6")
    parser.add_argument("--seconds", metavar="LIMIT", type=float, default=3600.0,
                        help="CPU time that a process may take; default: %(default)g")
    parser.add_argument("--memory", metavar="GIB", type=float,
                        help="memory that a run may take; default: 85 %% of what is free now")
    add_repetitions(parser, "of one and two ranks, the smallest counts", 3)
    parser.add_argument("--reuse", action="store_true", help="go on with the rows of an earlier run")
    parser.add_argument("--docs", action="store_true", help="write the page and its pictures to docs/measured")


def run(options):
    """Measures; returns the tables and leaves page and pictures."""
    parts = options.parts.split(",")
    if not set(parts) <= set(MEASURES):
        stop(f"--parts {options.parts}: {', '.join(MEASURES)}")
    options.memory = 0.85*free_memory() if options.memory is None else options.memory*2.0**30
    options.largest = options.largest or (QUICK if options.quick else TARGETS[-1])
    if options.seconds <= 0.0 or options.memory <= 0.0 or options.largest < TARGETS[0]:
        stop(f"--seconds and --memory are above 0, --largest is {TARGETS[0]:g} at least")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(3))  # so that what runs is ended
    measured = {}
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options, folder)
        for part, measure in MEASURES.items():
            bench.measures = part in parts
            measured[part] = measure(bench, options)
    measured = {part: found for part, found in measured.items() if any_done(found)}
    return bench_scaling_page.write(measured, options, MEASURED if options.docs else options.output)


def any_done(found):
    """Whether a part has a row with a result."""
    if isinstance(found, dict):
        return any(any_done(one) for one in found.values())
    return any(not row["stopped"] for row in found)


def free_memory():
    """What processes can have without swapping [B]."""
    for line in pathlib.Path("/proc/meminfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("MemAvailable:"):
            return 1024.0*float(line.split()[1])
    return float(os.sysconf("SC_PHYS_PAGES")*os.sysconf("SC_PAGE_SIZE"))


# --- cases ---

def strip_case(arc, flat, axial, friction=0.1, reduction="guyan", bumps=BUMPS, steps=2):
    """Bumps of [Gu2020] table 1, case 1, under 0.2 MPa, half the width solved."""
    groups = bench_strip.CASE_1
    return {**groups, "bump_foil": {**groups["bump_foil"], "bumps": bumps},
            "contact": {"friction_top": friction, "friction_sleeve": friction},
            "strip_load": {**groups["strip_load"], "steps_up": steps if friction > 0.0 else 1},
            "model": {"reduction": reduction, "half_width": "yes"},
            "mesh": {"arc_elements": arc, "flat_elements": flat, "axial_elements": axial}}


def bearing_case(scale, reduction="guyan"):
    """The bearing of [Gu2020], 100 N, from a cold start, half the width solved."""
    return {**bench_bearing.CASE, "model": {"foil": "shell", "reduction": reduction, "half_width": "yes"},
            "mesh": {"circumferential_elements": 104*scale, "axial_elements": 8*scale, "arc_elements": 4*scale,
                     "flat_elements": scale}}


def growing_case(name, target):
    """The case of a level, and its mesh in words."""
    reduction = "none" if name.endswith("full") else "guyan"
    if name == "strip longer":
        bumps = max(2, round(target/A_BUMP))
        return strip_case(*LONGER.values(), friction=0.0, bumps=bumps), f"{bumps} bumps"
    if name.startswith("strip"):
        scale = max(2, round((target/2000.0)**0.5))
        mesh = (4*scale, scale, 16*scale)
        case = strip_case(*mesh, friction=0.0 if "frictionless" in name else 0.1, reduction=reduction)
    else:
        scale = max(1, round((target/5000.0)**0.5))
        mesh = (4*scale, scale, 8*scale)
        case = bearing_case(scale, reduction)
    return case, f"{mesh[0]} + {mesh[1]} x {mesh[2]}"


def full_unknowns(row, case):
    """Unknowns of the same mesh without condensation: shells, and film and shaft of a bearing."""
    summary, axial = row["summary"], case["mesh"]["axial_elements"]
    if case["model"]["reduction"] == "none":
        return summary["unknowns"]
    condensed = summary["foil_unknowns_full"] - summary["foil_unknowns_retained"]
    return summary["unknowns"] + condensed*(axial//2 + 1)/(axial + 1)


def mark(case):
    """A few letters that change with anything in a case."""
    return hashlib.sha256(repr(case).encode()).hexdigest()[:6]


# --- parts ---

def growth(bench, options):
    """{model: rows}."""
    return {name: grow(bench, name, options.largest) for name in GROWING}


def grow(bench, name, largest):
    """Rows of one model, as far as the limits reach."""
    rows = []
    for target in TARGETS:
        if target > 1.01*largest:
            break
        case, mesh = growing_case(name, target)
        why = foreseen(rows, target, bench.limits) if bench.measures else ""
        if why:
            rows.append({"mesh": mesh, "target": target, "stopped": why})
            break
        row = bench.row(f"growth, {name}, {mesh}, {mark(case)}", lambda case=case: bench.run_case(case))
        row = {**row, "mesh": mesh, "target": target}
        rows.append(row)
        if row["stopped"]:
            break
        row["full_unknowns"] = full_unknowns(row, case)
    return rows


def foreseen(rows, target, limits):
    """Whether the next level would exceed a limit, by the growth over the last two; in words."""
    if len(rows) < 2:
        return ""
    step = target/rows[-1]["full_unknowns"]
    for name, limit, words, unit, kind in (("memory", limits.memory, "GiB", 2.0**30, 1.0),
                                           ("cpu", limits.seconds, "s of CPU time", 1.0, 1.0)):
        last, before = rows[-1][name], rows[-2][name]
        if last < SMALL*limit:
            continue
        exponent = exponent_of(rows[-2:], name)
        need = last*step**min(max(exponent, kind), 2.0)
        if need > limit:
            return (f"would need about {need/unit:,.0f} {words} by the growth so far (from {before/unit:,.1f} to "
                    f"{last/unit:,.1f}), of {limit/unit:,.0f} allowed")
    return ""


def exponent_of(rows, name):
    """Exponent of the growth over two rows."""
    return bench_scaling_page.fit([one["full_unknowns"] for one in rows], [one[name] for one in rows])


def rank_cases(quick):
    """What is compared on one and two ranks: words, the kind of run, its sizes or groups."""
    if quick:
        return (("condensed strip, all bumps different", "strip", (24, 6, 50, 10)),
                ("strip, reduced, friction", "case", strip_case(16, 4, 64)),
                ("bearing, reduced", "case", bearing_case(2)))
    return (("condensed strip, all bumps different", "strip", (32, 8, 96, 32)),
            ("strip, reduced, friction", "case", strip_case(32, 8, 128, bumps=30)),
            ("strip, full order, no friction", "case", strip_case(48, 12, 192, friction=0.0, reduction="none")),
            ("bearing, reduced", "case", bearing_case(4)),
            ("bearing, full order", "case", bearing_case(4, "none")))


def two_ranks(bench, options):
    """{words: {ranks: rows of all repetitions}}, rounds going over ranks."""
    measured = {}
    for words, kind, what in rank_cases(options.quick):
        measured[words] = {1: [], 2: []}
        for repetition in range(options.repetitions):
            for ranks, rows in measured[words].items():
                key = f"ranks, {words}, {mark(what)}, {ranks}, {repetition}"
                rows.append(bench.row(key, lambda ranks=ranks, kind=kind, what=what:
                                      bench.run_strip(what, ranks) if kind == "strip"
                                      else bench.run_case(what, ranks)))
                if rows[-1]["stopped"]:
                    break
            if any(rows and rows[-1]["stopped"] for rows in measured[words].values()):
                break
    return measured


def message_cases(quick):
    """Cases whose messages are counted, by what they are called."""
    if quick:
        return {"strip, reduced, no friction, 16 bumps": strip_case(4, 2, 16, bumps=16, friction=0.0, steps=1),
                "bearing, reduced, 26 bumps": bearing_case(1)}
    return {"strip, reduced, no friction, 64 bumps": strip_case(8, 2, 32, bumps=64, friction=0.0, steps=1),
            "strip, reduced, friction, 64 bumps": strip_case(8, 2, 32, bumps=64, steps=1),
            "bearing, reduced, 26 bumps": bearing_case(1), "bearing, full order, 26 bumps": bearing_case(1, "none")}


def count_messages(bench, options):
    """{words: rows by number of ranks}."""
    measured, bench.limits = {}, Limits(min(options.seconds, COUNTING), options.memory)
    for words, case in message_cases(options.quick).items():
        rows = measured.setdefault(words, [])
        for ranks in RANKS[:4] if options.quick else RANKS:
            row = bench.row(f"messages, {words}, {mark(case)}, {ranks}",
                            lambda ranks=ranks, case=case: bench.run_case(case, ranks))
            rows.append({**row, "ranks": ranks})
            if row["stopped"]:
                break
    return measured


MEASURES = {"growth": growth, "ranks": two_ranks, "messages": count_messages}
