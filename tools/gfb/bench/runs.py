"""Runs of tools/bench scaling: processes with limits, what their logs say, and rows that outlive an interrupted run."""

import dataclasses
import functools
import hashlib
import json
import os
import pathlib
import re
import signal
import subprocess
import time

from gfb.build import kernel_of
from gfb.program import ENVIRONMENT, command_of
from gfb.results import read_json, read_summary
from gfb.running import write_case
from gfb.tool import ROOT, stop

STORE = ROOT/"build/bench/scaling.json"
POLL = 0.3  # seconds between two looks at a process
WALL_OVER_CPU = 6.0  # a process that gets less of a core than this hangs
SAME = 0.8  # of today's memory: what is free is never the same twice
PHASES = ("outside", "analysis", "factorization", "solve")  # of MUMPS, as probe.c counts them
CLOCK_TICKS = os.sysconf("SC_CLK_TCK")
PAGE = os.sysconf("SC_PAGE_SIZE")

# Events of PETSc's log that do not overlap, in the stages that solve; and stages of their own.
FACTORIZATION = ("MatLUFactorSym", "MatLUFactorNum", "MatCholFctrSym", "MatCholFctrNum")
SOLVE, EVALUATION = ("KSPSolve",), ("SNESFunctionEval", "SNESJacobianEval")
SOLVING_STAGES = ("Main Stage", "sweep")
STAGES = {"set-up": ("set-up",), "condensation": ("condensation",), "output": ("output", "recovery")}
PARTS = ("set-up", "condensation", "assembly", "factorization", "solve", "output", "rest")


@dataclasses.dataclass
class Limits:
    """What a run may take."""

    seconds: float  # CPU time of a process
    memory: float   # of all its processes [B]


@dataclasses.dataclass
class Ended:
    """How a process ended."""

    stopped: str     # why it has no result, in words; empty where it has one
    over: bool       # a limit stopped it
    cpu: float       # all processes [s]
    memory: float    # largest sum seen [B]
    said: str        # the end of what it printed


# --- processes ---

def build_probe(folder):
    """Compiles what is preloaded into the program."""
    library = pathlib.Path(folder)/"probe.so"
    source = pathlib.Path(__file__).with_name("probe.c")
    try:
        subprocess.run(["mpicc", "-O1", "-shared", "-fPIC", str(source), "-o", str(library), "-ldl"], check=True,
                       capture_output=True, text=True)
    except FileNotFoundError:
        stop("mpicc is missing", 3)
    except subprocess.CalledProcessError as error:
        stop(f"{source} does not compile:\n{error.stderr}", 3)
    return library


def run_limited(command, limits):
    """Runs a command until it ends or exceeds a limit."""
    environment = {**ENVIRONMENT, "OMPI_MCA_plm_rsh_agent": "sh", **os.environ, "OMPI_MCA_mpi_yield_when_idle": "1"}
    peak, cpu, begun = 0.0, 0.0, time.monotonic()
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env=environment, start_new_session=True) as process:
        os.set_blocking(process.stdout.fileno(), False)
        said, why = b"", ""
        while running(process):
            said = (said + (process.stdout.read() or b""))[-20000:]
            family = descendants(process.pid)
            usage = [use for use in map(usage_of, family) if use]
            peak = max(peak, sum(use[1] for use in usage))
            cpu = max(cpu, sum(use[0] for use in usage))
            if peak > limits.memory:
                why = f"more than {limits.memory/2**30:.1f} GiB"
            elif max((use[0] for use in usage), default=0.0) > limits.seconds:
                why = f"more than {limits.seconds:.0f} s of CPU time"
            elif time.monotonic() - begun > WALL_OVER_CPU*max(limits.seconds, 60.0):
                why = f"no end after {time.monotonic() - begun:.0f} s: it hangs, or the machine is too busy"
            if why:
                end_all(family)
                break
        process.wait()
        said = (said + (process.stdout.read() or b""))[-20000:]
        status = process.returncode
    words = said.decode(errors="replace")
    if why:
        return Ended(why, True, cpu, peak, words)
    return Ended("" if status == 0 else f"status {status}: {last_words(words)}", False, cpu, peak, words)


