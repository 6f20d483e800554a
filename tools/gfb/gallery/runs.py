"""Runs of the gallery: case files of inputs/, as they are or with some keys changed, and what they gave."""

import concurrent.futures
import dataclasses
import functools
import hashlib
import json
import pathlib
import re

from gfb.namelist import namelist_value
from gfb.plot.film import draw_film, read_film
from gfb.program import DONE, NOT_CONVERGED, call, command_of, read_keys, stem_of, words_of
from gfb.results import open_results, read_history, reading, read_json, read_summary, text_of, used_keys
from gfb.studio.text import with_value
from gfb.tool import ROOT, stop

LONGEST = 70                # letters of a run's name; what is longer ends in a digest
AMBIGUOUS = {"top_foil.fixed_edge", "bump_foil.fixed_edge"}  # keys of two groups
REASON = re.compile(r"^no (?:equilibrium|answer)[^:\n]* found[^:\n]*: .*(?:\nlast state reached: .*)?$", re.MULTILINE)


@dataclasses.dataclass
class Result:
    """A finished run."""

    case: str           # name of the file in inputs/
    changes: dict       # "group.key": value, where it differs from that file
    stem: pathlib.Path  # of the result files
    status: int
    said: str           # by the program

    @property
    def converged(self):
        return self.status == DONE

    @property
    def reason(self):
        """Why there is no answer, in gfb's words."""
        found = REASON.search(self.said)
        return found[0].replace("\n", "; ") if found else "gfb found no answer"

    @functools.cached_property
    def summary(self):
        return read_summary(f"{self.stem}.summary")[0]

    def __getitem__(self, name):
        return self.summary[name]

    @functools.cached_property
    def history(self):
        """{column: values, a point each}."""
        return read_history(self.path)

    @functools.cached_property
    def film(self):
        """Of the last point."""
        return self.of_film(read_film)

    def draw_film(self):
        """tools/plot's picture of the film."""
        return self.of_film(draw_film)

    def of_film(self, what):
        path = pathlib.Path(f"{self.stem}.film.vtkhdf")
        if not path.exists():  # of several branches the first one's
            path = pathlib.Path(f"{self.stem}.1.film.vtkhdf")
        with reading(path), open_results(path) as file:
            return what(path, file)

    @functools.cached_property
    def used(self):
        """{(group, key): (value, whether it is a default)}."""
        with reading(self.path), open_results(self.path) as file:
            return used_keys(file)

    @functools.cached_property
    def provenance(self):
        """{name: words or number}."""
        with reading(self.path), open_results(self.path) as file:
            values = {name: data[()] for name, data in file["provenance"].items()}
        return {name: text_of(value) if isinstance(value, bytes) else value for name, value in values.items()}

    @property
    def path(self):
        return pathlib.Path(f"{self.stem}.h5")

    def open(self):
        with reading(self.path):
            return open_results(self.path)


class Runs:
    """Runs cases, or takes what an earlier call left."""

    def __init__(self, gfb, folder, reuse=False, jobs=1, quick=False):
        """folder: where each run has a folder of its own; reuse: take this program's runs of the same case text from there;
        jobs: runs at a time; quick: without variants and finer meshes.
        """
        self.gfb, self.folder, self.reuse, self.jobs = gfb, pathlib.Path(folder), reuse, jobs
        self.quick = quick
        self.done = {}  # name: result of this call

    @functools.cached_property
    def keys(self):
        """{(group, key)} the program knows."""
        return {(key.group, key.name) for key in read_keys(self.gfb).values()}

    @functools.cached_property
    def program(self):
        """What the program calls itself, with version and commit."""
        return words_of(self.gfb)

    @functools.cached_property
    def options(self):
        """Options the program knows."""
        return set(re.findall(r"^\s+(--[a-z-]+)", call([self.gfb, "--help"]).log, re.MULTILINE))

    def run(self, case, changes=None, may_stop=False, options=()):
        """A case of inputs/ with some keys changed; ends the tool where it finds no answer, unless it may."""
        changes = changes or {}
        name = run_name(case, changes, options)
        if name not in self.done:
            self.done[name] = self.run_once(name, case, changes, options)
        if not (self.done[name].converged or may_stop):
            stop(f"{name}: no answer was found: {self.done[name].reason}", 3)
        return self.done[name]

    def run_once(self, name, case, changes, options):
        """Runs a case, or takes what an earlier call left."""
        text = changed((ROOT/"inputs"/f"{case}.nml").read_text(encoding="utf-8"), changes)
        folder = self.folder/name
        note, path = folder/"run.json", folder/f"{name}.nml"
        kept = self.kept(note, path, text)
        if kept is None:
            folder.mkdir(parents=True, exist_ok=True)
            for old in folder.glob(f"{name}.*"):
                old.unlink()
            note.unlink(missing_ok=True)
            path.write_text(text, encoding="utf-8")
            print(f"  runs {name}", flush=True)
            done = call(command_of(self.gfb, path, folder, options=("--quiet", *options)))
            kept = {"status": done.status, "said": done.log + done.complaint, "program": self.program}
            if done.status not in (DONE, NOT_CONVERGED):
                stop(f"{path}: gfb ended with status {done.status}:\n{done.complaint}", 3)
            note.write_text(json.dumps(kept), encoding="utf-8")
        return Result(case, changes, stem_of(path, folder, options, kept["status"]), kept["status"], kept["said"])

    def kept(self, note, path, text):
        """What an earlier call noted of the same case, if it may be taken."""
        if not self.reuse or not note.exists() or path.read_text(encoding="utf-8") != text:
            return None
        kept = read_json(note)
        return kept if kept.get("program") == self.program else None

    def run_all(self, cases, may_stop=False):
        """Results of several (case, changes), some at a time."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(lambda one: self.run(*one, may_stop=may_stop), cases))


def run_name(case, changes, options=()):
    """Name of a run's folder and files."""
    words = [f"{key if key in AMBIGUOUS else key.split('.')[1]}_{namelist_value(value)}"
             for key, value in changes.items()]
    name = re.sub(r"[^\w-]+", "_", "__".join([case, *words, *(one.strip("-") for one in options)])).strip("_")
    if len(name) > LONGEST:
        name = f"{name[:LONGEST]}_{hashlib.sha1(json.dumps(changes).encode()).hexdigest()[:8]}"
    return name


def changed(text, changes):
    """A case file's text with other values; what is not in it yet is added."""
    for name, value in changes.items():
        text = with_value(text, *name.split("."), namelist_value(value))
    return text
