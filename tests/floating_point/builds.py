"""The same scenes by several builds of gfb, on one rank and on several: what differs between their answers."""

import dataclasses
import pathlib
import subprocess
import tempfile
import time

from scenes import TOLERANCE  # first: it says where the following are
from gfb.case import Case
from gfb.running import run_file
from same_answer import difference

SECONDS = 900
BASE = ("release", 1, 0)  # build, ranks, groups of ranks: what all others are compared with
# The C library fills what it allocates with bytes of 7F: reals of 1.4e306, whose squares overflow, and integers
# that are no index. What lies on the stack is filled by the compiler, with signalling NaN.
FILLED = {"MALLOC_PERTURB_": "128"}


@dataclasses.dataclass
class Row:
    """A scene of the table."""

    scene: object
    found: dict = dataclasses.field(default_factory=dict)  # (build, ranks, groups): largest difference, its name
    wrong: list = dataclasses.field(default_factory=list)
    seconds: float = 0.0

    @property
    def tolerance(self):
        """Of its numbers."""
        return TOLERANCE[self.scene.kind]


def ways_of(scene, builds):
    """What runs a scene: build, ranks, groups."""
    ways = [(build, ranks, 0) for ranks in scene.ranks for build in builds]
    return ways + ([("debug", 4, scene.groups), ("release", 4, scene.groups)] if scene.groups else [])


def options_of(scene, groups=0):
    """The program's options."""
    return [*scene.options, *(["--groups", str(groups)] if groups else [])]


def run_once(gfb, path, folder, scene, way, more=()):
    """A run and what it left; words where it did not end as it must."""
    build, ranks, groups = way
    try:
        answer = run_file(gfb, path, folder, ranks, [*options_of(scene, groups), *more], seconds=SECONDS,
                          environment=FILLED if build == "debug" else None)
    except subprocess.TimeoutExpired:
        return None, f"takes more than {SECONDS} s"
    if answer.status != scene.status:
        return None, f"status {answer.status}, not {scene.status}:\n{(answer.log + answer.complaint)[-2500:]}"
    return answer, ""


def run_way(gfb, path, folder, scene, way):
    """An answer, the second one where a run is to go on."""
    answer, wrong = run_once(gfb, path, folder, scene, way)
    if scene.restart and not wrong:
        answer, wrong = run_once(gfb, path, folder, scene, way, ("--restart",))
        if not wrong and "restart: resumed from" not in answer.log:
            wrong = "was not resumed from its restart file"
    return answer, wrong


def compare_scene(scene, builds):
    """Runs a scene all ways; builds: {name: program}."""
    row, text = Row(scene), str(Case(scene.case))
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        base = None
        for way in sorted(ways_of(scene, builds), key=lambda way: way != BASE):
            folder = pathlib.Path(name)/"_".join(map(str, way))
            folder.mkdir()
            path = folder/f"{scene.name}.nml"
            path.write_text(text, encoding="utf-8")
            answer, wrong = run_way(builds[way[0]], path, folder, scene, way)
            if wrong:
                row.wrong.append(f"{words_of(way)}: {wrong}")
                if base is None:
                    break
            elif base is None:
                base = answer
            else:
                judge(row, way, difference(base, answer, text))
    row.seconds = time.monotonic() - begun
    return row


def judge(row, way, found):
    """Notes a difference and whether it is too large."""
    row.found[way] = found.largest
    if not found.largest[0] <= row.tolerance:
        row.wrong.append(f"{words_of(way)}: {found.largest[1]} differs by {found.largest[0]:.2e}, "
                         f"more than {row.tolerance:.0e}")
    if not found.alike:
        row.wrong.append(f"{words_of(way)}: other words in the summary, or other columns in the history")


def words_of(way):
    """Build and ranks, for people."""
    build, ranks, groups = way
    return f"{build}, {ranks} rank{'s' if ranks > 1 else ''}" + (f" in {groups} groups" if groups else "")