def running(process):
    """Waits a moment; whether the process goes on. It ends where the tool is interrupted."""
    try:
        time.sleep(POLL)
        return process.poll() is None
    except BaseException:
        end_all(descendants(process.pid))
        raise


def last_words(said):
    """The last line that says something."""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    telling = [line for line in lines if re.search(r"not|no |error|memory|fail", line, re.IGNORECASE)]
    return (telling or lines or ["nothing was said"])[-1][:160]


def descendants(root):
    """A process and all those that it started."""
    parent = {}
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            parent[int(entry)] = int(pathlib.Path(f"/proc/{entry}/stat").read_text().rsplit(")", 1)[1].split()[1])
        except (OSError, IndexError, ValueError):
            continue
    found, new = [], [root]
    while new:
        found += new
        new = [one for one, above in parent.items() if above in new]
    return found


def usage_of(process):
    """CPU time [s] and memory [B] of a process; None where it has ended."""
    try:
        fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12]))/CLOCK_TICKS, int(fields[21])*PAGE
    except (OSError, IndexError, ValueError):
        return None


def end_all(processes):
    """Ends processes of ours."""
    for process in reversed(processes):
        try:
            os.kill(process, signal.SIGKILL)
        except ProcessLookupError:
            continue


# --- rows that outlive an interrupted run ---

def kept_rows(store, program):
    """{key: row} of an earlier run of the tool with the same program."""
    if not store.exists():
        return {}
    kept, rows = read_json(store, "program", "rows")
    if kept == program:
        return rows
    print("kept rows are of another build of gfb: measuring anew", flush=True)
    return {}


def keep_rows(store, program, rows):
    """Writes all rows; what was kept before stays whole until then."""
    store.parent.mkdir(parents=True, exist_ok=True)
    new = store.with_suffix(".new")
    new.write_text(json.dumps({"program": program, "rows": rows}, indent=1), encoding="utf-8")
    os.replace(new, store)


# --- one measured run ---

class Bench:
    """Where runs are made, and what has been measured."""

    def __init__(self, options, folder, gfb=None):
        """With a program of its own it solves cases only, and keeps no rows."""
        self.gfb, self.folder = gfb or options.gfb, pathlib.Path(folder)
        self.limits = Limits(options.seconds, options.memory)
        self.strip_program = pathlib.Path(self.gfb).with_name("gfb_bench_varied_strip")
        self.probe = build_probe(folder)
        self.rows, self.measures = {}, True
        if gfb:
            return
        if not os.access(self.strip_program, os.X_OK):
            stop(f"there is no {self.strip_program}: it is built together with gfb")
        self.program = hashlib.sha256(pathlib.Path(self.gfb).read_bytes()
                                      + self.strip_program.read_bytes()).hexdigest()[:16]
        if options.reuse:
            self.rows = kept_rows(STORE, self.program)

    def row(self, key, measure):
        """A kept row, or a new one; what was stopped by smaller limits than today's, or failed, is tried again."""
        row = self.rows.get(key)
        if not self.measures:
            return row or {"stopped": "not measured", "over": False}
        if row is None or (row["stopped"] and not self.would_stop(row)):
            print(f"{key} ...", flush=True)
            row = measure()
            row["limits"] = dataclasses.asdict(self.limits)
            self.rows[key] = row
            keep_rows(STORE, self.program, self.rows)
            print("  " + (row["stopped"] or f"{row['cpu']:.1f} s CPU, {row['memory']/2**20:.0f} MiB"), flush=True)
        return row

    def would_stop(self, row):
        """Whether today's limits would stop a row, too."""
        old = row["limits"]
        return row["over"] and old["seconds"] >= self.limits.seconds and old["memory"] >= SAME*self.limits.memory

    def run_case(self, groups, ranks=1):
        """Solves a case; what it cost, or why not."""
        case = write_case(self.folder, "case", groups)
        row = self.run(command_of(self.gfb, case, self.folder, options=("--quiet",)) + ["--petsc"], ranks)
        if not row["stopped"]:
            row["summary"] = read_summary(self.folder/"case.summary")[0]
            row["memory"] = row["summary"]["peak_memory"]
        return row

    def run_strip(self, sizes, ranks):
        """The condensed strip of unequal bumps; sizes: of arc, flat, width, bumps."""
        row = self.run([str(self.strip_program), *map(str, sizes)], ranks)
        if not row["stopped"]:
            lines = [line.split(",") for line in row["said"].splitlines() if line.count(",") == 1]
            row["summary"] = {name: float(value) for name, value in lines}
            row["memory"] = row["summary"]["peak_memory"]
        return row

    @functools.cached_property
    def kernel(self):
        """The kernel that the program chooses, for its runs: a start anew for it would lose the probe."""
        return kernel_of(self.gfb)

    def run(self, command, ranks):
        """A command with the probe in it, and PETSc's log."""
        counts = self.folder/"counts"
        for old in [*self.folder.glob("counts.*"), *self.folder.glob("case.*.summary"), self.folder/"case.summary"]:
            old.unlink(missing_ok=True)
        kernel = [f"OPENBLAS_CORETYPE={self.kernel}"] if self.kernel else []
        whole = ["env", *kernel, f"LD_PRELOAD={self.probe}", f"GFB_PROBE_FILE={counts}", *command,
                 "-log_view", "::ascii_info_detail"]
        if ranks > 1:
            whole = ["mpiexec", "-n", str(ranks), *whole]
        ended = run_limited(whole, self.limits)
        row = {"stopped": ended.stopped, "over": ended.over, "ranks": ranks, "cpu": ended.cpu, "memory": ended.memory}
        if not ended.stopped:
            logs = [read_log(f"{counts}.log.{rank}") for rank in range(ranks)]
            parts = [parts_of(log) for log in logs]
            row |= {"said": ended.said if command[0] == str(self.strip_program) else "",
                    "cpu": max(sum(one.values()) for one in parts), "parts": parts,
                    "messages": [messages_of(log) for log in logs],
                    "mumps": [read_counts(f"{counts}.{rank}") for rank in range(ranks)]}
        return row


