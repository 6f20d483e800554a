#!/usr/bin/env python3
"""An OpenBLAS that does not know the processor gets the kernel for it: once, where it is right, and where the user chose none."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import GFB, MPIEXEC, Checks  # noqa: E402
from gfb.bench.faults import CASE  # noqa: E402 (gfb_run has made it known)
from gfb.case import Case  # noqa: E402
from gfb.program import ENVIRONMENT  # noqa: E402

SECONDS = 900
AVX2 = {"avx2", "fma"}
AVX512 = {f"avx512{part}" for part in ("f", "dq", "bw", "vl", "cd")}


def kernel_of(words):
    """The kernel that a line with the BLAS' name tells."""
    found = re.search(r"BLAS .*, (\S+) kernel$", words, re.MULTILINE)
    return found and found[1]


def kernel_for_processor():
    """The one that the processor's flags ask for."""
    flags = set(re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)[1].split())
    if not AVX2 <= flags:
        return "Prescott"
    return "SkylakeX" if AVX512 <= flags else "Haswell"


def call(folder, *words, ranks=0, preload=None, **settings):
    """A run under settings of the environment, without those of the caller that choose a kernel: how it ended, and the notes of its
    choices where a library is loaded before its own."""
    notes = folder/"starts"
    notes.unlink(missing_ok=True)
    environment = {name: word for name, word in os.environ.items() if name != "OPENBLAS_CORETYPE"}
    environment |= ENVIRONMENT | settings
    if preload:
        environment |= {"LD_PRELOAD": preload, "STARTS": str(notes), "ASAN_OPTIONS": "detect_leaks=0,verify_asan_link_order=0"}
    command = [MPIEXEC, "-n", str(ranks), GFB, *words] if ranks else [GFB, *words]
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", check=False,
                          timeout=SECONDS, env=environment)
    return done, notes.read_text(encoding="utf-8").splitlines() if notes.exists() else []


def check_chosen(checks, folder, preload, wanted):
    """A library that fell back: the kernel of the processor, by one more choice; nothing of it is left in the environment."""
    done, notes = call(folder, "--version", preload=preload)
    checks.that(f"fallback: {kernel_of(done.stdout)} kernel", kernel_of(done.stdout) == wanted and not done.stderr)
    checks.that(f"one more choice: {notes}", notes == ["choice -", f"choice {wanted}", "end -"])
    for wrong in ("a little", "illegal"):
        done, notes = call(folder, "--version", preload=preload, WRONG_PRODUCT=wrong)
        checks.that(f"{wrong} wrong: the fallback again {done.stderr}", kernel_of(done.stdout) == "Prescott" and done.returncode == 0)
        checks.that(f"  and no more: {notes}", notes == ["choice -", f"choice {wanted}", "choice Prescott", "end -"])


def check_user(checks, folder, preload):
    """What the user has set stays, and is seen by what the program starts."""
    done, notes = call(folder, "--version", preload=preload, OPENBLAS_CORETYPE="Prescott")
    checks.that(f"the user's kernel: {kernel_of(done.stdout)}", kernel_of(done.stdout) == "Prescott")
    checks.that(f"no more choice: {notes}", notes == ["choice Prescott", "end Prescott"])


def check_runs(checks, folder, preload, wanted):
    """One rank and two compute with it."""
    (folder/"a case.nml").write_text(str(Case(CASE)), encoding="utf-8")
    for ranks in (0, 2):
        done, notes = call(folder, "--output", "two words", "a case.nml", "--petsc", "-name", "", ranks=ranks, preload=preload)
        checks.that(f"{ranks or 1} rank(s): status {done.returncode} {done.stderr}", done.returncode == 0)
        checks.that("  each has chosen", notes.count(f"choice {wanted}") == max(ranks, 1) == notes.count("end -"))
        checks.that("  the log names the kernel", f"{ranks or 1} rank(s)" in done.stdout and kernel_of(done.stdout) == wanted)


def main():
    checks = Checks()
    wanted = kernel_for_processor()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        now = kernel_of(call(folder, "--version")[0].stdout)
        checks.that(f"without a library before its own: {now}", now != "Prescott" or wanted == now)
        if now is None or wanted == "Prescott":
            print("no OpenBLAS, or a processor for which there is no choice: nothing more to see")
        else:
            check_chosen(checks, folder, sys.argv[1], wanted)
            check_user(checks, folder, sys.argv[1])
            check_runs(checks, folder, sys.argv[1], wanted)
    checks.close()


if __name__ == "__main__":
    main()
