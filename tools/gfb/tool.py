"""What every tool begins and ends with: the checkout, Python packages, a message and a status."""

import importlib.util
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MEASURED = ROOT/"docs/measured"  # pages and pictures that tools write
PACKAGES = ("numpy", "h5py", "matplotlib")


def say(words):
    """A message beside the tool's own output."""
    print(words, file=sys.stderr)


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
