"""Where the time goes, and what a change did to it: two programs on the same jobs, in turn, in one run.

The jobs are the bearing of [Gu2020] (100 N from a cold start, tilted, a sweep of loads) and its bump strips (case 1,
the loop of case 2, a fine one). Times are CPU times of the process by PETSc's log, as in tools/bench scaling, on one
rank; of several repetitions the smallest time of a part counts. Both programs must give the same answers: the largest
difference of what engineers read is in the table.
"""

import os
import tempfile

from gfb.bench import bearing as bench_bearing
from gfb.bench import strip as bench_strip
from gfb.bench.options import add_first, add_repetitions
from gfb.bench.runs import PARTS, Bench
from gfb.bench.scaling import free_memory, strip_case
from gfb.bench.scaling_page import smallest
from gfb.build import program_of, version_of
from gfb.namelist import Groups
from gfb.tables import markdown_table, plain_table
from gfb.tool import MEASURED, stop

SHELLS: Groups = {**bench_bearing.CASE, "model": {"foil": "shell"}}
JOBS: dict[str, Groups] = {  # quick ones first
    "bearing, 209 x 16": {**SHELLS, "mesh": {"axial_elements": 16}},
    "strip, case 1": {**bench_strip.CASE_1, "mesh": dict(zip(("arc_elements", "flat_elements", "axial_elements"),
                                                             bench_strip.PAPER)),
                      "strip_load": {**bench_strip.CASE_1["strip_load"], "steps_up": 10}},
    "strip, loop of case 2": {**bench_strip.CASE_2, "strip_load": {**bench_strip.CASE_2["strip_load"],
                                                                   "steps_up": 50, "steps_down": 50}},
    "bearing, 209 x 16, four loads": {**SHELLS, "mesh": {"axial_elements": 16},
                                      "sweep": {"parameter": "load", "values": (100.0, 95.0, 90.0, 85.0)}},
    "bearing, 209 x 16, tilted": {**SHELLS, "mesh": {"axial_elements": 16},
                                  "operation": {**SHELLS["operation"], "tilt": (0.0, 2.0e-4)}},
    "bearing, default mesh": SHELLS,
    "strip, 28 + 7 x 112": strip_case(28, 7, 112),
}
# What two runs need not have alike: cost, and the force's round-off across the load.
UNLIKE = ("newton_iterations", "factorizations", "factorizations_finest", "wall_time", "peak_memory", "force_x",
          "force_y")
LEAST = 0.02  # seconds below which no ratio is shown
LIMIT = 3600.0  # CPU time of a run [s]


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--before", metavar="PROGRAM", required=True,
                        help="the program to compare with, or a git revision, which is built in build/compare")
    add_repetitions(parser, "of each job", 1)
    add_first(parser, "jobs", JOBS, "; the later ones need minutes")
    parser.add_argument("--docs", action="store_true", help="write the page to docs/measured")


def run(options):
    """Measures; returns the tables and leaves the page."""
    options.seconds, options.memory, options.reuse = LIMIT, 0.85*free_memory(), False
    programs = {"before": program_of(options.before, "--before"), "after": options.gfb}
    measured = {job: {which: [] for which in programs} for job in list(JOBS)[:options.jobs]}
    with tempfile.TemporaryDirectory() as folder:
        benches = {which: Bench(options, folder, gfb) for which, gfb in programs.items()}
        for job, rows in measured.items():
            for _ in range(options.repetitions):
                for which, bench in benches.items():
                    print(f"{job}, {which} ...", flush=True)
                    row = bench.run_case(JOBS[job])
                    if row["stopped"]:
                        stop(f"{job}, {programs[which]}: {row['stopped']}", 2)
                    rows[which].append(row)
    tables = [time_table(measured), work_table(measured)]
    folder = MEASURED if options.docs else options.output
    before = version_of(options.before) if os.path.isfile(options.before) else f"revision {options.before}"
    versions = before, version_of(programs["after"])
    (folder/"profile.md").write_text(page(measured, tables, options, versions), encoding="utf-8")
    return "\n".join(plain_table(*table) for table in tables) + f"\npage is in {folder}\n"


def times(rows):
    """Smallest time of each part and of the whole [s]."""
    return {name: smallest(rows, name) for name in PARTS} | {"whole": min(row["cpu"] for row in rows)}


