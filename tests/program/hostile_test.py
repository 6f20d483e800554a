#!/usr/bin/env python3
"""Folders that somebody else has filled: whatever stands there, a run changes nothing but what begins with its case's name and
gfb's own files of this user, follows and waits for nothing, and ends with a sentence.

Everything precious lies outside the folder, or in it under another name; links, pipes, folders, lists of files to be renamed and
locks stand where gfb looks."""

import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import GFB, Checks, write_case  # noqa: E402
from gfb.bench import faults  # noqa: E402 (gfb_run has made it known)

SECONDS = 60
CASE = faults.CASE | {"mesh": {"circumferential_elements": 24, "axial_elements": 4}}
SWEEP = CASE | {"sweep": {"parameter": "load", "values": (10.0, 20.0)}, "output": {"restart_every": 1}}
NOBODY = 65534
SIZE = 1 << 40  # of a file with a hole [bytes]


def lock_of(name):
    """Name of a case's lock: the hash FNV-1a of the case's name."""
    mark = 2166136261
    for letter in name.encode():
        mark = (mark ^ letter)*16777619 % 2**32
    return f".gfb-lock-{mark:08X}"


def seen(folder, but=()):
    """What stands in a folder: of each name kind, owner, rights, links and contents."""
    found = {}
    for path in sorted(folder.rglob("*")):
        about = path.lstat()
        if path.name.startswith(but):
            continue
        content = path.read_bytes() if stat.S_ISREG(about.st_mode) and about.st_size < 1 << 24 else about.st_size
        content = os.readlink(path) if path.is_symlink() else content
        found[str(path.relative_to(folder))] = (about.st_mode, about.st_uid, about.st_ino, about.st_nlink, content)
    return found


def words(*names, end="all"):
    """A list as gfb writes it."""
    return "".join(f"{name}\0" for name in (*names, *([end] if end else []))).encode()


