#!/usr/bin/env python3
"""Small scenes of every analysis and every model end as they should, without a word of a sanitizer. With --few one of each."""

import pathlib
import sys
import tempfile

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1]/name) for name in ("verification", "floating_point")]

from gfb_run import GFB, Checks  # noqa: E402 (found only now)
from gfb.running import run_file, write_case  # noqa: E402 (gfb_run has made it known)
from scenes import SCENES  # noqa: E402

FEW = ("rigid, under a load", "rigid, film order 2", "springs, sweep of speed", "springs, film and foil in turns", "beams, 100 N",
       "strip between plates, loop", "modes of an arc", "springs, load capacity", "beams, two pads, small vibrations",
       "beams with their mass, rotor over time", "springs, forced orbits", "beams, sample", "springs, sensitivities",
       "thrust bearing, plates under a moment")
SECONDS = 400
WRONG = ("AddressSanitizer", "runtime error:", "ERROR: ")


def check_scene(checks, scene, folder):
    """A scene, and once more from where it ended where it can be resumed."""
    case = write_case(folder, scene.name, scene.case)
    for options in ((), ("--restart",))[:1 + scene.restart]:
        answer = run_file(GFB, case, folder, options=(*scene.options, *options), seconds=SECONDS)
        found = [line for line in (answer.log + answer.complaint).splitlines() if any(word in line for word in WRONG)]
        checks.that(f"{scene.words} {' '.join(options)}: status {answer.status} {' '.join(found)[:300]}",
                    answer.status == scene.status and not found)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            if "--few" not in sys.argv or scene.words in FEW:
                check_scene(checks, scene, pathlib.Path(folder))
    checks.close()


if __name__ == "__main__":
    main()