def time_table(measured):
    """Parts of each job, before and after."""
    lines = []
    for job, rows in measured.items():
        before, after = times(rows["before"]), times(rows["after"])
        for name in (*PARTS, "whole"):
            enough = before[name] >= LEAST and after[name] >= LEAST
            lines.append([job if name == PARTS[0] else "", name, f"{before[name]:.3f}", f"{after[name]:.3f}",
                          f"{before[name]/after[name]:.2f}" if enough else "",
                          f"{100.0*after[name]/after['whole']:.0f} %"])
    heads = ["job", "part", "before [s]", "after [s]", "before / after", "share after"]
    return (f"CPU time, smallest of the repetitions; no ratio below {1e3*LEAST:.0f} ms", heads, lines)


def work_table(measured):
    """Work and answers of each job, before and after."""
    lines = []
    for job, rows in measured.items():
        before, after = rows["before"][0]["summary"], rows["after"][0]["summary"]
        counts = [f"{one[name]:.0f}" for name in ("newton_iterations", "factorizations") for one in (before, after)]
        memory = [f"{one['peak_memory']/2**20:.0f}" for one in (before, after)]
        lines.append([job, f"{after['unknowns']:,.0f}", *counts, *memory, f"{difference(before, after):.0e}"])
    heads = ["job", "unknowns", "Newton before", "after", "factorizations before", "after", "MiB before", "after",
             "answers differ by"]
    return ("work and answers", heads, lines)


def difference(before, after):
    """Largest relative difference of two summaries' figures."""
    names = [name for name, value in before.items() if isinstance(value, float) and name not in UNLIKE]
    return max(abs(after[name] - before[name])/(abs(before[name]) or 1.0) for name in names)


def largest_parts(after):
    """The two parts that take most, in words."""
    order = sorted(PARTS, key=lambda name: -after[name])[:2]
    return " and ".join(f"{name} ({100.0*after[name]/after['whole']:.0f} %)" for name in order)


def page(measured, tables, options, versions):
    """The documentation's page."""
    said = ""
    for job, rows in measured.items():
        before, after = times(rows["before"]), times(rows["after"])
        gain = max((name for name in PARTS if before[name] >= LEAST and after[name] >= LEAST),
                   key=lambda name: before[name] - after[name], default=PARTS[0])
        said += (f"- **{job}**: {before['whole']/after['whole']:.2f} times less CPU time; most of what changed is in "
                 f"{gain} ({before[gain]:.2f} s to {after[gain]:.2f} s). Now most goes to {largest_parts(after)}.\n")
    return f"""# Where the time goes

```
tools/bench profile --before PROGRAM --gfb PROGRAM --docs    # or --before REVISION, which is built
```

Two programs solve the same jobs in turn on one rank; times are CPU times by PETSc's log, in parts that do not overlap
([scaling.md](scaling.md) says what they are). Smallest of {options.repetitions}.

- Before: {versions[0]}
- After: {versions[1]}

## Before and after

{said}
{markdown_table(*tables[0])}
{markdown_table(*tables[1])}
{WORDS}"""


