#!/usr/bin/env python3
"""Runs gfb on case files with mistakes and looks for the messages they expect.

    check_bad_input.py GFB_EXECUTABLE

Each `*.nml` beside this script begins with comment lines `! expect: <part of the message>`, and may have a line
`! messages: <their number>`, and `! options: ...` for the command line. gfb must refuse each with
status 1, say all of them on the error stream, and write no result. One call reads all files of the
same options, as a start takes longer than a file; a file of which that call says nothing, or not
what it should, is given to a call of its own. So are mistakes that are no text files (a missing
file, a folder, ...), which are made in a temporary folder.
"""

import collections
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
LONGEST_MESSAGE = 20000  # bytes of one file; nobody reads more
SECONDS = 900

GOOD = """&bearing radius = 0.02, length = 0.04, clearance = 3.0e-5 /
&gas viscosity = 1.95e-5, ambient_pressure = 101325.0 /
&operation speed_rpm = 30000.0, load = -50.0, 0.0 /
&model foil = 'rigid' /
&mesh circumferential_elements = 24, axial_elements = 4 /
"""


def run(gfb, arguments, folder):
    """Status, output and error stream of gfb."""
    done = subprocess.run([gfb, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                          capture_output=True, timeout=SECONDS)
    return (done.returncode, done.stdout.decode("utf-8", "replace"),
            done.stderr.decode("utf-8", "replace"))


def mistaken(words, expected, messages):
    """What is wrong with what gfb says of one file, a line each."""
    wrong = [f"not said: {part}" for part in expected if part not in words]
    if messages and messages[0] != len(words.splitlines()):
        wrong.append(f"{len(words.splitlines())} messages, not {messages[0]}")
    if "Fortran runtime" in words or "Backtrace" in words:
        wrong.append("a crash")
    if len(words) > LONGEST_MESSAGE:
        wrong.append(f"{len(words)} bytes of message")
    return wrong


def complaints(gfb, arguments, expected, folder, status=1, messages=()):
    """What is wrong with gfb's answer, one a line; empty where all is as expected."""
    before = sorted(folder.iterdir())
    try:
        found, _, words = run(gfb, arguments, folder)
    except subprocess.TimeoutExpired:
        return [f"no end after {SECONDS} s"]
    wrong = [f"status {found}, not {status}"] if found != status else []
    wrong += mistaken(words, expected, messages)
    if status and not words.strip():
        wrong.append("nothing on the error stream")
    new = [str(path.name) for path in sorted(folder.iterdir()) if path not in before]
    if new:
        wrong.append("left behind: " + ", ".join(new))
    if wrong and words:
        wrong.append("said: " + words.strip()[:2000])
    return wrong


def said_together(gfb, options, paths, folder):
    """What one call says of each of several files.

    Nothing where it ends with another status than 1, or leaves something behind.
    """
    before = sorted(folder.iterdir())
    arguments = ["--check", "--groups", "1", *options, *map(str, paths)]
    try:
        status, _, words = run(gfb, arguments, folder)
    except subprocess.TimeoutExpired:
        return {}
    if status != 1 or sorted(folder.iterdir()) != before:
        return {}
    said = collections.defaultdict(str)
    names = {str(path) for path in paths}
    path = ""
    for line in words.splitlines(keepends=True):
        # A line that begins with no name goes on with the message before it.
        begins = (line[:i] for i, letter in enumerate(line) if letter == ":")
        path = next((name for name in begins if name in names), path)
        said[path] += line
    return said


def files_with_mistakes():
    """Options, path, expected parts and number of messages of the case files beside this script."""
    for path in sorted(HERE.glob("*.nml")):
        lines = path.read_text(encoding="utf-8").splitlines()
        expected = [line[len("! expect: "):] for line in lines if line.startswith("! expect: ")]
        if not expected:
            raise SystemExit(f"{path}: no line '! expect: ...'")
        options = tuple(word for line in lines if line.startswith("! options: ")
                        for word in line.split()[2:])
        number = [int(line.split()[2]) for line in lines if line.startswith("! messages: ")]
        yield options, path, expected, number


def check_files(gfb, folder):
    """What is wrong with gfb's answers to the files beside this script, by their names.

    And how many of them a call with others refused as it should.
    """
    wrong, together, tests = {}, 0, list(files_with_mistakes())
    for options in sorted({options for options, *_ in tests}):
        alike = [test for test in tests if test[0] == options]
        said = said_together(gfb, options, [path for _, path, *_ in alike], folder)
        for _, path, expected, number in alike:
            if str(path) in said and not mistaken(said[str(path)], expected, number):
                together += 1
                wrong[path.stem] = []
            else:
                wrong[path.stem] = complaints(gfb, ["--check", *options, str(path)], expected,
                                              folder, messages=number)
    return wrong, together


def places_with_mistakes(folder):
    """Name, arguments and expected parts of what is no case file at all."""
    (folder / "good.nml").write_text(GOOD)
    (folder / "folder.nml").mkdir()
    (folder / "empty.nml").write_bytes(b"")
    (folder / "binary.nml").write_bytes(b"&scene\n" + bytes(range(256)))
    (folder / "program.nml").write_bytes(pathlib.Path(sys.executable).read_bytes()[:100000])
    (folder / "large.nml").write_bytes(b"! a comment of 40 bytes, again and again\n" * 250000)
    (folder / "long_line.nml").write_bytes(b"&scene title = " + b"x" * 900000)
    (folder / "garbage.nml").write_bytes(b"a=1,(2)'b'/&c d=*=\xff " * 45000)
    for form in ("utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-32-be"):
        (folder / f"{form}.nml").write_text(GOOD, encoding=form)
    (folder / "ctrl_z.nml").write_text(GOOD.replace("&gas", "\x1a&gas"))
    (folder / "only_ctrl_z.nml").write_text("\x1a\r\n")
    (folder / "in_the_way").write_text("a file")
    yield "missing file", ["--check", "nowhere.nml"], ["nowhere.nml: the case file does not exist"]
    yield "missing folder", ["--check", "nowhere/case.nml"], ["does not exist"]
    yield "a file as folder", ["--check", "in_the_way/case.nml"], ["does not exist"]
    yield "empty name", ["--check", ""], []
    yield "odd name", ["--check", "\t'\"* \\ \n&.nml"], ["does not exist"]
    yield "long name", ["--check", "x" * 5000], ["does not exist"]
    yield "a folder", ["--check", "folder.nml"], ["folder.nml: is a folder"]
    yield "the root folder", ["--check", "/"], ["is a folder"]
    yield "a device", ["--check", "/dev/zero"], ["is a pipe, a terminal or another device"]
    yield "empty file", ["--check", "empty.nml"], ["empty.nml: the case file is empty"]
    yield "binary file", ["--check", "binary.nml"], ["binary.nml: is binary", "line 2"]
    for form in ("utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-32-be"):
        yield form, ["--check", f"{form}.nml"], [f"{form}.nml: is UTF-16 or UTF-32", "save it as UTF-8"]
    yield "Ctrl-Z inside", ["--check", "ctrl_z.nml"], ["ctrl_z.nml: is binary", "line 2", "control character 26"]
    yield "Ctrl-Z alone", ["--check", "only_ctrl_z.nml"], ["only_ctrl_z.nml: the case file is empty"]
    yield "a program", ["--check", "program.nml"], ["program.nml: is binary"]
    yield "10 MB", ["--check", "large.nml"], ["has 10.25 MB, more than the limit of 1 MB"]
    yield "long line", ["--check", "long_line.nml"], ["x" * 60 + "..."]
    yield "garbage", ["--check", "garbage.nml"], [" more"]


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    gfb = str(pathlib.Path(sys.argv[1]).resolve())
    passed = failed = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        tests = list(places_with_mistakes(folder))
        # A program that refuses everything would pass all the rest.
        wrong = {"the good case": complaints(gfb, ["--check", "good.nml"], [], folder, status=0)}
        for place in ("in_the_way/results", "in_the_way", "/proc/results"):  # the scene is right, the folder is not
            wrong[f"output {place}"] = complaints(gfb, ["--output", place, "good.nml"], [f"{place}: results cannot be"],
                                                  folder, status=3)
        for test, arguments, expected in tests:
            wrong[test] = complaints(gfb, arguments, expected, folder)
        files, together = check_files(gfb, folder)
        wrong |= files
    for test, lines in wrong.items():
        if lines:
            failed += 1
            print(f"FAILED {test}")
            print("".join(f"    {line}\n" for line in lines), end="")
        else:
            passed += 1
    print(f"{passed} passed, {failed} failed; {together} files were refused by a call with others")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
