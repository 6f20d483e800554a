"""The page of the documentation: what is checked, how far answers may differ, and what was found."""

from builds import BASE
from scenes import FILM, FOILS, FOLDS, MODES, PATH, REBUILT, SLOPES, TOLERANCE

WHY = {
    FILM: "film alone, or film on springs: the last of Newton's iterations leaves round-off; the order of sums, and products "
          "and sums rounded once instead of twice (FMA), are all that differs",
    FOILS: "foils in contact, friction, films and foils in turns, iterative solver: Newton ends at scaled residuals of 1e-10 and "
           "steps of 1e-9, and its last step differs; stiff contacts enlarge round-off by their stiffness over the foil's",
    SLOPES: "what is small beside the numbers that it is the difference of: the extent of an orbit, a derivative",
    REBUILT: "a derivative by the bumps' shape, the difference of bearings built anew: each foil's stiffness has round-off of "
             "its own, and it is divided by the step of the difference",
    MODES: "frequencies: round-off of the stiffest motion of the mesh, 1e-16 of its eigenvalue, seen beside the lowest one",
    PATH: "what is reached by cut steps or along an arc: all equilibria, the last state before there is no answer",
    FOLDS: "the row of a fold, which lies where a step along the arc ends, to 1e-4 of the load at most: another step, another row",
}
HEAD = """# Floating-point discipline

Written by `tools/check_floating_point --docs docs/measured/floating_point.md`; not part of `tools/test`.

```
tools/check_floating_point                     # all of this page: about ten minutes on two cores
tools/check_floating_point --only valgrind     # one part: builds, valgrind, hard
tools/check_floating_point --only builds strip # scenes with these words
```

## What is checked

**One answer.** Small scenes of every analysis and every model are run by three builds of the same sources, on one rank and
some on four:

| build | options | what for |
| --- | --- | --- |
| debug | the preset `debug`: `-O0 -fcheck=all -finit-real=snan -finit-derived -ffpe-trap=invalid,zero,overflow`, run with `MALLOC_PERTURB_=128` | stops at a division by zero, an invalid operation, an overflow, a wrong index; what lies on the stack begins as signalling NaN, what is allocated as reals of 1.4e306, whose squares overflow, and integers that are no index |
| release | the preset `release`: `-O2`, film `-O3` | the one that is used; on one rank it is what the others are compared with |
| native | `-O3 -march=native` | other vectors, other orders of sums, fused multiply-add |

Every number of the summary and of every row of the history that is not a cost is compared, over its own size, or over a
natural one where it may vanish (forces over p_a L D, lifts over the clearance, works over that of the load: those of
`tests/verification/every_input.py`, which does the same with all inputs on 1 to 7 ranks). Words and names must be the same.
Numbers of iterations may differ: where Newton's last step falls just below a tolerance in one build, it falls just above
in another, and then one more step is made. Scenes without an answer must be refused in the same words.

**Traps stay on.** PETSc marks what it cannot evaluate with 1/0, so that inside of its solvers the trap of zero is put off
and on again whenever gfb's own equations are evaluated; invalid and overflow stop the program there, too, as in MUMPS,
BLAS and LAPACK, which need no exception. A unit test (`newton_test`) sees that traps are on in gfb's equations and after
every manner in which a solve can end.

**Memory.** The release build under valgrind (memcheck), on one rank: no access outside of what is allocated, nothing used
before it is set, in gfb or in a library that was given it, and no block lost that gfb allocated. What libraries allocate
and lose themselves is counted only. `tests/floating_point/libraries.supp` and Open MPI's own list name what is known of
libraries; no entry names gfb.

**Hard scenes.** All scenes of [hard cases](hard_cases.md) by the debug build: none may trap.
"""
BUILDS = """
## Builds and ranks

Largest difference of any number from the release build's on one rank:

"""


def cell(number):
    """A difference."""
    return "0" if number == 0.0 else f"{number:.0e}"


def column(way):
    """The head of a column."""
    build, ranks, groups = way
    return f"{build}, {ranks}" + (f" in {groups} groups" if groups else "")


def builds_table(kept):
    """Scenes and their differences."""
    ways = dict.fromkeys(tuple(one[:3]) for row in kept for one in row["found"])
    text = "| scene | " + " | ".join(map(column, ways)) + " | at most | where |\n"
    text += "| --- |" + " ---: |"*(len(ways) + 1) + " --- |\n"
    for row in kept:
        found = {tuple(one[:3]): one[3:] for one in row["found"]}
        cells = [cell(found[way][0]) if way in found else "" for way in ways]
        largest, name = max(found.values())
        where = f"`{name}`" if largest > 0.0 else ""
        text += f"| {row['words']} | " + " | ".join(cells) + f" | {row['tolerance']:.0e} | {where} |\n"
    return text


def tolerances():
    """The kinds of scenes."""
    text = "\nTolerances, and what leaves differences:\n\n| at most | scenes |\n| ---: | --- |\n"
    for kind, why in WHY.items():
        text += f"| {TOLERANCE[kind]:.0e} | {why} |\n"
    return text


def memory_table(kept):
    """Scenes under valgrind."""
    text = "\n## Under valgrind\n\n| scene | errors | blocks of gfb's lost | places where libraries lose some |\n"
    text += "| --- | ---: | ---: | ---: |\n"
    for one in kept:
        text += f"| {one['words']} | {one['errors']} | {one['lost']} | {one['others']} |\n"
    return text


def page_text(found):
    """The whole page from the three parts."""
    assert BASE == ("release", 1, 0)  # as the page says
    return (HEAD + BUILDS + builds_table(found["builds"]) + tolerances() + memory_table(found["valgrind"])
            + f"\n## Hard scenes with traps\n\n{found['hard'][0]['words']}; none trapped.\n")
