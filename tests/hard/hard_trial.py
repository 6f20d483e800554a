"""A hard scene: runs of gfb that may end without an answer, what they cost, and claims about what came out."""

import dataclasses
import math
import pathlib
import subprocess
import sys
import tempfile
import traceback

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent/"verification"))

from gfb_run import GFB  # noqa: E402 (found only now; it says where the following is)
from gfb.running import run_file, write_case  # noqa: E402

SECONDS = 200
NAMED = ("no equilibrium found", "no answer found")  # what the log says where there is no answer
GU2020 = {
    "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
    "operation": {"speed_rpm": 30000.0},
}
SHEET = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29}
PAD_BUMPS = {**SHEET, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 26,
             "fixed_line": "half_flat"}
BEAMS = {
    **GU2020, "top_foil": {**SHEET}, "bump_foil": {**PAD_BUMPS},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1, "normal_stiffness": 5.0e10, "stick_length": 1.0e-7},
    "model": {"foil": "beam", "film_scheme": "galerkin"},
    "mesh": {"circumferential_elements": 104, "axial_elements": 4, "arc_elements": 8, "flat_elements": 2},
}
STRIP = {
    "scene": {"analysis": "strip"},
    "bump_foil": {**SHEET, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 4,
                  "width": 10.0e-3, "fixed_edge": "none"},
    "strip_load": {"kind": "plates", "maximum_force": 40.0, "steps_up": 5},
    "mesh": {"arc_elements": 6, "flat_elements": 2, "axial_elements": 6},
}
CLEARANCE = GU2020["bearing"]["clearance"]
FORCE_UNIT = 1.0135e5*38.1e-3*38.1e-3  # p_a L D of that bearing


def merged(content, **changes):
    """Groups of a case with some keys changed; a key whose value is None is left out."""
    groups = {name: dict(keys) for name, keys in content.items()}
    for name, keys in changes.items():
        groups.setdefault(name, {}).update(keys)
    return {name: {key: value for key, value in keys.items() if value is not None}
            for name, keys in groups.items()}


@dataclasses.dataclass
class Scene:
    """A row of the table."""

    part: str            # of the page
    words: str
    play: callable       # play(trial)
    iterations: int      # Newton iterations that each of its runs may take at most
    limit: str = ""      # why it fails, where that is known
    source: callable = None  # the function that several scenes share


