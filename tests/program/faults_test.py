#!/usr/bin/env python3
"""Full disks, failing calls, kills, damaged files, links, two runs at once: one whole set of results stays, and a sentence says
what has happened. With --long every operation on files of a small run fails once, and for ever, and is a run's last."""

import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import GFB, Checks, write_case  # noqa: E402
from gfb.bench import faults  # noqa: E402 (gfb_run has made it known)

SWEEP = {"sweep": {"parameter": "load", "values": tuple(10.0 + i % 20 for i in range(1500))}}


def run(case, folder, *words, **more):
    """A run and what it says."""
    return subprocess.run([GFB, "--output", str(folder), *words, str(case)], stdin=subprocess.DEVNULL,
                          capture_output=True, encoding="utf-8", check=False, timeout=faults.SECONDS, **more)


def check_two_runs(checks, folder):
    """A second run of a case is refused while the first one is under way; another case is not."""
    case = write_case(folder, "twice", faults.CASE | SWEEP)
    other = write_case(folder, "other", faults.CASE)
    place = folder/"two"
    with subprocess.Popen([GFB, "--output", str(place), str(case)], stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, encoding="utf-8") as first:
        for line in first.stdout:
            if line.startswith("point 2 of"):
                break
        second, third = run(case, place), run(other, place)
        checks.that("the first one was still there", first.poll() is None)
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
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        for check in (check_two_runs, check_links, check_full_log, check_readers):
            check(checks, pathlib.Path(name))
    rows = faults.all_rows(GFB, long="--long" in sys.argv)
    checks.that("faults were tried", len(rows) > 0)
    for row in rows:
        checks.that(f"{row.fault}: {row.tried} tried, {row.survived} done all the same, {row.refused} refused {row.wrong}",
                    row.tried > 0 and not row.wrong)
    checks.close()


if __name__ == "__main__":
    main()
