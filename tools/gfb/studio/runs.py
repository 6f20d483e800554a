"""Runs of the program, each in a new folder of its own, and the results there are below the chosen folder."""

import asyncio
import contextlib
import os
import pathlib
import re
import shutil
import signal
import time

from gfb.run import DONE, ENVIRONMENT, NOT_CONVERGED, command_of, stem_of
from gfb.tool import stop

NAME = re.compile(r"\w[\w.-]{0,99}")
CASE, RESULT, RESTART = ".nml", ".h5", ".restart.h5"
STEP = re.compile(r".*?(\d+) of (\d+)")
LINES = 2000        # of a log that are kept
GRACE = 10.0        # s; a run that does not end on SIGTERM by then is killed
MOST_BYTES = 2**24  # of a case file; the program refuses larger ones


class Refused(ValueError):
    """What the chosen folder does not give, or the studio does not do; its text says why."""


class Folder:
    """The chosen folder; nothing outside of it is read or written."""

    def __init__(self, path):
        self.path = pathlib.Path(path).resolve()

    def inside(self, name):
        """The path of a name in the folder or below; Refused where it leads out of it, by dots or by a link."""
        try:
            path = (self.path/name).resolve()
        except (OSError, ValueError, RuntimeError) as error:
            raise Refused(f"no such name: {error}") from error
        if not path.is_relative_to(self.path):
            raise Refused("this lies outside the chosen folder")
        return path

    def cases(self):
        """Names of the case files in the folder."""
        return self.names(f"*{CASE}", lambda name: not name.endswith(f".used{CASE}"))

    def results(self):
        """Names of the results in the folder and the folders in it, the newest first; without their ending."""
        found = self.names(f"*{RESULT}") + self.names(f"*/*{RESULT}")
        found = [name for name in found if not name.endswith(RESTART)]
        return [name.removesuffix(RESULT) for name in sorted(found, key=lambda name: -age_of(self.path/name))]

    def names(self, pattern, wanted=lambda name: True):
        """Names of files that fit a pattern and lie inside."""
        found = []
        for path in sorted(self.path.glob(pattern)):
            name = str(path.relative_to(self.path))
            with contextlib.suppress(Refused):
                if wanted(name) and not path.name.startswith(".") and self.inside(name).is_file():
                    found.append(name)
        return found

    def read(self, name):
        """The text of a case file."""
        path = self.inside(name)
        if path.suffix != CASE or not path.is_file():
            raise Refused("there is no such case file in the chosen folder")
        if path.stat().st_size > MOST_BYTES:
            raise Refused(f"the case file is larger than {MOST_BYTES//2**20} MB")
        return path.read_text(encoding="utf-8", errors="replace")

    def write(self, name, text, known):
        """Writes a case file; where there is one, it must hold what is known of it: another tab, or an editor, may have changed it."""
        path = self.inside(checked(name) + CASE)
        if path.exists() and (known is None or path.read_text(encoding="utf-8", errors="replace") != known):
            raise Refused(f"{path.name} is there with other contents: open it, or choose another name")
        beside = path.with_name(f".{path.name}.{os.getpid()}")
        beside.write_text(text, encoding="utf-8")
        os.replace(beside, path)

    def new_run(self, name):
        """A folder that was not there before."""
        for number in range(1, 100_000):
            path = self.path/f"{checked(name)}.run{number}"
            with contextlib.suppress(FileExistsError):
                path.mkdir()
                return path
        raise Refused("there are too many runs of this name")


def age_of(path):
    """When a file was written [s]; 0 where it has gone."""
    try:
        return path.stat().st_mtime
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
        folder = self.folder.new_run(name)
        path = folder/(name + CASE)
        path.write_text(text, encoding="utf-8")
        # In its own folder: a .petscrc that somebody has put beside the case is not read.
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
