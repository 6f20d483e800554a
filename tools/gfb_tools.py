"""What the Python tools share: packages, the program, case files, summaries, PETSc's log, tables."""

import csv
import dataclasses
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PACKAGES = ("numpy", "h5py", "matplotlib")

# One thread a process; Open MPI as root, on few cores, without ssh. What the user has set stays.
ENVIRONMENT = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}


def stop(words, status=1):
    """Ends the tool with a message; 1: the user can mend it, 3: the machine failed."""
    print(words, file=sys.stderr)
    sys.exit(status)


def need_packages():
    """Starts the tool again with a Python that has the packages, where this one has not."""
    missing = [name for name in PACKAGES if importlib.util.find_spec(name) is None]
    if not missing:
        return
    tried = os.environ.get("GFB_TOOLS_PYTHON", "").split(":")
    for python in (str(ROOT/"build/venv/bin/python"), "/usr/bin/python3"):
        if python not in tried and os.access(python, os.X_OK):
            os.environ["GFB_TOOLS_PYTHON"] = ":".join(tried + [python])
            os.execv(python, [python, *sys.argv])
    stop(f"Python packages are missing: {', '.join(missing)}. tools/test installs them; with apt:\n"
         "  apt-get install python3-numpy python3-h5py python3-matplotlib")


def find_gfb(given=None):
    """The program: the one named, or that of the release build."""
    if given is None:
        path = ROOT/"build/release/gfb"
        if not os.access(path, os.X_OK):
            stop(f"there is no {path}: call tools/run once, or name the program with --gfb")
        return str(path)
    path = shutil.which(given)
    if path is None:
        stop(f"--gfb {given}: no such program")
    return os.path.abspath(path)


def case_text(groups):
    """A case file from {group: {key: value}}; numbers read back exactly."""
    text = ""
    for group, keys in groups.items():
        lines = "".join(f"  {key} = {namelist_value(value)}\n" for key, value in keys.items())
        text += f"&{group}\n{lines}/\n"
    return text


def namelist_value(value):
    """A Python value as a namelist writes it."""
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, (int, float)):
        return repr(value)
    return ", ".join(namelist_value(one) for one in value)


def read_summary(path):
    """{name: number or word} of a summary file."""
    values = {}
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        name, rest = line.split(" = ", 1)
        word = rest.partition(" [")[0]
        try:
            values[name] = float(word)
        except ValueError:
            values[name] = word
    return values


@dataclasses.dataclass
class Run:
    """A finished run of the program."""

    summary: dict  # of <case>.summary
    wall: float    # of the whole process, from its start to its end [s]
    cpu: float     # user and system time of the process [s]
    stem: pathlib.Path      # of the result files
    converged: bool = True


NOT_CONVERGED = 2  # status of the program


def run_case(gfb, groups, folder, name, petsc=(), may_stop=False):
    """Writes a case file and runs it on one rank; ends the tool where it does not converge, unless it may."""
    case = pathlib.Path(folder)/f"{name}.nml"
    case.write_text(case_text(groups), encoding="utf-8")
    command = [gfb, "--quiet", "--output", str(folder), str(case)]
    if petsc:
        command += ["--petsc", *petsc]
    wall, cpu, status = time_command(command, (0, NOT_CONVERGED) if may_stop else (0,))
    stem = case.with_suffix("" if status == 0 else ".unconverged")
    return Run(read_summary(f"{stem}.summary"), wall, cpu, stem, status == 0)


def time_command(command, allowed=(0,)):
    """Wall and CPU time of a command, and its status; ends the tool where that is not allowed."""
    begun = time.perf_counter()
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env={**ENVIRONMENT, **os.environ}) as process:
        said = process.stdout.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    wall = time.perf_counter() - begun
    if process.returncode not in allowed:
        stop(f"{' '.join(command)}\nended with status {process.returncode}:\n{said.decode(errors='replace')}", 3)
    return wall, used.ru_utime + used.ru_stime, process.returncode


def read_petsc_log(path):
    """{stage: {event: (calls, seconds)}} of PETSc's log (-log_view :FILE:ascii_csv); "summary": the whole stage."""
    stages = {}
    with open(path, encoding="utf-8", newline="") as log:
        for stage, event, _, calls, seconds, *_ in csv.reader(log):
            if event == "Event Name":
                continue
            events = stages.setdefault(stage, {})
            before = events.get(event, (0.0, 0.0))  # older PETSc has a line for each registration
            if float(calls) > 0.0:
                events[event] = (before[0] + float(calls), before[1] + float(seconds))
    return stages


def plain_table(title, heads, rows):
    """A table for the terminal; the first two columns are words."""
    widths = [max(len(row[i]) for row in [heads, *rows]) for i in range(len(heads))]
    text = title + "\n"
    for row in [heads, *rows]:
        cells = [cell.ljust(width) if i < 2 else cell.rjust(width)
                 for i, (cell, width) in enumerate(zip(row, widths))]
        text += "  ".join(cells).rstrip() + "\n"
    return text


def markdown_table(title, heads, rows):
    """The same for the documentation, its title left out."""
    del title
    lines = [heads, ["---"]*2 + ["---:"]*(len(heads) - 2), *rows]
    return "".join("| " + " | ".join(row) + " |\n" for row in lines)