class Hostile:
    """A folder that is filled anew for each trial, and what lies beside it."""

    def __init__(self, checks, folder):
        self.checks, self.folder = checks, folder
        self.place, self.outside = folder/"place", folder/"outside"
        self.case = write_case(folder, "case", CASE)
        self.sweep = write_case(folder, "sweep", SWEEP)

    def anew(self):
        """An empty folder beside precious files."""
        for path in (self.place, self.outside):
            shutil.rmtree(path, ignore_errors=True)
            path.mkdir()
        for name in ("precious", "other", "payload"):
            (self.outside/name).write_text(f"{name} and mine", encoding="utf-8")
        for name in ("notes.txt", "case_2.h5", "other.h5", "caseh5", ".profile"):
            (self.place/name).write_text(f"{name} is mine", encoding="utf-8")
        return self.place

    def run(self, name, *options, status=(0,), case=None, kept=(), quiet=False):
        """A run in the folder as it is: nothing else changes, and it ends with one of these statuses and its sentence."""
        case = case or self.case
        own = (f"{case.stem}.", ".gfb-")
        before, inside, held = seen(self.outside), seen(self.place, own), seen(self.place)
        try:
            done = subprocess.run([GFB, "--output", str(self.place), *(["--quiet"] if quiet else []), *options, str(case)],
                                  stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", check=False, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            self.checks.that(f"{name}: it ends", False)
            return None
        complaint = done.stderr.strip()
        self.checks.that(f"{name}: status {done.returncode}: {complaint[-300:]}", done.returncode in status
                         and (done.returncode == 0 or complaint.count("\n") == 0 and len(complaint) > 0)
                         and not any(word in done.stderr for word in faults.CRASH))
        self.checks.that(f"{name}: nothing outside has changed", seen(self.outside) == before)
        self.checks.that(f"{name}: nothing else in the folder has changed", seen(self.place, own) == inside)
        after = seen(self.place)
        gone = [path for path in kept if after.get(path) != held[path]]
        self.checks.that(f"{name}: it leaves {gone[:5]}", not gone)
        return done


def plant_lists(hostile):
    """Lists that are not to be obeyed, each with a payload of its own; their names."""
    place, outside = hostile.place, hostile.outside
    targets = {"up": "../outside/precious", "whole": str(outside/"precious"), "below": "sub/precious", "here": "./case.csv",
               "bare": "notes.txt", "hidden": ".profile", "neighbour": "case_2.h5", "another": "other.h5", "joined": "caseh5",
               "input": "case.nml", "itself": "case.", "nothing": ""}
    names = []

    def plant(name, content, mode=0o600):
        path = place/f".gfb-set-{name}"
        path.write_bytes(content)
        path.chmod(mode)
        names.append(path.name)
        return path

    def payload(name):
        (place/f".gfb-file-{name}").write_text("from a stranger", encoding="utf-8")
        return f".gfb-file-{name}"

    (place/"sub").mkdir()
    (place/"sub/precious").write_text("mine, too", encoding="utf-8")
    for number, (name, target) in enumerate(targets.items()):
        plant(name, words(payload(f"1-{number}"), target))
        plant(f"{name}-3", words(payload(f"2-{number}"), "case.csv", payload(f"3-{number}"), target))
        plant(f"{name}-0", words(payload(f"4-{number}"), target, end=""))  # put back what was kept
        (place/f".gfb-file-{name}-0-0.old").write_text("from a stranger", encoding="utf-8")
    for name, source in (("s1", "notes.txt"), ("s2", "../outside/precious"), ("s3", str(outside/"precious")), ("s4", "sub/precious")):
        plant(name, words(source, "case.csv"))
    (place/".gfb-file-5-1").symlink_to(outside/"precious")
    os.link(outside/"other", place/".gfb-file-5-2")
    os.mkfifo(place/".gfb-file-5-3")
    (place/".gfb-file-5-4").mkdir()
    for number in range(1, 5):
        plant(f"5-{number}", words(f".gfb-file-5-{number}", "case.csv"))
    good = words(payload("6-1"), "case.csv")
    plant("7-1", good, 0o620)
    plant("7-2", good, 0o602)
    (outside/"list").write_bytes(good)
    (place/".gfb-set-7-3").symlink_to(outside/"list")
    os.link(outside/"list", place/".gfb-set-7-4")
    os.mkfifo(place/".gfb-set-7-5")
    (place/".gfb-set-7-6").mkdir()
    (place/".gfb-set-7-7").symlink_to(outside/"nowhere")
    names.extend(f".gfb-set-7-{number}" for number in range(3, 8))
    plant("8-1", words(*(["../outside/precious"]*20000)))
    plant("8-2", words(*(["../outside/precious"]*200000)))
    long = words(payload("9-1"), "../outside/precious")
    for length in range(len(long) - 8, len(long)):  # cut within the last names, or the end
        plant(f"9-{length}", long[:length])
    del names[-8:-4]  # without a whole pair: nothing is to be done, it may go
    if os.geteuid() == 0:
        os.chown(plant("10-1", good), NOBODY, NOBODY)
        plant("10-2", words(".gfb-file-10-2", "case.csv"))
        os.chown(place/payload("10-2"), NOBODY, NOBODY)
    return names


def check_lists(checks, hostile):
    """No list of a stranger is obeyed; they stay, and the log says so once."""
    hostile.anew()
    names = plant_lists(hostile)
    done = hostile.run("planted lists", kept=names)
    checks.that("planted lists: the log says so", done and done.stdout.count("not obeyed") == 2
                and f"and {len(names) - 1} more" in done.stdout)  # where it is seen, and at the end
    checks.that("planted lists: no table appears", not (hostile.place/"case.csv").exists())


def check_finish(checks, hostile):
    """Lists of the case are finished by its next run, even by one that is refused; another case leaves them."""
    place = hostile.anew()
    content = {".gfb-file-1-0": "new", ".gfb-file-2-0": "begun", ".gfb-file-2-0-0.old": "older", ".gfb-file-5-0": "nobody's"}
    lists = {".gfb-set-1-0": words(".gfb-file-1-0", "case.csv"), ".gfb-set-4-0": b"",
             ".gfb-set-2-0": words(".gfb-file-2-0", "case.coefficients.csv", end=""), ".gfb-set-5-0": b".gfb-fi",
             ".gfb-set-3-0": words(".gfb-file-3-0", "case.unconverged.top_foil.steps.vtkhdf")}
    for name, written in (content | lists).items():
        (place/name).write_bytes(written if isinstance(written, bytes) else written.encode())
        (place/name).chmod(0o600)
    stay = [*content, ".gfb-set-1-0", ".gfb-set-2-0", ".gfb-set-3-0"]
    hostile.run("another case", case=hostile.sweep, kept=stay)
    (place/"case.restart.h5").write_text("no restart file", encoding="utf-8")
    hostile.run("the case, refused", "--restart", status=(3,))
    found = {name: (place/name).read_text(encoding="utf-8") for name in ("case.csv", "case.coefficients.csv")}
    checks.that(f"its lists are finished: {found}", found == {"case.csv": "new", "case.coefficients.csv": "older"})
    left = [path.name for path in place.glob(".gfb*")]
    checks.that(f"nothing of gfb's is left: {left}", not left)


def check_many(checks, hostile):
    """Thousands of names end soon."""
    place = hostile.anew()
    for number in range(3000):
        (place/f".gfb-file-1-{number}-0.old").write_bytes(b"")
        (place/f".gfb-file-2-{number}").write_bytes(b"")
    hostile.run("thousands of files", quiet=True)
    checks.that("thousands of files: they are gone", not list(place.glob(".gfb*")))
    for number in range(3000):
        (place/f".gfb-set-{number}").write_bytes(words("notes.txt", "../outside/precious"))
    names = [path.name for path in place.glob(".gfb*")]
    hostile.run("thousands of lists", kept=names, quiet=True)


def check_temporary_names(checks, hostile):
    """Links, pipes and folders under names of unfinished files stay, or go as names alone."""
    place = hostile.anew()
    (place/".gfb-file-1-0").symlink_to(hostile.outside/"precious")
    os.mkfifo(place/".gfb-file-1-1")
    (place/".gfb-file-1-2").mkdir()
    (place/".gfb-file-1-2/deep").write_text("mine", encoding="utf-8")
    (place/".gfb-file-1-3-0.old").mkdir()
    (place/".gfb-file-1-4-0.old").symlink_to(hostile.outside/"precious")
    names = [".gfb-file-1-1", ".gfb-file-1-2", ".gfb-file-1-2/deep", ".gfb-file-1-3-0.old"]
    if os.geteuid() == 0:
        for name in (".gfb-file-1-5", ".gfb-file-1-6-0.old"):
            (place/name).write_text("another's", encoding="utf-8")
            os.chown(place/name, NOBODY, NOBODY)
            names.append(name)
    hostile.run("temporary names", kept=names)


def stand(kind, path, outside):
    """A thing of a kind under a name."""
    if kind == "link":
        path.symlink_to(outside/"precious")
    elif kind == "dangling link":
        path.symlink_to(outside/"nowhere")
    elif kind == "endless":
        path.symlink_to("/dev/zero")
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
        (path/"deep").write_text("mine", encoding="utf-8")
    elif kind == "second name":
        os.link(outside/"precious", path)
    else:  # a hole with an end as gfb writes it
        with path.open("wb") as file:
            file.truncate(SIZE - 36)
            file.seek(SIZE - 36)
            file.write(f"gfb crc32 {0:08x} {SIZE - 36:016x}\n".encode())


def check_locks(checks, hostile):
    """A lock that is none is refused with its name, or only locked."""
    for kind in ("link", "dangling link", "pipe", "folder", "second name"):
        path = hostile.anew()/lock_of("case")
        stand(kind, path, hostile.outside)
        if kind == "second name":
            (hostile.outside/"precious").rename(hostile.folder/"precious")  # its count of links is to change
            hostile.run("a lock that is a second name", status=(0,), quiet=True)
            checks.that("a lock that is a second name: the file is as it was",
                        (hostile.folder/"precious").read_text(encoding="utf-8") == "precious and mine")
            continue
        done = hostile.run(f"a lock that is a {kind}", status=(3,), kept=[path.name], quiet=True)
        checks.that(f"a lock that is a {kind}: its name is told", done and path.name in done.stderr)


def check_results(checks, hostile):
    """Whatever stands under the names of results: replaced, or refused with its name."""
    endings = ("summary", "h5", "film.vtkhdf", "used.nml", "unconverged.summary", "unconverged.h5", "restart.h5")
    for kind in ("link", "dangling link", "endless", "pipe"):
        place = hostile.anew()
        for ending in endings:
            stand(kind, place/f"case.{ending}", hostile.outside)
        hostile.run(f"results that are each a {kind}", quiet=True)
        checks.that(f"results that are each a {kind}: results instead",
                    all((place/f"case.{ending}").is_file() and not (place/f"case.{ending}").is_symlink() for ending in endings[:4]))
    for ending in endings[:5]:
        place = hostile.anew()
        stand("folder", place/f"case.{ending}", hostile.outside)
        done = hostile.run(f"case.{ending} is a folder", status=(0,) if ending.startswith("unc") else (3,), quiet=True,
                           kept=[f"case.{ending}", f"case.{ending}/deep"])
        checks.that(f"case.{ending} is a folder: its name is told", done and (done.returncode == 0 or f"case.{ending}" in done.stderr))
        left = [path.name for path in place.glob(".gfb*")]
        checks.that(f"case.{ending} is a folder: nothing of gfb's is left {left}", not left)


def check_restart_files(checks, hostile):
    """What is no restart file is refused before it is read."""
    for kind in ("link", "dangling link", "endless", "pipe", "folder", "hole"):
        place = hostile.anew()
        stand(kind, place/"sweep.restart.h5", hostile.outside)
        done = hostile.run(f"a restart file that is a {kind}", "--restart", case=hostile.sweep, quiet=True,
                           status=(0,) if kind == "dangling link" else (3,))
        checks.that(f"a restart file that is a {kind}: its name is told", done and (done.returncode == 0 or "sweep.restart.h5" in done.stderr))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        hostile = Hostile(checks, pathlib.Path(name))
        for check in (check_lists, check_finish, check_many, check_temporary_names, check_locks, check_results, check_restart_files):
            check(checks, hostile)
    checks.close()


if __name__ == "__main__":
    main()
