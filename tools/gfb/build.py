"""Programs of other revisions of gfb, for tools that compare two programs; each is built once."""

import os
import re
import shutil
import subprocess

from gfb.program import call
from gfb.tool import ROOT, stop

BUILDS = ROOT/"build/compare"  # a folder a revision


def program_of(given, name):
    """A program, or the one of a git revision, which is built first; name: how messages call what was given."""
    if os.path.isfile(given):
        return os.path.abspath(given)
    own = {**os.environ, "GIT_CEILING_DIRECTORIES": str(ROOT.parent)}  # a repository around this folder is somebody else's
    found = subprocess.run(["git", "-C", ROOT, "rev-parse", "--verify", "--quiet", given + "^{commit}"],
                           capture_output=True, text=True, check=False, env=own)
    revision = found.stdout.strip()
    if found.returncode != 0:
        stop(f"{name} {given}: neither a program nor a revision")
    source, built = (str(BUILDS/revision/part) for part in ("source", "build"))
    if not os.path.exists(f"{built}/gfb"):
        print(f"building {revision[:12]} ...", flush=True)
        shutil.rmtree(source, ignore_errors=True)  # what an interrupted call left
        os.makedirs(built, exist_ok=True)
        for command in (["git", "clone", "--quiet", "--shared", "--no-checkout", str(ROOT), source],  # it knows its commit
                        ["git", "-C", source, "checkout", "--quiet", "--detach", revision],
                        ["cmake", "-S", source, "-B", built, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                         "-DGFB_TESTS=OFF"],
                        ["cmake", "--build", built, "--target", "gfb"]):
            if subprocess.run(command, stdout=subprocess.DEVNULL, check=False, cwd=ROOT, env=own).returncode != 0:
                stop(f"{name} {given}: '{' '.join(command)}' failed", 3)
    return f"{built}/gfb"


def version_of(program):
    """What a program says of itself."""
    said = call([program, "--version"])
    if said.status != 0:
        stop(f"{program} --version ended with status {said.status}:\n{said.log}{said.complaint}", 3)
    return said.log.splitlines()[0]


def kernel_of(program):
    """The kernel of OpenBLAS that a program chooses; empty where it names none."""
    found = re.search(r", (\w+) kernel$", version_of(program))
    return found[1] if found else ""
