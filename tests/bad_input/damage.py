#!/usr/bin/env python3
"""Damages a good case file at random and lets gfb check it.

    damage.py GFB_EXECUTABLE CASE.nml [COUNT=200] [SEED=1]

Whatever the damage, gfb must end with status 0 or 1 within 20 s, without a signal and without a
Fortran run-time error. The damages are the same for the same seed.
"""

import collections
import pathlib
import random
import subprocess
import sys
import tempfile

SECONDS = 20
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


def trouble(gfb, path, statuses):
    """What is wrong with gfb's answer to one file; empty where nothing is."""
    try:
        done = subprocess.run([gfb, "--check", str(path)], cwd=path.parent, timeout=SECONDS,
                              stdin=subprocess.DEVNULL, capture_output=True)
    except subprocess.TimeoutExpired:
        return f"no end after {SECONDS} s"
    statuses[done.returncode] += 1
    words = (done.stdout + done.stderr).decode("utf-8", "replace")
    if done.returncode not in (0, 1):
        return f"status {done.returncode}: {words[-1000:]}"
    for sign in ("Fortran runtime error", "Backtrace", "AddressSanitizer", "runtime error:"):
        if sign in words:
            return f"{sign}: {words[-1000:]}"
    if done.returncode == 1 and not done.stderr.strip():
        return "status 1 without a message"
    if len(words) > LONGEST_MESSAGE:
        return f"{len(words)} bytes of output"
    return ""


def main():
    if len(sys.argv) not in (3, 4, 5):
        raise SystemExit(__doc__)
    gfb = str(pathlib.Path(sys.argv[1]).resolve())
    good = pathlib.Path(sys.argv[2]).read_bytes()
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 200
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    chance = random.Random(seed)
    statuses = collections.Counter()
    failed = 0
    with tempfile.TemporaryDirectory() as name:
        path = pathlib.Path(name) / "damaged.nml"
        for number in range(1, count + 1):
            text = good
            for _ in range(chance.choice([1, 1, 1, 2, 3, 8])):
                text = damage(text, chance)
            path.write_bytes(text)
            wrong = trouble(gfb, path, statuses)
            if wrong:
                failed += 1
                kept = pathlib.Path(tempfile.gettempdir()) / f"gfb_damage_{seed}_{number}.nml"
                kept.write_bytes(text)
                print(f"FAILED damage {number}, kept as {kept}: {wrong}")
    print(f"{statuses[0]} damaged files were still right, {statuses[1]} were refused")
    print(f"{count - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
