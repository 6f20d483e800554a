#!/usr/bin/env python3
"""Puts the table of all keys, as `gfb --keys` prints it, into README.md; with --check only compares.

The table stands between the lines `<!-- keys -->` and `<!-- end of keys -->`. Exit status: 0 the README
is as it should be, 1 it differs or has no such place.
"""

import argparse
import difflib
import os
import pathlib
import re
import subprocess
import sys

from gfb_tools import ENVIRONMENT, ROOT, find_gfb, stop

BLOCK = re.compile(r"(?<=^<!-- keys -->\n)(.*?)(?=^<!-- end of keys -->$)", re.MULTILINE | re.DOTALL)


def key_table(gfb):
    """What the program prints."""
    done = subprocess.run([gfb, "--keys"], stdin=subprocess.DEVNULL, capture_output=True, check=False,
                          env={**ENVIRONMENT, **os.environ})
    if done.returncode != 0:
        stop(f"{gfb} --keys ended with status {done.returncode}:\n{done.stderr.decode()}", 3)
    return done.stdout.decode().strip() + "\n"


def main():
    parser = argparse.ArgumentParser(prog="tools/readme_keys.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing, show what differs")
    parser.add_argument("--gfb", metavar="PROGRAM", help="the program; default: build/release/gfb")
    parser.add_argument("--readme", type=pathlib.Path, default=ROOT/"README.md", metavar="FILE",
                        help="default: README.md of this checkout")
    options = parser.parse_args()
    text = options.readme.read_text(encoding="utf-8")
    found = BLOCK.search(text)
    if found is None:
        stop(f"{options.readme}: no lines '<!-- keys -->' and '<!-- end of keys -->'")
    table = key_table(find_gfb(options.gfb))
    if table == found[0]:
        return 0
    if options.check:
        sys.stdout.writelines(difflib.unified_diff(found[0].splitlines(True), table.splitlines(True),
                                                   str(options.readme), "gfb --keys"))
        stop("the table of keys is not that of gfb --keys: call tools/readme_keys.py")
    options.readme.write_text(text[:found.start()] + table + text[found.end():], encoding="utf-8")
    print(f"{options.readme}: table of keys renewed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
