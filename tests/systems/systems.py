#!/usr/bin/env python3
"""Small scenes by the programs of several systems, beside each other.

  systems.py --folder FOLDER [--docs FILE]

FOLDER is that of tools/check_systems, which makes and calls this: SYSTEM.found says what a system is, SYSTEM.gfb runs its
program. All are compared with the first one, on one rank; the tests run on several.
"""

import argparse
import pathlib
import sys
import tempfile

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1]/name) for name in ("verification", "floating_point")]

from scenes import FILM, SCENES, SHELL, Scene, merged  # noqa: E402 (found only now)
from gfb.case import Case  # noqa: E402
from gfb.running import run_file  # noqa: E402
from same_answer import difference  # noqa: E402

TOLERANCE = 1.0e-8  # other releases of BLAS and MUMPS add in another order
SECONDS = 900
# Film and shaft by KLU and by MUMPS, a strip, SLEPc, and MUMPS in complex arithmetic.
CHOSEN = ("rigid, under a load", "springs, sweep of speed", "beams, 100 N", "shells, condensed", "strip between plates, loop",
          "modes of a strip, Craig-Bampton")
VIBRATIONS = Scene("shells, small vibrations", merged(SHELL, scene={"analysis": "linear_dynamics"},
                                                       dynamics={"frequency_ratios": (0.5, 1.0)}), FILM)
PAGE = """# Systems on which gfb was built and tested

Written by `tools/check_systems --docs docs/measured/systems.md`: releases of Debian laid by debootstrap, each with its own
compilers and libraries, amd64. On each, bare at first, the README's two commands were called, `tools/run` and `tools/test` (with
64 bits: its unit tests), and small scenes ran, whose numbers are compared with those of the first row. *64 bits*: Debian's PETSc
and SLEPc of 64-bit indices (`libpetsc64-real-dev`, `libslepc64-real-dev`).

| system | date | gfortran | MPI | PETSc, SLEPc | HDF5 | MUMPS | METIS | SuiteSparse | tests |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
{systems}

Largest relative difference from Debian {first} of any number of a summary or a history, and its name; all are below {tolerance:.0e}:

| scene | {others} |
| --- | {rules} |
{scenes}

**MPICH** was not tried. On amd64 Debian 12 and 13 have PETSc, SLEPc and MUMPS for Open MPI alone (`mpi-default-dev` is
`libopenmpi-dev`); Debian 13 has them for MPICH where it is of 32 bits (i386). CMake refuses an HDF5 or a SLEPc of another MPI
than PETSc's.

**Newer PETSc.** `tools/check_petsc` builds PETSc and SLEPc 3.26.1 from their sources, on Debian 12
([cluster.md](../manual/cluster.md)). Not tried: what lies between 3.22 and 3.26, other compilers than gfortran, other
architectures than amd64, PETSc of 64-bit indices other than Debian's.
"""


def facts_of(folder):
    """What is known of each system, in the order of their names: {system: {fact: words}}."""
    return {path.stem: dict(line.split("\t", 1) for line in path.read_text(encoding="utf-8").splitlines())
            for path in sorted(folder.glob("*.found"), key=lambda path: (path.stem.endswith("-64"), path.stem))}


def compare(folder, systems):
    """Every scene by every system: {scene: {system: (difference, name)}}, and sentences of what is wrong."""
    found, wrong = {}, []
    for scene in [*(scene for scene in SCENES if scene.words in CHOSEN), VIBRATIONS]:
        text, base, found[scene.words] = str(Case(scene.case)), None, {}
        with tempfile.TemporaryDirectory() as name:
            for system in systems:
                place = pathlib.Path(name)/system
                place.mkdir()
                path = place/f"{scene.name}.nml"
                path.write_text(text, encoding="utf-8")
                answer = run_file(str(folder/f"{system}.gfb"), path, place, options=scene.options, seconds=SECONDS)
                if answer.status != scene.status:
                    wrong.append(f"{scene.words}, {system}: status {answer.status}\n{(answer.log + answer.complaint)[-1500:]}")
                elif base is None:
                    base = answer
                else:
                    differs = difference(base, answer, text)
                    found[scene.words][system] = differs.largest
                    if not differs.largest[0] <= TOLERANCE or not differs.columns:
                        wrong.append(f"{scene.words}, {system}: {differs.largest[1]} differs by {differs.largest[0]:.1e}")
    return found, wrong


def row(*cells):
    return "| " + " | ".join(cells) + " |"


def page_of(facts, found):
    """The page's text."""
    first, *others = facts
    systems = [row(f"Debian {system.removesuffix('-64')} ({known['release']}){', 64 bits' if system.endswith('-64') else ''}", known["date"],
                   known["gfortran"], "Open MPI " + known["MPI"], known["program"].partition("PETSc ")[2].partition(", BLAS")[0].replace("SLEPc ", ""),
                   known["HDF5"], known["MUMPS"], known["METIS"].partition(".dfsg")[0], known["KLU"], known.get("tests", "not run")) for system, known in facts.items()]
    scenes = [row(words, *(f"{values[other][0]:.0e}, `{values[other][1]}`" if values[other][0] > 0.0 else "none" for other in others)) for words, values in found.items()]
    return PAGE.format(systems="\n".join(systems), first=first, others=" | ".join(others), rules=" | ".join("---" for _ in others),
                       scenes="\n".join(scenes), tolerance=TOLERANCE)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", metavar="FOLDER", type=pathlib.Path, required=True, help="of tools/check_systems")
    parser.add_argument("--docs", metavar="FILE", type=pathlib.Path, help="page of what was found, where nothing failed")
    options = parser.parse_args()
    facts = facts_of(options.folder)
    found, wrong = compare(options.folder, facts)
    print(page_of(facts, found) if not wrong else "\n".join(wrong))
    if options.docs and not wrong:
        options.docs.write_text(page_of(facts, found), encoding="utf-8")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