@dataclasses.dataclass
class Trial:
    """One scene being played."""

    folder: pathlib.Path
    bound: int
    failures: list = dataclasses.field(default_factory=list)
    outcomes: list = dataclasses.field(default_factory=list)
    broken: bool = False      # a rule that holds for all runs, known limits too
    claims: int = 0
    runs: int = 0
    iterations: int = 0       # of the dearest run
    factorizations: int = 0   # of the dearest run
    seconds: float = 0.0      # of all runs

    def solve(self, content, options=(), status=0, **changes):
        """Runs a case; it must end with that status (None: with an answer or without), and with numbers only."""
        self.runs += 1
        path = write_case(self.folder, f"case_{self.runs}", merged(content, **changes))
        answer = run_file(GFB, path, self.folder, options=options, seconds=SECONDS)
        self.seconds += answer.wall
        wanted = (0, 2) if status is None else (status,)
        self.that(f"run {self.runs} ends with status {answer.status}, not {status}: {self.reason(answer)}",
                  answer.status in wanted)
        self.must(f"run {self.runs} broke off with status {answer.status}", answer.status in (0, 1, 2))
        if answer.status == 2:
            self.must(f"run {self.runs} does not name why there is no answer",
                      any(words in answer.log for words in NAMED))
        if answer.status in (0, 2):
            self.count(answer)
        return answer

    def count(self, answer):
        """Its work, which is bounded, and that all is finite."""
        self.must(f"run {self.runs} has a NaN", "NaN" not in answer.log + answer.complaint
                  and all(map(math.isfinite, answer.physical().values())))
        self.must(f"run {self.runs} does not say whether it converged",
                  answer.summary.get("converged") == ("true" if answer.status == 0 else "false"))
        iterations = int(answer.summary.get("newton_iterations", 0))
        self.iterations = max(self.iterations, iterations)
        self.factorizations = max(self.factorizations, int(answer.summary.get("factorizations", 0)))
        self.must(f"run {self.runs} takes {iterations} Newton iterations, more than {self.bound}",
                  iterations <= self.bound)

    @staticmethod
    def reason(answer):
        """The sentence of a run without an answer."""
        for line in (answer.log + answer.complaint).splitlines():
            if any(words in line for words in NAMED) or "ERROR" in line or "error" in line:
                return line.strip()
        return (answer.log + answer.complaint).strip()[-160:]

    def refused(self, content, names=(), status=2, **changes):
        """A case without an answer: one of the names stands in its sentence. Status 1: refused as it is read."""
        answer = self.solve(content, status=status, **changes)
        reason = self.reason(answer)
        if names:
            self.that(f"refused, but by another name: {reason}", any(name in reason for name in names))
        self.says("refused: " + reason.split("found: ")[-1].split(".nml:")[-1].split(" (")[0])
        return answer

    def balanced(self, content, limit=1.0e-6, **changes):
        """An equilibrium, whose film carries the load."""
        answer = self.solve(content, **changes)
        load = numpy.array(merged(content, **changes)["operation"]["load"])
        self.below("force = load", numpy.abs(answer.force - load).max()/math.hypot(*load), limit)
        return answer

    def way_back(self, content, answer, limit=1.0e-6, **changes):
        """The shaft held where it was found feels the load, as far as a thousandth of p_a L D can be told."""
        fixed = self.solve(merged(content, **changes), scene={"analysis": "fixed_position"},
                           operation={"eccentricity": tuple(answer.eccentricity), "load": None})
        self.below("held where it was found: force = load",
                   numpy.abs(fixed.force - answer.force).max()/max(math.hypot(*answer.force), 1.0e-3*FORCE_UNIT), limit)
        return fixed

    def says(self, words):
        """What came out, for the page."""
        if words not in self.outcomes:
            self.outcomes.append(words)

    def that(self, words, truth):
        """A claim; the words tell what is wrong where it does not hold."""
        self.claims += 1
        if not truth:
            self.failures.append(words)

    def must(self, words, truth):
        """A rule that no known limit excuses."""
        self.that(words, truth)
        self.broken = self.broken or not truth

    def below(self, words, value, limit):
        """A size that must not exceed its limit; NaN fails."""
        self.that(f"{words}: {value:.2e}, more than {limit:.0e}", abs(value) <= limit)

    def within(self, words, value, low, high):
        """A number in a range; NaN fails."""
        self.that(f"{words}: {value:.5g}, not within {low:g} .. {high:g}", low <= value <= high)


def played(scene):
    """Plays a scene in a folder of its own."""
    with tempfile.TemporaryDirectory() as name:
        trial = Trial(pathlib.Path(name), scene.iterations)
        try:
            scene.play(trial)
        except subprocess.TimeoutExpired:
            trial.must(f"run {trial.runs} takes more than {SECONDS} s", False)
        except (LookupError, ValueError, OSError, ZeroDivisionError) as wrong:
            line = traceback.extract_tb(wrong.__traceback__)[-1].lineno
            trial.failures.append(f"run {trial.runs} left nothing to look at ({type(wrong).__name__} {wrong}, {line})")
    return trial


def scene_book():
    """A list of scenes and the decorator that adds to it."""
    scenes = []

    def scene(part, words, iterations=200, limit="", **settings):
        def add(play):
            # Decorators act from the last to the first.
            place = next((i for i, one in enumerate(scenes) if one.source is play), len(scenes))
            scenes.insert(place, Scene(part, words, lambda trial: play(trial, **settings), iterations, limit, play))
            return play
        return add

    return scenes, scene
