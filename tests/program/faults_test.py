#!/usr/bin/env python3
"""Full disks, failing calls, kills, damaged files, links, two runs at once: one whole set of results stays, and a sentence says
what has happened. With --long, alone, every operation on files of a small run fails once, and for ever, and is a run's last, and many more
files are damaged."""

import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1]/name) for name in ("verification", "floating_point")]
from gfb_run import GFB, Checks, write_case  # noqa: E402
from gfb.bench import faults  # noqa: E402 (gfb_run has made it known)
from scenes import PLATES, ROTOR, SHELL, merged  # noqa: E402

FLIPS = 50  # damaged files of each kind; tools/bench faults has 200
SWEEP = {"sweep": {"parameter": "load", "values": tuple(10.0 + i for i in range(20))}}


def run(case, folder, *words, **more):
    """A run and what it says."""
    return subprocess.run([GFB, "--output", str(folder), *words, str(case)], stdin=subprocess.DEVNULL,
                          capture_output=True, encoding="utf-8", check=False, timeout=faults.SECONDS, **more)


def check_two_runs(checks, folder):
    """A second run of a case is refused while the first one is under way; another case is not. The
    first one is stopped meanwhile, and goes on then."""
    case = write_case(folder, "twice", faults.CASE | SWEEP)
    other = write_case(folder, "other", faults.CASE)
    place = folder/"two"
    with subprocess.Popen([GFB, "--output", str(place), str(case)], stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, encoding="utf-8") as first:
        for line in first.stdout:
            if line.startswith("point 2 of"):
                break
        first.send_signal(signal.SIGSTOP)
        second, third = run(case, place), run(other, place)
        checks.that("the first one was still there", first.poll() is None)
        first.send_signal(signal.SIGCONT)
        first.communicate(timeout=faults.SECONDS)
    checks.that(f"a second run: status {second.returncode}, {second.stderr.strip()}", second.returncode == 3
                and "another run of this case writes its results here" in second.stderr)
    checks.that("another case in the same folder", third.returncode == 0)
    checks.that("the first run", first.returncode == 0 and (place/"twice.summary").exists())
    checks.that("nothing is left of the lock", not list(place.glob(".gfb*")))


def check_links(checks, folder):
    """Links that stand where results are to stand are replaced, not followed."""
    case = write_case(folder, "linked", faults.CASE)
    place = folder/"links"
    place.mkdir()
    precious = folder/"precious"
    precious.write_text("mine", encoding="utf-8")
    for ending in faults.ENDINGS:
        (place/f"linked.{ending}").symlink_to(precious)
    done = run(case, place)
    checks.that("links: status 0", done.returncode == 0)
    checks.that("links: what they led to is as it was", precious.read_text(encoding="utf-8") == "mine")
    checks.that("links: results instead", all(not (place/f"linked.{ending}").is_symlink() for ending in faults.ENDINGS))


def check_full_log(checks, folder):
    """A log that cannot be written does not cost the results."""
    case = write_case(folder, "log", faults.CASE)
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run([GFB, "--output", str(folder/"log"), str(case)], stdin=subprocess.DEVNULL, stdout=full,
                              stderr=subprocess.PIPE, check=False, timeout=faults.SECONDS)
    checks.that(f"log on a full disk: status {done.returncode}", done.returncode == 0)
    checks.that("log on a full disk: the results are there", (folder/"log/log.summary").exists())


def told(done, status, words):
    """Whether a run has ended with a status and one sentence."""
    return (done.returncode == status and words in done.stderr and done.stderr.count("\n") == 1
            and not any(word in done.stderr for word in faults.CRASH))


def check_petsc_options(checks, folder):
    """What PETSc was told wrongly, at its start, in a run and at its end; a folder that is gone: not MPI's fault."""
    case = write_case(folder, "options", faults.CASE)
    for options in ("-options_file /nonexistent", "-malloc_debug nonsense", "-info /nonexistent/x", "-bearing_ksp_type nonsense",
                    "-log_view :/nonexistent/x", "-options_view :/nonexistent/x"):
        done = run(case, folder/"options", "--quiet", env={**os.environ, "PETSC_OPTIONS": options})
        checks.that(f"PETSC_OPTIONS='{options}': status {done.returncode}: {done.stderr.strip()[-200:]}",
                    told(done, 3, f"PETSC_OPTIONS is '{options}'"))
    gone = folder/"gone"
    gone.mkdir()
    done = subprocess.run(["bash", "-c", f"cd {gone} && rmdir {gone} && exec {GFB} --output {folder/'options'} {case}"],
                          capture_output=True, encoding="utf-8", check=False, timeout=faults.SECONDS)
    checks.that(f"a folder that is gone: status {done.returncode}: {done.stderr.strip()[-200:]}",
                told(done, 3, "the folder in which it was started is not there"))


