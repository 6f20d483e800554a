#!/usr/bin/env python3
"""Floating-point discipline: one answer from every build and number of ranks, no trap, nothing wrong under valgrind.

  floating_point.py --debug GFB --release GFB --native GFB --results FOLDER [--only PART] [--docs FILE] [WORD ...]

Builds: -O0 with traps, the release one, -O3 -march=native. tools/check_floating_point makes them and calls this.
Parts: builds (all scenes by all builds), valgrind (some of them), hard (tests/hard by the build with traps).
Words choose scenes whose names have one of them in them.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

from builds import BASE, FILLED, compare_scene, words_of
from memory import look_at
from page import page_text
from scenes import SCENES

BUILDS = ("debug", "release", "native")
HARD = pathlib.Path(__file__).resolve().parent.parent/"hard"/"hard_scenes.py"


def show(outcome, words, wrong, details=()):
    """A scene and what failed."""
    print(f"{outcome}  {words}")
    for line in (*details, *wrong):
        print("        " + line.replace("\n", "\n        "))
    sys.stdout.flush()


def compare_builds(chosen, builds):
    """All scenes by all builds; what the page needs of them."""
    kept = []
    for scene in chosen:
        row = compare_scene(scene, builds)
        show("FAILED" if row.wrong else "ok    ", f"{scene.words} (tolerance {row.tolerance:.0e}, {row.seconds:.0f} s)",
             row.wrong, [f"{words_of(way):32} {largest:.1e}  {name}" for way, (largest, name) in row.found.items()])
        kept.append({"words": scene.words, "tolerance": row.tolerance, "wrong": len(row.wrong),
                     "found": [[*way, largest, name] for way, (largest, name) in row.found.items()]})
    return kept


def look_into_memory(chosen, builds):
    """Some scenes under valgrind."""
    kept = []
    for scene in chosen:
        if not scene.memory:
            continue
        look = look_at(scene, builds[BASE[0]])
        show("FAILED" if look.wrong else "ok    ", f"valgrind: {scene.words}: {len(look.errors)} errors, {len(look.lost)} losses "
             f"of gfb's, {look.others} of libraries' ({look.seconds:.0f} s)", look.wrong)
        kept.append({"words": scene.words, "errors": len(look.errors), "lost": len(look.lost), "others": look.others,
                     "wrong": len(look.wrong)})
    return kept


def play_hard(words, builds):
    """The hard scenes, all or those of these words, by the build with traps; the last line that they print."""
    environment = {**os.environ, **FILLED, "GFB": builds["debug"]}
    with subprocess.Popen([sys.executable, str(HARD), *words], env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, encoding="utf-8") as process:
        last = ""
        for line in process.stdout:
            print(line, end="", flush=True)
            last = line.strip()
    return [{"words": last.rsplit(",", 1)[0], "wrong": int(process.returncode != 0)}]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", metavar="WORD", nargs="*", help="parts of the names of scenes")
    for build in BUILDS:
        parser.add_argument(f"--{build}", metavar="GFB", required=True, help=f"the {build} build's program")
    parser.add_argument("--results", metavar="FOLDER", type=pathlib.Path, required=True,
                        help="keeps what was found, a file a part, for --docs")
    parser.add_argument("--only", choices=("builds", "valgrind", "hard"), help="leave the other parts out")
    parser.add_argument("--docs", metavar="FILE", type=pathlib.Path, help="page of what was found by this and earlier "
                        "calls, where nothing failed")
    options = parser.parse_args()
    if options.docs and options.words:
        parser.error("--docs: a page holds all scenes")
    builds = {build: getattr(options, build) for build in BUILDS}
    chosen = [scene for scene in SCENES if not options.words or any(word in scene.words for word in options.words)]
    parts = {"builds": lambda: compare_builds(chosen, builds), "valgrind": lambda: look_into_memory(chosen, builds),
             "hard": lambda: play_hard(options.words, builds)}
    options.results.mkdir(parents=True, exist_ok=True)
    scenes = failed = 0
    for part, play in parts.items():
        if options.only not in (None, part) or options.words and not options.only and part == "hard":
            continue
        kept = play()
        scenes += len(kept)
        failed += sum(one["wrong"] > 0 for one in kept)
        if not options.words:
            (options.results/f"{part}.json").write_text(json.dumps(kept, indent=1), encoding="utf-8")
    print(f"{scenes} checks, {failed} failed")
    if options.docs:
        found = {part: json.loads((options.results/f"{part}.json").read_text(encoding="utf-8")) for part in parts}
        if any(one["wrong"] for kept in found.values() for one in kept):
            sys.exit("no page is written: something failed in this or an earlier call")
        options.docs.write_text(page_text(found), encoding="utf-8")
    sys.exit(1 if failed or not scenes else 0)


if __name__ == "__main__":
    main()
