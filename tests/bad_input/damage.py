#!/usr/bin/env python3
"""Damages a good case file at random and lets gfb check it.

    damage.py GFB_EXECUTABLE CASE.nml [COUNT=200] [SEED=1]

Whatever the damage, gfb must end with status 0 or 1 within 20 s, without a signal and without a
Fortran run-time error. The damages are the same for the same seed. One call reads all damaged files,
a second one checks those that the first did not refuse; where a call is not in order, each of its
files has a call of its own.
"""

import collections
import pathlib
import random
import subprocess
import sys
import tempfile

SECONDS = 600  # a check that takes longer hangs
LONGEST_MESSAGE = 100000  # bytes
PIECES = [b"&", b"/", b"=", b",", b",,", b"'", b'"', b"(", b")", b"*", b"!", b"\n", b"\r", b"\t",
          b"\0", b"\xff", b"\xc3\xa9", b"&end", b"&mesh", b"nan", b"-Inf", b"1e999", b"1d-999",
          b"99999999999", b"0*", b"2147483647*0.0", b"(0)", b"(10001)", b"(1:2)", b"-", b".",
          b"e", b".true.", b"x" * 5000, b"9" * 5000, b"'" + b"y" * 5000 + b"'", b"\xef\xbb\xbf"]


def damage(text, chance):
    """A copy of the text with one damage."""
    if not text:
        return bytes([chance.randrange(256)])
    at = chance.randrange(len(text))
    end = min(len(text), at + chance.choice([1, 1, 2, 5, 20, 100]))
    kind = chance.randrange(9)
    if kind == 0:
        return text[:at] + text[end:]
    if kind == 1:
        return text[:at] + bytes(chance.randrange(256) for _ in range(end - at)) + text[at:]
    if kind == 2:
        return text[:at] + bytes([chance.randrange(32, 127)]) + text[at + 1:]
    if kind == 3:
        return text[:at] + text[at:end] * chance.choice([2, 3, 50]) + text[end:]
    if kind == 4:
        return text[:at]
    if kind == 5:
        lines = text.splitlines(keepends=True)
        first, second = chance.randrange(len(lines)), chance.randrange(len(lines))
        lines[first], lines[second] = lines[second], lines[first]
        return b"".join(lines)
    if kind == 6:
        start = chance.randrange(len(text))
        return text[:at] + text[start:]
    if kind == 7:
        return text[:at] + chance.choice(PIECES) + text[end:]
    return text[:at] + chance.choice(PIECES) + text[at:]


def call(gfb, paths, folder):
    """Status of a check of files, and its words; status None where it takes too long."""
    groups = ["--groups", "1"] if len(paths) > 1 else []
    try:
        done = subprocess.run([gfb, "--check", *groups, *map(str, paths)], cwd=folder,
                              timeout=SECONDS, stdin=subprocess.DEVNULL, capture_output=True)
    except subprocess.TimeoutExpired:
        return None, "", ""
    words = (stream.decode("utf-8", "replace") for stream in (done.stdout, done.stderr))
    return done.returncode, *words


def trouble(status, told, refused):
    """What is wrong with an answer of gfb's; empty where nothing is."""
    if status is None:
        return f"no end after {SECONDS} s"
    words = told + refused
    if status not in (0, 1):
        return f"status {status}: {words[-1000:]}"
    for sign in ("Fortran runtime error", "Backtrace", "AddressSanitizer", "runtime error:"):
        if sign in words:
            return f"{sign}: {words[-1000:]}"
    if status == 1 and not refused.strip():
        return "status 1 without a message"
    return ""


def refused_together(gfb, paths, folder):
    """The files that one call refuses; None where the call is not in order, or says too much."""
    status, told, words = call(gfb, paths, folder)
    if trouble(status, told, words) or len(words) > LONGEST_MESSAGE:
        return None
    lines = words.splitlines()
    refused = [path for path in paths if any(line.startswith(f"{path}:") for line in lines)]
    return None if bool(refused) != (status == 1) else refused


def right_together(gfb, paths, folder):
    """Whether one call says of each of the files that it is in order."""
    status, told, words = call(gfb, paths, folder)
    return (status == 0 and not trouble(status, told, words)
            and all(f"{path} is in order" in told for path in paths))


def check_alone(gfb, path, statuses):
    """What is wrong with gfb's answer to one file; empty where nothing is."""
    status, told, refused = call(gfb, [path], path.parent)
    statuses[status] += 1
    long = f"{len(told + refused)} bytes of output" if len(told + refused) > LONGEST_MESSAGE else ""
    return trouble(status, told, refused) or long


def check_all(gfb, paths, folder, statuses):
    """What is wrong with gfb's answers, by the number of the file."""
    refused = refused_together(gfb, paths, folder) or []
    statuses[1] += len(refused)
    right = [path for path in paths if path not in refused]
    if refused and len(right) > 1 and right_together(gfb, right, folder):
        statuses[0] += len(right)
        right = []
    wrong = {number: check_alone(gfb, path, statuses)
             for number, path in enumerate(paths, 1) if path in right}
    return {number: words for number, words in wrong.items() if words}


def main():
    if len(sys.argv) not in (3, 4, 5):
        raise SystemExit(__doc__)
    gfb = str(pathlib.Path(sys.argv[1]).resolve())
    good = pathlib.Path(sys.argv[2]).read_bytes()
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 200
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    chance = random.Random(seed)
    statuses = collections.Counter()
    with tempfile.TemporaryDirectory() as name:
        paths = [pathlib.Path(name)/f"damaged_{number}.nml" for number in range(1, count + 1)]
        for path in paths:
            text = good
            for _ in range(chance.choice([1, 1, 1, 2, 3, 8])):
                text = damage(text, chance)
            path.write_bytes(text)
        wrong = check_all(gfb, paths, name, statuses)
        for number, words in wrong.items():
            kept = pathlib.Path(tempfile.gettempdir())/f"gfb_damage_{seed}_{number}.nml"
            kept.write_bytes(paths[number - 1].read_bytes())
            print(f"FAILED damage {number}, kept as {kept}: {words}")
    failed = len(wrong)
    print(f"{statuses[0]} damaged files were still right, {statuses[1]} were refused")
    print(f"{count - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
