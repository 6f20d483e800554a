"""Speed against error: five scenes, every model that applies, coarse to fine, and a page that says what to use when.

A rigid film, a strip, a loop of a strip, a bearing aligned and tilted. Errors are those of what an engineer reads
against a reference finer than all that is compared, whose own uncertainty follows from its two coarser neighbours (the
rule of docs/manual/accuracy.md). Times are CPU times of whole processes, the smallest of a few runs. Each run is kept in
build/bench/work-precision.json, so that an interrupted command goes on with --reuse.
"""

import hashlib
import pathlib
import tempfile

from gfb.bench.options import add_repetitions
from gfb.bench.runs import keep_rows, kept_rows
from gfb.bench.work_precision import page as bench_work_precision_page
from gfb.bench.work_precision.bearings import bearing_scene, tilted_scene
from gfb.bench.work_precision.scenes import film_scene, key_of, loop_scene, strip_scene
from gfb.running import run_case
from gfb.tool import MEASURED, ROOT, stop

STORE = ROOT/"build/bench/work-precision.json"
SHORT = 3.0  # seconds; longer runs are not repeated
SCENES = {"film": film_scene, "strip": strip_scene, "loop": loop_scene, "bearing": bearing_scene,
          "tilted": tilted_scene}


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--quick", action="store_true", help="small meshes, two minutes; says little")
    parser.add_argument("--scenes", metavar="LIST", default=",".join(SCENES),
                        help="what to measure, of %(default)s; the page shows others as kept, with --reuse")
    add_repetitions(parser, f"runs of what takes less than {SHORT:g} s, the fastest counts", 3)
    parser.add_argument("--reuse", action="store_true", help="go on with the runs of an earlier call")
    parser.add_argument("--docs", action="store_true", help="write the page and its pictures to docs/measured")


def run(options):
    """Measures; returns the tables and leaves page and pictures."""
    asked = options.scenes.split(",")
    if not set(asked) <= set(SCENES):
        stop(f"--scenes {options.scenes}: {', '.join(SCENES)}")
    store = Store(options.gfb, options.reuse)
    made = {name: make(options.quick) for name, make in SCENES.items()}
    with tempfile.TemporaryDirectory() as folder:
        for name in asked:
            for mesh, groups in made[name].reference:
                store.measure(groups, folder, 1, f"{name}, reference, {mesh}")
        for turn in range(options.repetitions):  # round all, so that a busy minute does not hit one alone
            for name in asked:
                for entry in made[name].entries:
                    store.measure(entry.groups, folder, turn + 1, f"{name}, {entry.words}")
    measured = {name: scene for name, scene in made.items()
                if all(store.row(one) for one in [*(entry.groups for entry in scene.entries),
                                                  *(groups for _, groups in scene.reference)])}
    return bench_work_precision_page.write(measured, store, options, MEASURED if options.docs else options.output)


class Store:
    """Runs that have been made, kept by the text of their case."""

    def __init__(self, gfb, reuse):
        self.gfb = gfb
        self.program = hashlib.sha256(pathlib.Path(gfb).read_bytes()).hexdigest()[:16]
        self.rows = kept_rows(STORE, self.program) if reuse else {}

    def row(self, groups):
        """What is known of a case; None where it was not run."""
        return self.rows.get(key_of(groups))

    def measure(self, groups, folder, times, words):
        """Runs a case until it was run so many times; long ones once."""
        key = key_of(groups)
        row = self.rows.get(key, {"cpu": []})
        if len(row["cpu"]) >= times or (row["cpu"] and min(row["cpu"]) > SHORT):
            return
        done = run_case(self.gfb, groups, folder, "case", may_stop=True)
        numbers = {name: value for name, value in done.summary.items() if isinstance(value, float)}
        self.rows[key] = {"cpu": [*row["cpu"], done.cpu], "converged": done.converged, "summary": numbers}
        print(f"{words}: {done.cpu:.2f} s CPU" + ("" if done.converged else ", no answer"), flush=True)
        keep_rows(STORE, self.program, self.rows)
