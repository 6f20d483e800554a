"""Faults on purpose: full disks, failing calls, kills and damaged files, and what a run leaves after each.

A small case stands in a folder with its results. A run of another load into the same folder meets a fault at each of its
operations on files in turn; a preloaded library (faults.c) lets it fail. What counts: the exit status, a sentence, no crash,
and that the folder holds one whole set of results, the old one or the new.
"""

import collections
import os
import pathlib
import random
import shutil
import signal
import subprocess
import tempfile

from gfb.case import Case
from gfb.program import ENVIRONMENT, launcher
from gfb.results import SEAL_LENGTH, open_results, read_summary
from gfb.tables import markdown_table
from gfb.tool import ROOT

SOURCE = pathlib.Path(__file__).with_name("faults.c")
SECONDS = 120
PAGE = ROOT/"docs/measured/faults.md"
WORDS = """# Faults on purpose

A bearing of 32 x 4 elements is run into a folder that holds its results for another load. At each of its operations on files
in turn (create, write, sync, link, rename) that operation fails, or it and all that need room from then on, or the process is
killed (at removals, too); again where the file system has no hard links. *Done all the same*: status 0 and the new set whole
(after a kill: one whole set, once another run of the case has begun, though that is refused); *refused*: status 3, a sentence,
and the old set whole, to which nothing was added; *wrong*: anything else, such as a crash, a mixed set, a file left behind. `tools/bench faults
--page` writes this page; [failures.md](../manual/failures.md) says what to expect.

"""
CRASH = ("SIGSEGV", "Segmentation", "Backtrace", "MPI_ABORT", "PETSC ERROR", "HDF5-DIAG", "Fortran runtime error")
CASE = {
    "scene": {"analysis": "equilibrium"},
    "bearing": {"radius": 0.02, "length": 0.04, "clearance": 2.0e-5},
    "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5},
    "operation": {"speed_rpm": 20000.0, "load": (-20.0, 0.0)},
    "model": {"foil": "rigid"},
    "mesh": {"circumferential_elements": 32, "axial_elements": 4},
}
ENDINGS = ("summary", "h5", "film.vtkhdf", "used.nml")
Row = collections.namedtuple("Row", "fault tried survived refused wrong")


def add_options(parser):
    """Options of `tools/bench faults`."""
    parser.add_argument("--short", action="store_true", help="fewer faults, as the default tests have")
    parser.add_argument("--page", action="store_true", help=f"write {PAGE.relative_to(ROOT)} too")


def run(options):
    """The table of faults."""
    rows = all_rows(options.gfb, long=not options.short)
    head = ("fault", "tried", "done all the same", "refused with a sentence", "wrong")
    lines = [[row.fault, *map(str, (row.tried, row.survived, row.refused, len(row.wrong)))] for row in rows]
    table = markdown_table("Faults on purpose, and what a run leaves", head, lines)
    wrong = "".join(f"\nwrong: {row.fault}: {word}" for row in rows for word in row.wrong)
    if options.page:
        PAGE.write_text(WORDS + table + wrong, encoding="utf-8")
    return table + wrong


def build_library(folder):
    """The preloaded library; None where no compiler makes it."""
    library = pathlib.Path(folder)/"faults.so"
    done = subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-O1", "-o", str(library), str(SOURCE), "-ldl"],
                          capture_output=True, check=False)
    return library if done.returncode == 0 else None


def write_cases(folder):
    """The case whose results are there, and the one that is run over it."""
    for name, load in (("old", -20.0), ("new", -40.0)):
        place = pathlib.Path(folder)/name
        place.mkdir(exist_ok=True)
        (place/"case.nml").write_text(str(Case(CASE | {"operation": CASE["operation"] | {"load": (load, 0.0)}})),
                                      encoding="utf-8")


def call(gfb, case, folder, *words, environment=None, ranks=1):
    """Status and complaints of a run."""
    command = [gfb, "--quiet", *words, "--output", str(folder), str(case)]
    if ranks > 1:
        command = [launcher(gfb), "-n", str(ranks), *command]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", errors="replace",
                          check=False, timeout=SECONDS,
                          env={**ENVIRONMENT, **os.environ, **(environment or {})})
    return done.returncode, done.stderr + "".join(line for line in done.stdout.splitlines(True)
                                                  if any(word in line for word in CRASH))


def load_of(folder):
    """Loads that the files of a set say, one where they are one set."""
    stem = pathlib.Path(folder)/"case"
    with open_results(f"{stem}.h5") as file:
        loads = {round(float(file["summary/force_x"][()]), 6)}
        gap = float(file["summary/minimum_gap"][()])
    with open_results(f"{stem}.film.vtkhdf") as file:
        loads |= loads if abs(file["VTKHDF/PointData/gap"][...].min() - gap) < 1.0e-12*gap else {"another film"}
    loads.add(round(read_summary(f"{stem}.summary")[0]["force_x"], 6))
    echo = pathlib.Path(f"{stem}.used.nml").read_text(encoding="utf-8")
    loads.add(-20.0 if "load = -20" in echo else -40.0)
    return loads


