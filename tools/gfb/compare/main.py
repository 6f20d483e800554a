"""Runs many scenes by two programs of gfb and compares their results bit by bit, on one rank.

BEFORE and AFTER are programs, or git revisions, which are built once in build/compare. The scenes are all files of inputs/,
a few variants of them, and the small scenes of tests/floating_point. Every dataset and attribute, every line of a summary,
every key used and the exit status must be the same; the table shows what is left out. A scene with restart files is run
twice, the second time from where the first one ended. What BEFORE answered is kept, by its own bits, those of its
libraries and the case: the next time only AFTER runs.

  tools/compare HEAD --small                  this checkout's release build against what was committed
  tools/compare build/release/gfb --small     whether a program repeats itself
  tools/compare v1 v2 --only strip            two revisions, scenes whose names match a regular expression

Exit status: 0 all equal, 1 something differs, or the call is wrong, 3 the machine or a program failed.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time

from gfb.build import BUILDS, kernel_of, program_of, version_of
from gfb.compare.results import EXCLUDED, folder_differences
from gfb.compare.runs import fingerprint, kept_run, run, tasks
from gfb.program import find_gfb
from gfb.tables import plain_table
from gfb.tool import stop

EQUAL, DIFFERS, FAILED = 0, 1, 3
SHOWN = 10  # differences of a scene, without --all
ENDINGS = {"0": "", "1": "refused", "2": "no answer"}


def parsed():
    """The options."""
    parser = argparse.ArgumentParser(prog="tools/compare", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", metavar="BEFORE", help="a program or a git revision")
    parser.add_argument("after", metavar="AFTER", nargs="?", help="the same; default: build/release/gfb")
    parser.add_argument("--small", action="store_true", help="inputs on coarser meshes: one minute instead of some five")
    parser.add_argument("--only", metavar="PATTERN", default="", help="scenes whose names this regular expression is in")
    parser.add_argument("--list", action="store_true", help="show the names of the scenes, run nothing")
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count() or 1,
                        help="scenes at a time; default: %(default)s, a core each")
    parser.add_argument("--all", action="store_true", help=f"show all differences, not the largest {SHOWN} of a scene")
    parser.add_argument("--keep", metavar="DIR", type=pathlib.Path, help="keep the results of both in DIR/before, DIR/after")
    parser.add_argument("--store", metavar="DIR", type=pathlib.Path, default=BUILDS/"results",
                        help="folder of what BEFORE answered; default: build/compare/results")
    options = parser.parse_args()
    if options.jobs < 1:
        stop("--jobs: at least 1")
    try:
        options.only = re.compile(options.only)
    except re.error as error:
        stop(f"--only: {error}")
    return options


def compared(task, programs, store, folder):
    """A task by both programs: whether it is equal, and its lines of the report."""
    before = kept_run(programs[0], task, store)
    after = run(programs[1], task, folder/"after"/task.name)
    (folder/"before").mkdir(exist_ok=True)
    (folder/"before"/task.name).symlink_to(before.folder.resolve())
    times = f"{before.seconds:.1f} s, " if before.seconds else ""
    heading = f"{task.name} ({times}{after.seconds:.1f} s)"
    for which, ended in (("before", before), ("after", after)):
        if ended.failed:
            return FAILED, [f"FAILED   {heading}", f"{which}: status {ended.status}: {ended.failed}"]
    lines = []
    if before.status != after.status:
        lines.append(f"exit status {before.status} before, {after.status} after")
    elif "1" in before.status.split():
        lines.append("refused by both: nothing is compared")
    lines += [f"{one.where}: {one.words}" for one in folder_differences(before.folder, after.folder)]
    if lines:
        return DIFFERS, [f"DIFFERS  {heading}: {len(lines)} differences", *lines]
    words = " then ".join(filter(None, map(ENDINGS.get, before.status.split())))
    return EQUAL, [f"equal    {heading}" + (f", {words}" if words else "")]


def shown(lines, everything):
    """The lines of a scene."""
    if not everything and len(lines) > SHOWN + 2:
        lines = [*lines[:SHOWN + 1], f"... and {len(lines) - SHOWN - 1} more (--all)"]
    print("\n         ".join(lines), flush=True)


def compare_all(chosen, programs, options, folder):
    """Compares all tasks, some at a time; how many ended how."""
    store = options.store/fingerprint(programs[0])
    counts = dict.fromkeys((EQUAL, DIFFERS, FAILED), 0)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        waiting = [pool.submit(one_task, task, programs, store, folder, options.keep) for task in chosen]
        try:
            for one in waiting:
                outcome, lines = one.result()
                counts[outcome] += 1
                shown(lines, options.all)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return counts


def one_task(task, programs, store, folder, keep):
    """The same of one; its results go at once where they are not kept: those of all would fill a disk."""
    try:
        answer = compared(task, programs, store, folder)
    except subprocess.TimeoutExpired as error:
        return FAILED, [f"FAILED   {task.name}: no end after {error.timeout:.0f} s"]
    if keep:
        link = folder/"before"/task.name
        kept = link.resolve()
        link.unlink()
        if kept.exists():
            shutil.copytree(kept, link)
    else:
        shutil.rmtree(folder/"after"/task.name)
    return answer


def main():
    options = parsed()
    try:
        return compare(options)
    except (OSError, subprocess.SubprocessError) as wrong:
        return stop(str(wrong), FAILED)


def compare(options):
    """Compares the scenes that are chosen; the exit status."""
    chosen = [task for task in tasks(options.small) if options.only.search(task.name)]
    if not chosen:
        stop("--only: no scene's name matches")
    if options.list:
        print("\n".join(task.name for task in chosen))
        return EQUAL
    programs = (program_of(options.before, "BEFORE"),
                program_of(options.after, "AFTER") if options.after else find_gfb())
    if (kernel := kernel_of(programs[1])):  # for both: kernels round differently
        os.environ.setdefault("OPENBLAS_CORETYPE", kernel)
    for which, program in zip(("before", "after "), programs):
        print(f"{which}: {program}: {version_of(program)}")
    print(plain_table("left out of the comparison", ["name", "why"], [list(one) for one in EXCLUDED.items()]))
    begun = time.monotonic()
    if options.keep:
        if options.keep.exists() and any(options.keep.iterdir()):
            stop(f"--keep {options.keep}: is not empty")
        options.keep.mkdir(parents=True, exist_ok=True)
        counts = compare_all(chosen, programs, options, options.keep.resolve())
    else:
        options.store.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=options.store) as folder:
            counts = compare_all(chosen, programs, options, pathlib.Path(folder))
    print(f"\n{len(chosen)} scenes: {counts[EQUAL]} equal, {counts[DIFFERS]} differ, {counts[FAILED]} failed; "
          f"{time.monotonic() - begun:.0f} s")
    return FAILED if counts[FAILED] else DIFFERS if counts[DIFFERS] else EQUAL