WORDS = """## What was changed, and what did not pay

- Membrane and bending of a flat element do not know each other: half of its stiffness is round-off. Left out of the
  matrix of the top foil it halves the operations of a factorization (bearing on 209 x 16 elements: 4.3e8 to 2.0e8;
  417 x 32: 3.1e9 to 1.5e9) and takes a third of the factors' memory.
- A crest on a line of nodes has one master node, not four with three shape functions of round-off.
- Elastic forces of a strip are multiplied out once where contacts move but the foil does not: assembly 1.2 times faster.
- The analysis of a pattern is made once (`MatLUFactorSym` counts 1), whatever the number of factorizations.
- Exact zeros stay in condensed matrices: without them PETSc's products, which go by blocks of equal rows, are 1.3 times
  slower.
- Factors of an earlier matrix with GMRES, as strips use them, do not pay for bearings: 10 factorizations instead of 30 on
  209 x 16 elements, but 290 iterations, each as expensive as a tenth of a factorization: 1.2 times the CPU time.
- Looser GMRES for strips (1e-2 or 3e-2 for 1e-3): 76 to 101 iterations for 100 to 106; 0.1: eight more steps of Newton's
  method. Left as it was.
- Orderings: PORD is the best or next to it for bearings (approximate minimum fill: 1.0 to 1.3 times the operations, minimum
  degree 1.6 to 1.8), minimum fill for strips (PORD: 1.8 times).
- **Factors in single precision**, refined in double (FGMRES; MUMPS called directly): one solution by them has six digits, so Newton's steps need no
  more. User time of the main job 1.98 to 1.91 s, with one solution a step and AMF 1.76 s; 419 x 64 elements (95,036 unknowns) 7.75 to 6.88 s, at
  best 6.43 s; 837 x 160 (437,512 unknowns) 77 to 85 s: there six digits are too few, 52 factorizations instead of 45, and the process takes 0.9 GB
  more. A fifth of a factorization is handing over entries, whatever their precision. Left out.
- **Orderings with the processor's own kernel** (SkylakeX): AMF saves 0.18 s of analysis of the main job (2.01 to 1.90 s), but its factors take
  1.05 times as long, which a turn over time pays hundreds of times; 1.02 times slower on 95,036 unknowns, 1.22 times on 437,512.
- **24 rows graded by 4 instead of 32 equal ones**: 1.0 to 1.6 times less CPU time (once 3.4, by other iterations). Errors against 96 or 128 rows, eight
  bearings (30 to 190 N, long, short, thin foil, three pads, tilted): position, pressure and torque 0.4 to 3 times those of equal rows (half of them
  better, a short and a lightly loaded one worse), the smallest film 0.2 to 1.5 % off instead of 0.06 to 1.5 %, and 4.6 % instead of 0.1 % at 190 N
  (nodes miss the narrow minimum). Equal rows stay the default.

## Small runs, studies, ranks, sweeps of frequencies

Two cores with a load of five to seven by other jobs: CPU times of pairs in turn, instructions by callgrind, counts.

- **A start** (`gfb --help`): 84 % of its 221 million instructions are the loader's, MPI has 15 %, PETSc and the program the rest. Debian's PETSc brings
  112 libraries; two thirds of all instructions look for the names of Trilinos, which gfb never calls. With Trilinos first in the line, without
  hwloc's plug-ins and collective calls of many ranks 178 million, 0.120 to 0.100 s (medians of 40), 3281 to 2968 system calls; where OpenBLAS falls back
  0.254 to 0.142 s, for it chooses again in the same process. A program that does nothing and is linked with this PETSc takes 0.6 of a start: 0.05 s
  on a quiet core needs a PETSc without Trilinos, HYPRE, X11 and OpenCL.
- **Set-up and output**: fields in natural order went through a new scatter each; on one rank they are permuted: three cold foundations 2.29 to 2.14
  thousand million instructions, output of the main job 0.24 to 0.16 s. Its set-up (0.35 to 0.45 s in runs side by side) did not change beyond the noise. A tenth
  of a cold foundation is `matmul` and deflate: loops in place of the first change last digits (libgfortran fuses products and sums), the second is the size
  of files. Left.
- **A study of 1,980 foundations** (`gfb.study`, speed and clearance, 216 x 32, 3,908 unknowns, 2 processes, before the permutation): 388 CPU s of gfb, 3 of Python:
  5.1 a second and core; all have an answer, 13.2 factorizations each. 10,000 were not run: 35 minutes of both cores. 100 of them in one process: 18.3 s
  before, 15.2 s after the start was made cheaper. Where they go: first answer 52 %, output 20 %, meshes 16 %, judging 10 %. KLU has 12 %, so that factors
  kept from member to member cannot win more than that; 50 a second are out of reach while each starts cold.
- **A point of a sweep** of such a foundation (101 speeds): 29 ms, 200 million instructions. Newton's four iterations take no new factorization, for factors are kept
  from point to point already; they are 22 % of it. The one factorization is that of the determinant's sign, which shows folds, and is 32 % with its matrix.
  The film's fields and their files are 29 %.
- **209 x 64 elements on two ranks** (53,876 unknowns, waiting not counted, two rounds): 9.5 and 9.1 s to 6.8 s, 1.35 to 1.40. Factorization 5.8 to 4.2 s (1.38),
  assembly 1.65, set-up 1.3, output 0.3 to 0.4 s on the first rank. Were all but the factorization halved, it would be 1.55: what is missing is in MUMPS' last fronts.
  Four ranks were not measured: two cores.
- **Ranks on busy cores**: the limit cycles pass 266,000 messages and 246,000 sums in 61,000 iterations; 21 CPU s on one rank, 380 on two, where each waited for
  the other to get a core. Since waiting ranks yield, one orbit takes 10 to 13 CPU s for 28 to 53 (one rank: 3.5). On quiet cores this was not measured.
- **Frequencies of neighbouring speeds** (shells, 105 x 16, 30 frequencies, five speeds 3 % apart): 62 factorizations of vibrations, 12.4 a speed. Tables of neighbours
  differ by 1.3 % of the largest entry, and four neighbours give the middle one to 0.6 % only, for contacts change. A basis that is a hundredth off gives 1e-4 at best,
  where 3e-7 is asked for: the residual would ask for the samples again. Not built.
"""
