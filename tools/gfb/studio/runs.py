"""Runs of the program, each in a new folder of its own, and the results there are below the chosen folder."""

import asyncio
import contextlib
import itertools
import os
import pathlib
import re
import shutil
import signal
import threading
import time

from gfb.bearing_files import NAME as OF_BEARING
from gfb.bearing_files import names_of, renamed
from gfb.files import Unfit, kept_within, read_text, write_inside
from gfb.program import DONE, ENVIRONMENT, NOT_CONVERGED, command_of, stem_of
from gfb.tool import stop

NAME = re.compile(r"\w[\w.-]{0,99}")
CASE, RESULT, RESTART = ".nml", ".h5", ".restart.h5"
STEP = re.compile(r".*?(\d+) of (\d+)")
LINES = 2000        # of a log that are kept
GRACE = 10.0        # s; a run that does not end on SIGTERM by then is killed
MOST_NAMES = 10_000  # of a folder that are looked at
MOST_RUNS = 100_000  # of one name


class Refused(ValueError):
    """What the chosen folder does not give, or the studio does not do; its text says why."""


class Folder:
    """The chosen folder; nothing outside of it is read or written, and no link in it is followed."""

    def __init__(self, path):
        self.path = pathlib.Path(path).resolve()
        self.writing = threading.Lock()  # two tabs do not write at a time

    def inside(self, name):
        """The path of a name in the folder or below; Refused where it leads out of it. Whether there are links is seen where it is opened."""
        path = self.path/name
        if "\0" in name or ".." in path.parts or not path.is_relative_to(self.path):
            raise Refused("this lies outside the chosen folder")
        return path

    def cases(self):
        """Names of the case files in the folder."""
        return sorted(one.name for one in files_of(self.path) if one.name.endswith(CASE) and not one.name.endswith(f".used{CASE}"))

    def results(self):
        """Names of the results in the folder and the folders in it, the newest first; without their ending."""
        found = []
        for place in (self.path, *folders_of(self.path)):
            found += [(-age_of(one.path), str(pathlib.Path(one.path).relative_to(self.path)).removesuffix(RESULT))
                      for one in files_of(place) if one.name.endswith(RESULT) and not one.name.endswith(RESTART)]
        return [name for _, name in sorted(found)]

    def read(self, name):
        """The text of a case file."""
        path = self.inside(name)
        if path.suffix != CASE:
            raise Refused("there is no such case file in the chosen folder")
        try:
            with kept_within(self.path):
                return read_text(path, errors="replace")
        except Unfit as error:
            raise Refused(str(error)) from error
        except (FileNotFoundError, NotADirectoryError, ValueError) as error:
            raise Refused("there is no such case file in the chosen folder") from error
        except OSError as error:
            raise Refused(f"no such name: {error}") from error

    def write(self, name, text, known):
        """Writes a case file; where there is one, it must hold what is known of it: another tab, or an editor, may have changed it."""
        path = self.inside(checked(name) + CASE)
        other = Refused(f"{path.name} is there with other contents: open it, or choose another name")
        with self.writing:
            is_there = os.path.lexists(path)
            if is_there and (known is None or self.read(path.name) != known):
                raise other
            try:
                write_inside(self.path, path.name, text, replaces=is_there)
            except FileExistsError:
                raise other from None

    def bearings_of(self, text):
        """{name as typed: text} of the files of bearings that a case names; Refused where they lead out of the folder."""
        found = {}
        for name in names_of(text):
            try:
                found[name] = self.read(name)
            except Refused as error:
                raise Refused(f"{name}: {error}") from error
        return found

    def whole(self, text):
        """A case as the program finds the files of its bearings from any other folder; Refused where they lead out of this one,
        or are not there."""
        self.bearings_of(text)
        return renamed(text, [str(self.inside(name)) for name in names_of(text)])

    def new_run(self, name, text):
        """A folder that was not there before, with a case file in it, and those of its bearings; its path."""
        bearings = self.bearings_of(text)
        new = {old: OF_BEARING.format(stem=checked(name), number=number) for number, old in enumerate(bearings, 1)}
        text = renamed(text, [new[old] for old in names_of(text)])
        for number in range(1, MOST_RUNS):
            path = self.path/f"{checked(name)}.run{number}"
            with contextlib.suppress(FileExistsError):
                path.mkdir()
                write_inside(path, name + CASE, text, replaces=False)
                for old, content in bearings.items():
                    write_inside(path, new[old], content, replaces=False)
                return path
        raise Refused("there are too many runs of this name")


def files_of(folder):
    """Regular files of a folder, no links and none that are hidden; of very many some."""
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        return [one for one in itertools.islice(entries, MOST_NAMES) if one.is_file(follow_symlinks=False) and not one.name.startswith(".")]
    return []


