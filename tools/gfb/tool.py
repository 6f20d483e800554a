"""What every tool begins and ends with: the checkout, Python packages, a message and a status."""

import argparse
import importlib.abc
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import sys
import unittest.mock

from gfb.files import Unfit

ROOT = pathlib.Path(__file__).resolve().parents[2]
SETTINGS = pathlib.Path(__file__).resolve().with_name("plot")/"settings"  # of matplotlib
MEASURED = ROOT/"docs/measured"  # pages and pictures that tools write
PACKAGES = ("numpy", "h5py", "matplotlib")


class RunError(RuntimeError):
    """A file, the machine or the program failed, or a run was stopped; its text is the program's."""

    def __init__(self, words, status):
        super().__init__(words)
        self.status = status


def say(words):
    """A message beside the tool's own output."""
    print(words, file=sys.stderr)


def stop(words, status=1):
    """Ends the tool with a message; 1: the user can mend it, 3: the machine failed."""
    print(words, file=sys.stderr)
    sys.exit(status)


def parser_of(command, words):
    """A command's arguments and help; installed it is not tools/... but gfb-..., there too."""
    if pathlib.Path(sys.argv[0]).name.startswith("gfb-"):
        command, words = (re.sub(r"\btools/(?=(?:plot|report|design|coefficients|models|studio)\b)", "gfb-", one) for one in (command, words))
    return argparse.ArgumentParser(prog=command, description=words, formatter_class=argparse.RawDescriptionHelpFormatter)


def run(main):
    """A tool from its start to its status: what a file or the machine is to blame for ends in one sentence."""
    try:
        return main()
    except KeyboardInterrupt:
        return 130
    except ModuleNotFoundError as error:
        return stop(missing_words(error))
    except MemoryError:
        return stop("there is not enough memory", 3)
    except RunError as error:
        return stop(str(error), error.status if error.status > 0 else 3)
    except OSError as error:
        if isinstance(error, Unfit):
            return stop(str(error))
        return stop(f"{error.filename}: {error.strerror}" if error.filename else " ".join(str(error).split()), 3)


def missing_words(error):
    """What is to be done about a Python package that is not there."""
    return f"the Python package {error.name} is missing: pip install {error.name}, or apt-get install python3-{error.name}"


def without(what, error):
    """The error of a missing package in words that say what needs it, and where it is to be had."""
    return ImportError(f"{what}: {missing_words(error)}", name=error.name)


def draw_into_files():
    """Imports matplotlib with the settings in plot/settings, whatever the current folder, the home and MPLBACKEND say; stops where
    MPLBACKEND says what it cannot be imported with. It looks for its settings in the current folder first."""
    here = os.open(".", getattr(os, "O_PATH", os.O_RDONLY))
    try:
        os.chdir(SETTINGS)
        import matplotlib  # not every tool draws
    except ModuleNotFoundError as error:
        stop(missing_words(error))
    except ValueError as error:
        stop(f"MPLBACKEND={os.environ.get('MPLBACKEND', '')}: {' '.join(str(error).split())}")
    finally:
        os.fchdir(here)
        os.close(here)
    matplotlib.use("Agg")


def command_beside(name, *words):
    """A command of gfb.scripts in a Python of its own with the packages of this one. Isolated: nothing is imported from the folder
    in which it works."""
    places = [str(pathlib.Path(__file__).resolve().parents[1]), *filter(None, sys.path)]
    start = f"import sys; sys.path[:] = {places!r}; from gfb.scripts import {name}; sys.exit({name}())"
    return [sys.executable, "-I", "-c", start, *words]


class StandIns(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds what is missing as modules that hold anything: enough for what a tool says of its options."""

    def __init__(self, missing):
        self.missing = missing

    def find_spec(self, name, path=None, target=None):
        """A module of a missing package."""
        return importlib.machinery.ModuleSpec(name, self, is_package=True) if name.split(".")[0] in self.missing else None

    def create_module(self, spec):
        """One that has every name."""
        return unittest.mock.MagicMock(name=spec.name)

    def exec_module(self, module):
        """Nothing is to be done."""


def need_packages(*more):
    """Starts the tool again with a Python that has the packages, and more where they are named, where this one has not.

    --help is answered without them.
    """
    missing = [name for name in (*PACKAGES, *more) if importlib.util.find_spec(name) is None]
    if not missing:
        return
    tried = os.environ.get("GFB_TOOLS_PYTHON", "").split(":")
    for python in (str(ROOT/"build/venv/bin/python"), "/usr/bin/python3"):
        if python not in tried and os.access(python, os.X_OK):
            os.environ["GFB_TOOLS_PYTHON"] = ":".join(tried + [python])
            os.execv(python, [python, *sys.argv])
    if {"-h", "--help"} & set(sys.argv[1:]):
        sys.meta_path.append(StandIns(missing))
        return
    stop(f"Python packages are missing: {', '.join(missing)}. tools/test installs them; with apt:\n"
         "  apt-get install " + " ".join(f"python3-{name}" for name in (*PACKAGES, *more)))