def problem_after(folder, status, complaint, expected=(0, 3)):
    """What is wrong with how a run has ended; empty where nothing is."""
    if any(word in complaint for word in CRASH):
        return "crash: " + complaint[:200]
    if status not in expected:
        return f"status {status}: {complaint[:200]}"
    if status and not complaint.strip():
        return "no sentence"
    try:
        loads = load_of(folder)
    except (OSError, KeyError, ValueError) as error:
        return f"no whole set: {error}"
    if loads != {-40.0 if status == 0 else -20.0}:
        return f"status {status} with results of {sorted(map(str, loads))}"
    left = [path.name for path in folder.iterdir() if path.name.startswith(".gfb")]
    return f"left behind: {left}" if left else ""


class Faults:
    """Runs over a folder of results that is made anew each time."""

    def __init__(self, gfb, folder):
        self.gfb, self.folder = gfb, pathlib.Path(folder)
        write_cases(self.folder)
        self.kept = self.folder/"kept"
        status, complaint = call(gfb, self.folder/"old/case.nml", self.kept)
        if status != 0:
            raise RuntimeError(complaint)

    def anew(self, place=None):
        """A folder with the old results."""
        place = place or self.folder/"results"
        if place.exists():
            shutil.rmtree(place)
        shutil.copytree(self.kept, place)
        return place

    def over(self, place, **more):
        """A run over it."""
        return call(self.gfb, self.folder/"new/case.nml", place, **more)

    def operations(self, library, kind, step=1, ranks=1, links=True):
        """A fault at each operation in turn, on a file system with or without links."""
        survived, refused, wrong, at = 0, 0, [], 1
        count = self.folder/"count"
        while True:
            place = self.anew()
            count.unlink(missing_ok=True)
            status, complaint = self.over(place, ranks=ranks, environment={
                "LD_PRELOAD": str(library), "GFB_FAULT_FOLDER": str(place), "GFB_FAULT_AT": str(at),
                "GFB_FAULT_KIND": kind, "GFB_FAULT_COUNT": str(count), "GFB_FAULT_LINKS": "" if links else "none"})
            if kind == "kill":
                if status == 0:
                    break
                found = self.after_kill(place, status)
            else:
                found = problem_after(place, status, complaint, expected=(0, 3))
            survived += status == 0
            refused += status == 3
            if found:
                wrong.append(f"operation {at}: {found}")
            if not count.exists():
                wrong.append(f"operation {at}: no operation was seen: status {status}: {complaint[:200]}")
                break
            if kind != "kill" and int(count.read_text(encoding="utf-8")) < at:
                survived -= 1  # no fault any more
                break
            at += step
        tried = (at - 1 + step - 1)//step
        return Row({"once": "one call fails", "full": "disk full from a call on", "kill": "killed at a call"}[kind] +
                   (f", {ranks} ranks" if ranks > 1 else "") + ("" if links else ", no links on the disk"), tried, survived if kind != "kill" else tried - len(wrong),
                   refused, wrong)

    def after_kill(self, place, status):
        """The case's next run finishes or clears what a killed one has left, though it is refused itself; the set is one."""
        if status != -signal.SIGKILL:
            return f"status {status}"
        (place/"case.restart.h5").write_text("none", encoding="utf-8")
        status, complaint = call(self.gfb, self.folder/"new/case.nml", place, "--restart")
        (place/"case.restart.h5").unlink()
        if status != 3 or "case.restart.h5" not in complaint:
            return f"the next run: status {status}: {complaint[:200]}"
        try:
            loads = load_of(place)
        except (OSError, KeyError, ValueError) as error:
            return f"no whole set: {error}"
        if len(loads) != 1:
            return f"a set of {sorted(map(str, loads))}"
        left = [path.name for path in place.iterdir() if path.name.startswith((".gfb-file", ".gfb-set"))]
        return f"left behind: {left}" if left else ""

    def small_disk(self, sizes):
        """A disk of a few pages; None where the machine mounts none."""
        disk = self.folder/"disk"
        disk.mkdir(exist_ok=True)
        survived, refused, wrong, tried = 0, 0, [], 0
        need = sum(-(-path.stat().st_size//4096)*4096 for path in self.kept.iterdir())
        for more in sizes:
            done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={need + more}", "tmpfs", str(disk)],
                                  capture_output=True, check=False)
            if done.returncode != 0:
                return None
            try:
                place = self.anew(disk/"results")
                status, complaint = self.over(place)
                found = problem_after(place, status, complaint)
            finally:
                subprocess.run(["umount", str(disk)], check=False)
            tried, survived, refused = tried + 1, survived + (status == 0), refused + (status == 3)
            if found:
                wrong.append(f"{more} bytes left: {found}")
        return Row("disk (tmpfs) with a few pages left", tried, survived, refused, wrong)

    def damaged(self, flips):
        """Bits of a restart file that have changed."""
        sweep = CASE | {"sweep": {"parameter": "load", "values": tuple(10.0 + i % 20 for i in range(2000))}}
        case = self.folder/"sweep.nml"
        case.write_text(str(Case(sweep)), encoding="utf-8")
        place = self.folder/"sweep"
        call(self.gfb, case, place, "--time-limit", "1")
        file = place/"sweep.restart.h5"
        whole = file.read_bytes()
        chance, survived, refused, wrong = random.Random(1), 0, 0, []
        for _ in range(flips):
            bit = chance.randrange(8*len(whole))
            damaged = bytearray(whole)
            damaged[bit//8] ^= 1 << bit % 8
            file.write_bytes(damaged)
            status, complaint = call(self.gfb, case, place, "--restart", "--time-limit", "1")
            refused += status == 3
            if status != 3 or "sweep.restart.h5: the file" not in complaint or any(word in complaint for word in CRASH):
                wrong.append(f"bit {bit}: status {status}: {complaint[:100]}")
        cuts = range(0, len(whole), len(whole)//9)
        for cut in cuts:
            file.write_bytes(whole[:cut])
            status, complaint = call(self.gfb, case, place, "--restart", "--time-limit", "1")
            refused += status == 3
            if status != 3 or "sweep.restart.h5: the file" not in complaint:
                wrong.append(f"cut at {cut}: status {status}: {complaint[:100]}")
        file.write_bytes(whole)
        return Row("a bit of a restart file changed, or its end is missing", flips + len(cuts), survived, refused, wrong)

    def damaged_results(self, flips):
        """Bits of a result file that have changed, its end missing: as tools/plot and the other tools open it."""
        whole, place = (self.kept/"case.h5").read_bytes(), self.folder/"damaged.h5"
        chance, refused, wrong = random.Random(2), 0, []
        spoiled = [(f"cut at {cut}", whole[:cut]) for cut in range(0, len(whole) - SEAL_LENGTH, len(whole)//9)]
        for bit in (chance.randrange(8*len(whole)) for _ in range(flips)):
            content = bytearray(whole)
            content[bit//8] ^= 1 << bit % 8
            spoiled.append((f"bit {bit}", bytes(content)))
        for words, content in spoiled:
            place.write_bytes(content)
            try:
                open_results(place).close()
                wrong.append(f"{words}: is read")
            except OSError:
                refused += 1
        return Row("a bit of a result file changed, or its end is missing, read by the tools", len(spoiled), 0, refused, wrong)

    def no_start(self):
        """Settings with which MPI does not start; Open MPI 5 has no folder of that name, and starts."""
        settings = [{"OMPI_MCA_pml": "nonsense"}, {"OMPI_MCA_btl": "nonsense"}, {"OMPI_MCA_orte_tmpdir_base": "/proc"}]
        refused, done, wrong = 0, 0, []
        for one in settings:
            place = self.anew()
            status, complaint = self.over(place, environment=one)
            unknown = status == 0 and "OMPI_MCA_orte_tmpdir_base" in one
            refused, done = refused + (status == 3), done + unknown
            found = "" if unknown or status == 3 and "MPI could not start" in complaint else f"status {status}: {complaint[:200]}"
            found = found or problem_after(place, status, "a sentence", expected=(0, 3) if unknown else (3,))
            if found:
                wrong.append(f"{one}: {found}")
        return Row("MPI cannot start", len(settings), done, refused, wrong)


def all_rows(gfb, long=True, flips=200):
    """Every kind of fault; so many damaged files where it is long."""
    rows = []
    with tempfile.TemporaryDirectory() as name:
        faults = Faults(gfb, name)
        library = build_library(name)
        if library:
            rows.append(faults.operations(library, "once", step=1 if long else 5))
            rows += [faults.operations(library, "kill", step=1 if long else 4, links=links) for links in (True, False)]
            if long:
                rows += [faults.operations(library, kind, links=False) for kind in ("once", "full")]
                rows.append(faults.operations(library, "full"))
                rows.append(faults.operations(library, "full", ranks=2))
        rows.append(faults.small_disk([4096*i for i in range(40 if long else 5)]))
        rows.append(faults.damaged(flips if long else 10))
        rows.append(faults.damaged_results(flips if long else 20))
        rows.append(faults.no_start())
    return [row for row in rows if row]
