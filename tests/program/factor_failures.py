#!/usr/bin/env python3
"""Factors that MUMPS cannot make: a larger workspace, or a sentence and a status of gfb's, never PETSc's abort."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent/"verification"))

from gfb_run import GFB, Checks  # noqa: E402 (found only now; it says where the following is)
from gfb.bench.population.members import BEAM, SHELL, engineer_member  # noqa: E402
from gfb.run import DONE, NOT_CONVERGED, run_file, write_case  # noqa: E402

MACHINE = 3  # status where a file or the machine failed
TINY = -95   # of the workspace that MUMPS estimates, on top of it [%]
ENLARGED = "the factors' workspace was too small"
LIGHT = {model: engineer_member(270, 20.0, 80000.0, model).groups for model in (BEAM, SHELL)}
for groups in LIGHT.values():
    groups["mesh"] = {"circumferential_elements": 104, "axial_elements": 4, "arc_elements": 4, "flat_elements": 1}


def solve(folder, options, model=BEAM, ranks=1):
    """The bearing with options of PETSc's."""
    path = write_case(folder, "case", LIGHT[model])
    return run_file(GFB, path, folder, ranks, options=("--quiet",), environment={"PETSC_OPTIONS": options}, seconds=300)


def check_small_workspace(checks, folder):
    """Too little room for pivoting is enlarged, and the answer is the same."""
    plain = solve(folder, "")
    checks.that("the workspace is large enough by default", plain.status == DONE and ENLARGED not in plain.log)
    for room in (TINY, 1):
        answer = solve(folder, f"-bearing_mat_mumps_icntl_14 {room}")
        checks.that(f"{room} %: enlarged {answer.log.count(ENLARGED)} time(s), status {answer.status}",
                    answer.status == DONE and answer.log.count(ENLARGED) <= 5)
        if room == TINY:
            checks.that("so small a workspace is too small", ENLARGED in answer.log)
        if answer.status == DONE:
            checks.that("the same answer, to the last digit", answer.physical() == plain.physical())


def check_failures(checks, folder):
    """What no workspace helps: factors in files in a folder that is not there, factors that are thrown away."""
    for words, options, said, statuses in (
            ("no such folder", "-bearing_mat_mumps_icntl_22 1 -bearing_mat_mumps_ooc_tmpdir /no/such/folder",
             "MUMPS could not write its factors", (NOT_CONVERGED,)),
            ("no factors are kept", "-bearing_mat_mumps_icntl_31 1", "a library failed", (MACHINE,))):
        answer = solve(folder, options)
        text = answer.log + answer.complaint
        checks.that(f"{words}: status {answer.status}: {text.strip().splitlines()[-1][:120] if text.strip() else ''}",
                    answer.status in statuses and said in text and "PETSC ERROR" not in text)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_small_workspace(checks, folder)
        check_failures(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