# --- logs ---

LINE = re.compile(r'^Stages\["([^"]+)"\]\["([^"]+)"\]\[0\] = \{(.*)\}')


def read_log(path):
    """{(stage, event): {name: number}} of a rank's log in detail; "summary": the whole stage."""
    stages = {}
    with open(path, encoding="utf-8") as log:
        for line in log:
            found = LINE.match(line)
            if not found or '"count" : 0,' in line:
                continue
            stage, event, fields = found.groups()
            numbers = stages.setdefault((stage, event), {})
            for field in fields.split(","):
                name, _, value = field.partition(":")
                name = name.strip().strip('"')
                try:
                    numbers[name] = numbers.get(name, 0.0) + float(value)  # a name registered twice has two lines
                except ValueError:
                    continue
    return stages


def number_in(stages, of_stages, events, name):
    """Sum of a number of some events in some stages."""
    return sum(stages[stage, event].get(name, 0.0) for stage in of_stages for event in events
               if (stage, event) in stages)


def parts_of(stages):
    """CPU time of a rank in parts that do not overlap [s]."""
    parts = {name: number_in(stages, of, ("summary",), "time") for name, of in STAGES.items()}
    solving = {name: number_in(stages, SOLVING_STAGES, events, "time") for name, events in
               (("assembly", EVALUATION), ("factorization", FACTORIZATION), ("solve", SOLVE))}
    rest = number_in(stages, SOLVING_STAGES, ("summary",), "time") - sum(solving.values())
    solving["assembly"] += number_in(stages, ("stiffness",), ("summary",), "time")
    parts |= solving | {"rest": rest}
    return {name: parts[name] for name in PARTS}


def messages_of(stages):
    """What PETSc sends on a rank while it solves; it counts what is sent and what is received."""
    return {"messages": 0.5*number_in(stages, SOLVING_STAGES, ("summary",), "numMessages"),
            "bytes": 0.5*number_in(stages, SOLVING_STAGES, ("summary",), "messageLength"),
            "collectives": number_in(stages, SOLVING_STAGES, ("summary",), "numReductions")}


def read_counts(path):
    """{phase: {name: count}} of the probe."""
    names = ("calls", "messages", "bytes", "collectives")
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    return {phase: dict(zip(names, map(int, line.split()))) for phase, line in zip(PHASES, lines)}


def part(row, name):
    """Largest CPU time of a part over the ranks [s]."""
    return max(of_rank[name] for of_rank in row["parts"])