def check_little_memory(checks, folder):
    """Whatever addresses a process may have: an answer, or a sentence and status 3, and soon."""
    case = write_case(folder, "little", faults.CASE)
    by_mumps = {**os.environ, "PETSC_OPTIONS": "-bearing_pc_factor_mat_solver_type mumps"}
    seen = set()
    for megabytes in (180, 240, 300, 360, 600):
        try:
            done = run(case, folder/"little", "--quiet", env=by_mumps,
                       preexec_fn=lambda room=megabytes << 20: resource.setrlimit(resource.RLIMIT_AS, (room, room)))
        except subprocess.TimeoutExpired:
            checks.that(f"{megabytes} MB: it ends", False)
            continue
        if "error while loading shared libraries" in done.stderr:
            continue
        seen.add(done.returncode)
        checks.that(f"{megabytes} MB: status {done.returncode}: {done.stderr.strip()[-200:]}", done.returncode == 0 or (
            done.returncode == 3 and "memory" in done.stderr and not any(word in done.stderr for word in faults.CRASH)))
    checks.that("little memory: both were seen", seen == {0, 3})


def check_small_stack(checks, folder):
    """A stack of 128 kB is enough: what is large is allocated."""
    for name, case in (("beams", merged(SHELL, model={"foil": "beam"}, mesh={"axial_elements": 16})), ("strip", PLATES)):
        path = write_case(folder, name, case)
        done = subprocess.run(["bash", "-c", f"ulimit -s 128 && exec {GFB} --output {folder/'stack'} {path}"],
                              stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", check=False,
                              timeout=faults.SECONDS)
        checks.that(f"a stack of 128 kB, {name}: status {done.returncode}", done.returncode == 0)


def check_older_surfaces(checks, folder):
    """An answer leaves no file of a state without one, whatever surfaces that had; those of other cases stay."""
    case = write_case(folder, "older", merged(ROTOR, scene={"analysis": "transient"}, rotor={
        "transverse_inertia": 5.0e-3, "bearing_distance": 0.2}, transient={"turns": 0.1, "steps_per_turn": 20}))
    place = folder/"surfaces"
    run(case, place)
    surface = (place/"older.film_2.vtkhdf").read_bytes()
    for name in ("film", "film_2", "film_2.steps", "other.film"):
        (place/f"older.unconverged.{name}.vtkhdf").write_bytes(surface)
    for ending in ("h5", "used.nml"):
        shutil.copy(place/f"older.{ending}", place/f"older.unconverged.{ending}")
    (place/"older.unconverged.summary").write_text("converged = false\n", encoding="utf-8")
    done = run(case, place)
    left = {path.name for path in place.glob("older.unconverged.*")}
    checks.that(f"older surfaces: status {done.returncode}, left {left}",
                done.returncode == 0 and "removed: " in done.stdout and left == {"older.unconverged.other.film.vtkhdf"})


def check_readers(checks, folder):
    """tools/plot answers a damaged, cut or foreign file with one sentence."""
    case = write_case(folder, "read", faults.CASE)
    run(case, folder/"read")
    file = folder/"read/read.film.vtkhdf"
    whole = file.read_bytes()
    plot = pathlib.Path(__file__).resolve().parents[2]/"tools/plot"
    damaged = bytearray(whole)
    damaged[len(whole)//2] ^= 4
    for words, content in (("damaged", bytes(damaged)), ("cut", whole[:len(whole)//3]), ("foreign", b"no HDF5 at all\n"),
                           ("empty", b"")):
        file.write_bytes(content)
        done = subprocess.run([sys.executable, str(plot), "--output", str(folder/"p.png"), str(file)], capture_output=True,
                              encoding="utf-8", check=False, timeout=faults.SECONDS,
                              env={**os.environ, "PYTHONPATH": str(plot.parent)})
        checks.that(f"tools/plot, {words}: {done.stderr.strip()}", done.returncode == 1 and done.stderr.count("\n") == 1
                    and "Traceback" not in done.stderr)


def main():
    checks, long = Checks(), "--long" in sys.argv
    with tempfile.TemporaryDirectory() as name:
        for check in (check_two_runs, check_links, check_full_log, check_readers, check_petsc_options, check_little_memory,
                      check_small_stack, check_older_surfaces):
            if not long:
                check(checks, pathlib.Path(name))
    rows = faults.all_rows(GFB, long, FLIPS)
    checks.that("faults were tried", len(rows) > 0)
    for row in rows:
        checks.that(f"{row.fault}: {row.tried} tried, {row.survived} done all the same, {row.refused} refused {row.wrong}",
                    row.tried > 0 and not row.wrong)
    checks.close()


if __name__ == "__main__":
    main()
