"""Python environments with packages from PyPI, for tests that compare gfb with a library; each is made once, in build/."""

import pathlib
import subprocess
import sys

SKIPPED = 77  # status of a test without its library
TESTS = pathlib.Path(__file__).resolve().parents[1]


def python_with(name, base="/usr/bin/python3"):
    """The Python of build/NAME, made of another, with what tests/requirements-NAME.txt pins; None where that cannot be had."""
    pins, folder = TESTS/f"requirements-{name}.txt", TESTS.parent/"build"/name
    python, done = folder/"bin/python", folder/"installed.txt"
    wanted = f"{base} {sys.version}" + pins.read_text(encoding="utf-8")
    if done.exists() and done.read_text(encoding="utf-8") == wanted:
        return python
    for command in ([base, "-m", "venv", "--clear", folder],
                    [python, "-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check", "--no-deps",
                     "--only-binary=:all:", "--require-hashes", "--requirement", pins]):
        if subprocess.run(list(map(str, command)), stdin=subprocess.DEVNULL, check=False).returncode:
            return None
    done.write_text(wanted, encoding="utf-8")
    return python