def folders_of(folder):
    """The same of folders."""
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        return [one.path for one in itertools.islice(entries, MOST_NAMES) if one.is_dir(follow_symlinks=False) and not one.name.startswith(".")]
    return []


def age_of(path):
    """When a file was written [s]; 0 where it has gone."""
    try:
        return os.stat(path, follow_symlinks=False).st_mtime
    except OSError:
        return 0.0


def checked(name):
    """A name that can be one of a case; Refused otherwise."""
    if not NAME.fullmatch(name or ""):
        raise Refused("a name has letters, digits, '_', '-' and '.', and begins with a letter or digit")
    return name


class Run:
    """One call of the program, while it runs and afterwards."""

    def __init__(self, name, folder, process):
        self.name, self.folder, self.process = name, folder, process
        self.lines, self.begun, self.ended, self.stopped = [], time.monotonic(), None, False
        self.left_out = 0  # lines

    @property
    def status(self):
        """Of the program; None while it runs."""
        return self.process.returncode if self.ended else None

    @property
    def seconds(self):
        """How long it runs, or ran."""
        return (self.ended or time.monotonic()) - self.begun

    @property
    def part(self):
        """How much of its points is begun, from 0 to 1; None where it has named none."""
        for line in reversed(self.lines):
            found = STEP.fullmatch(line.partition(":")[0].strip())
            if found and 0 < int(found[1]) <= int(found[2]):
                return (int(found[1]) - 1)/int(found[2])
        return None

    @property
    def stem(self):
        """Of the result files; None where there is no answer."""
        if self.status not in (DONE, NOT_CONVERGED):
            return None
        stem = stem_of(self.name + CASE, self.folder, status=self.status)
        return stem if stem.with_name(stem.name + RESULT).exists() else None

    @property
    def words(self):
        """How it stands, in words."""
        if self.status is None:
            return "is being stopped" if self.stopped else "runs"
        said = {DONE: "has an answer", NOT_CONVERGED: "did not converge"}.get(self.status)
        return said or ("was stopped" if self.stopped else f"ended with status {self.status}")


class Runs:
    """All runs of one server."""

    def __init__(self, folder, gfb):
        self.folder, self.gfb, self.all = folder, gfb, []
        self.most = os.cpu_count() or 1
        self.tasks = set()
        # With the server, however it ends, the run ends, too: the kernel sees to that (prctl, PR_SET_PDEATHSIG).
        setpriv = shutil.which("setpriv") or stop("setpriv is missing, with which runs end with the server: install util-linux")
        self.bound = (setpriv, "--pdeathsig", "KILL", "--")

    async def start(self, name, text):
        """Begins a run of a text."""
        if sum(run.ended is None for run in self.all) >= self.most:
            raise Refused(f"{self.most} runs at a time are as many as this machine has cores: wait, or stop one")
        folder = await asyncio.to_thread(self.folder.new_run, name, text)
        path = folder/(name + CASE)
        process = await asyncio.create_subprocess_exec(
            *self.bound, *map(str, command_of(self.gfb, path, folder)), stdin=asyncio.subprocess.DEVNULL, stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.STDOUT, cwd=folder, env={**ENVIRONMENT, **os.environ}, start_new_session=True)
        run = Run(name, folder, process)
        self.all.append(run)
        self.keep(self.follow(run))
        return run

    def keep(self, work):
        """Lets something go on beside; the loop itself would forget it."""
        task = asyncio.get_running_loop().create_task(work)
        self.tasks.add(task)
        task.add_done_callback(self.tasks.discard)

    async def follow(self, run):
        """Reads what a run says, to its end."""
        while line := await read_line(run.process.stdout):
            run.lines.append(line.decode("utf-8", "replace").rstrip("\n"))
            if len(run.lines) > LINES:
                del run.lines[0]
                run.left_out += 1
        await run.process.wait()
        run.ended = time.monotonic()

    def end(self, run):
        """Stops a run: as by a signal, and the hard way where it does not listen."""
        if run.ended is None and not run.stopped:
            run.stopped = True
            self.keep(self.end_surely(run))

    async def end_surely(self, run):
        """Signals to all processes of a run."""
        for number in (signal.SIGTERM, signal.SIGKILL):
            with contextlib.suppress(ProcessLookupError):
                os.killpg(run.process.pid, number)
            with contextlib.suppress(asyncio.TimeoutError):
                return await asyncio.wait_for(run.process.wait(), GRACE)


async def read_line(stream):
    """The next line, or what there is of one that is too long; empty at the end."""
    try:
        return await stream.readline()
    except ValueError:
        return b"...\n"
