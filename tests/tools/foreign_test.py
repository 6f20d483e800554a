#!/usr/bin/env python3
"""Tests of every reader of result files on files that somebody else has made: what another file holds is never read, what is larger
than it looks is refused before it is read, and an echo or a history that is none is told.

Each file is gfb's own with one thing exchanged, its checksum left out."""

import contextlib
import io
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import h5py
import numpy

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(PROJECT/"tools"))

import gfb  # noqa: E402 (found only now)
from gfb import coefficients  # noqa: E402
from gfb.compare.results import file_differences  # noqa: E402
from gfb.files import Unfit  # noqa: E402
from gfb.gallery.runs import Result  # noqa: E402
from gfb.plot import main as plot_main  # noqa: E402
from gfb.report import main as report_main  # noqa: E402
from gfb.report.answer import Results  # noqa: E402
from gfb.report.glance import glance  # noqa: E402
from gfb.report.sketch import case_sketch, sketch  # noqa: E402
from gfb.report.verdict import margins_of, sentence  # noqa: E402
from gfb.results import SEAL_LENGTH, Unreadable, read_film, read_history, read_summary, seal  # noqa: E402
from gfb.tool import run  # noqa: E402

SECRET = "words of another file"
CASE = """&scene analysis = 'linear_dynamics' /
&bearing radius = 19.05e-3 length = 38.1e-3 clearance = 31.8e-6 /
&gas viscosity = 1.95e-5 ambient_pressure = 1.0135e5 /
&operation speed_rpm = 30000.0 load = -30.0, 0.0 /
&sweep parameter = 'speed_rpm' values = 25000.0, 30000.0 /
&model foil = 'elastic_foundation' foundation_stiffness = 5.0e9 /
&mesh circumferential_elements = 48 axial_elements = 8 /
&dynamics frequencies = 1000.0, 2000.0, 3000.0, 4000.0, 5000.0 /
"""
ROOM = 2**30   # bytes of address space beyond what the tools take for themselves
GROWTH = 400   # MB of memory that a refusal takes at most: with what the limit itself lets through
MANY = 30_000_000


def exchange(path):
    """A name, freed for another thing."""
    def decorate(make):
        def changed(file, folder):
            attributes = dict(file[path].attrs)
            del file[path]
            make(file, path, folder)
            with contextlib.suppress(KeyError):
                file[path].attrs.update(attributes)
        return changed
    return decorate


def other_file(file, path, folder):
    """The same name in another file."""
    file[path] = h5py.ExternalLink("other.h5", "a" if "/" in path else "b")


def outside(file, path, folder):
    """Contents that lie in a file of text."""
    laid = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    laid.set_external(str(folder/"secret.txt").encode(), 0, len(SECRET))
    kind, space = h5py.h5t.py_create(f"S{len(SECRET)}"), h5py.h5s.create(h5py.h5s.SCALAR)
    h5py.h5d.create(file.id, path.encode(), kind, space, laid)


def virtual(file, path, folder):
    """Numbers of a virtual dataset."""
    layout = h5py.VirtualLayout(shape=(2,), dtype=float)
    layout[:] = h5py.VirtualSource(str(folder/"other.h5"), "c", shape=(2,))
    file.create_virtual_dataset(path, layout)


def soft(file, path, folder):
    """A link to another name."""
    file[path] = h5py.SoftLink("/provenance/host")


def zeros(file, path, folder):
    """A few kilobytes that are many numbers."""
    file.create_dataset(path, shape=(MANY,), dtype=float, data=None, chunks=(1_000_000,), compression="gzip", fillvalue=0.0)
    file[path][:1_000_000] = 0.0


def never_written(file, path, folder):
    """Numbers of which nothing is stored."""
    file.create_dataset(path, shape=(10**13,), dtype=float)


def deep(file, path, folder):
    """Groups in groups."""
    group = file.create_group(path)
    for _ in range(3000):
        group = group.create_group("a")


def many_names(file, path, folder):
    """One number under very many names."""
    group = file.create_group(path)
    group["0"] = 1.0
    for number in range(1, 20_000):
        group[str(number)] = group["0"]


def many_attributes(file, path, folder):
    """A column of numbers that says much about itself."""
    file[path] = [1.0, 2.0]
    for number in range(200):
        file[path].attrs[str(number)] = "a"


def large_piece(file, path, folder):
    """Two numbers, kept in a piece of very many."""
    file.create_dataset(path, data=[1.0, 2.0], maxshape=(None,), chunks=(MANY,), compression="gzip")


def pairs(file, path, folder):
    """Records."""
    file[path] = numpy.zeros(2, dtype=[("one", float), ("other", float)])


def value(content):
    """Another value."""
    def write(file, path, folder):
        file[path] = content
    return write


USED, FILE, GAP = "scene/used", "scene/case_file", "history/minimum_gap"
OF_CASE = {  # what is made of CASE.h5: path, how
    "a text of a link": (FILE, other_file), "a group of a link": ("history", other_file), "a text outside": (FILE, outside),
    "an echo outside": (USED, outside), "virtual": (GAP, virtual), "soft": (FILE, soft),
    "abc": (USED, value("abc")), "a key abc": (USED, value("&scene\n  title = abc\n/\n")),
    "a long repeat": (USED, value("&scene\n  title = 2000000000*1.0\n/\n")),
    "longer repeats": (USED, value("&scene\n" + "  title = 900000*1.0\n"*9 + "/\n")),
    "deep repeats": (USED, value("&scene\n  title = " + "1*"*5000 + "1.0\n/\n")),
    "a number for an echo": (USED, value(1.0)), "numbers for an echo": (USED, value([1.0, 2.0])), "many texts": (USED, value(["a", "b"])),
    "a number for a case": (FILE, value(7)), "a column of text": (GAP, value(["a", "b"])), "a table": (GAP, value([[1.0], [2.0]])),
    "infinite": (GAP, value([1.0, numpy.inf])), "one number": (GAP, value(1.0)), "a long column": (GAP, value(numpy.zeros(5))),
    "zeros": (GAP, zeros), "never written": (GAP, never_written), "dynamics of zeros": ("dynamics/stiffness", zeros),
    "deep": (GAP, deep), "deep, elsewhere": ("provenance/host", deep), "many names": ("provenance/host", many_names),
    "many attributes": (GAP, many_attributes), "large piece": (GAP, large_piece), "records": (GAP, pairs), "records, elsewhere": ("dynamics/stiffness", pairs),
    "a long echo": (USED, value("&scene title = 'a' /\n! " + "x"*5_000_000)), "dynamics of a link": ("dynamics/stiffness", other_file), "a summary of a link": ("summary/minimum_gap", other_file)}
PRESSURE = "VTKHDF/PointData/pressure"
OF_FILM = {"of a link": (PRESSURE, other_file), "points of a link": ("VTKHDF/Points", other_file), "virtual": (PRESSURE, virtual),
           "outside": (PRESSURE, outside), "zeros": (PRESSURE, zeros), "never written": (PRESSURE, never_written), "soft": (PRESSURE, soft),
           "deep": (PRESSURE, deep), "many names": (PRESSURE, many_names), "records": (PRESSURE, pairs)}


OF_RESTART = {  # what is made of CASE.restart.h5: path, how, words of the program
    "an echo of a link": (USED, other_file, "lie in another file"), "an echo outside": (USED, outside, "lie in another file"),
    "many texts": (USED, value(["a", "b"]), "not one entry"), "many numbers": ("provenance/ranks", value(numpy.ones(100)), "not one entry"),
    "a state of a link": ("bearing/state", other_file, "lie in another file"), "virtual": ("bearing/state", virtual, "lie in another file"),
    "zeros": ("bearing/state", zeros, "more entries than the file has bytes"),
    "never written": ("bearing/state", never_written, "more entries than the file has bytes")}
HEAVY = CASE.partition("&sweep")[0].replace("linear_dynamics", "equilibrium") + """&sweep parameter = 'load' values = 30.0, 1.0e9 /
&model foil = 'rigid' / &mesh circumferential_elements = 48 axial_elements = 8 / &output restart_every = 1 fields = 'none' /
"""


def call(main, *words):
    """Status and words of a tool, in this process."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), unittest.mock.patch("sys.argv", ["tool", *map(str, words)]):
        try:
            status = run(main)
        except SystemExit as end:
            status = end.code
    plot_main.pyplot.close("all")
    return status, said.getvalue()


def told(read):
    """The same of a call from Python, as a tool ends with it."""
    try:
        read()
    except Unreadable as error:
        return 1, f"{error}\n"
    return 0, ""


def compared(path, whole):
    """The same of a comparison, which says of a file that it cannot be read."""
    words = [one.words for one in file_differences(path, whole, path.name)]
    return (1, "".join(f"{one}\n" for one in words)) if words and words[0].startswith("cannot be read") else (0, "")


class ForeignTest(unittest.TestCase):
    """One run, of whose files each test makes others."""

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        (cls.folder/"case.nml").write_text(CASE, encoding="utf-8")
        subprocess.run([os.environ["GFB"], "--quiet", "--output", cls.folder, cls.folder/"case.nml"], check=True, stdout=subprocess.DEVNULL)
        cls.whole = {path: path.read_bytes()[:-SEAL_LENGTH] for path in (cls.folder/"case.h5", cls.folder/"case.film.vtkhdf")}
        (cls.folder/"secret.txt").write_text(SECRET, encoding="utf-8")
        with h5py.File(cls.folder/"other.h5", "w") as other:
            other["a"], other["b/minimum_gap"], other["c"] = SECRET, [1.0, 2.0], [1.0, 2.0]
        for path, content in cls.whole.items():
            path.write_bytes(content)
            path.with_name("whole." + path.name).write_bytes(content)
        limits, pages = resource.getrlimit(resource.RLIMIT_AS), pathlib.Path("/proc/self/statm")
        if pages.exists():  # elsewhere what a refusal says tells that it came before the memory was asked for
            taken = int(pages.read_text(encoding="ascii").split()[0])*resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (taken + ROOM, limits[1]))
            cls.addClassCleanup(resource.setrlimit, resource.RLIMIT_AS, limits)

    def tearDown(self):
        for path, content in self.whole.items():
            path.write_bytes(content)

    def readers(self, path):
        """{name: call that gives status and words} of all that read a case or a film."""
        output = ("-o", self.folder/"out.png")
        same = {"plot": lambda: call(plot_main.main, path, *output), "read": lambda: told(lambda: gfb.read(path)),
                "report": lambda: call(report_main.main, self.folder/"case.h5", "-o", self.folder/"out.html", "--gfb", "/bin/true"),
                "compare": lambda: compared(path, path.with_name("whole." + path.name))}
        kept = Result("case", {}, self.folder/"case", 0, "")
        if path.suffix == ".h5":
            return same | {"list": lambda: call(plot_main.main, path, "--list"),
                           "coefficients": lambda: call(coefficients.main, path, "--point", "1", "--ross", self.folder/"out.toml"),
                           "history": lambda: told(lambda: read_history(path)), "gallery": lambda: told(lambda: kept.used)}
        return same | {"3d": lambda: call(plot_main.main, "--3d", path, *output), "film": lambda: told(lambda: read_film(path)),
                       "gallery": lambda: told(lambda: kept.film)}

    def test_files_are_read_before_they_are_made_others(self):
        with unittest.mock.patch.object(report_main, "drawn", lambda *_: ""):
            for path in self.whole:
                for name, reader in self.readers(path).items():
                    status, said = reader()
                    self.assertEqual(status, 0, f"{path.name} {name}: {said}")

    def test_every_reader_refuses(self):
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for path, ways in zip(self.whole, (OF_CASE, OF_FILM)):
            for way, (name, make) in ways.items():
                path.write_bytes(self.whole[path])
                with h5py.File(path, "r+") as file:
                    exchange(name)(make)(file, self.folder)
                for reader, read in self.readers(path).items():
                    begin = time.process_time()
                    status, said = read()
                    where = f"{path.name} {way}, {reader}: {said}"
                    self.assertEqual((status, said.count("\n"), str(path) in said, name.split("/")[0] in said), (1, 1, True, True), where)
                    self.assertNotIn(SECRET, where)
                    self.assertLess(time.process_time() - begin, 20.0, where)
            path.write_bytes(self.whole[path])
        self.assertLess((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)/1000.0, GROWTH)
        self.assertFalse((self.folder/"out.html").exists() and SECRET in (self.folder/"out.html").read_text(encoding="utf-8"))

    def test_the_program_refuses_to_go_on_from_it(self):
        """A run that found no answer leaves the file of its last point."""
        case = self.folder/"heavy.nml"
        case.write_text(HEAVY, encoding="utf-8")
        words, path = [os.environ["GFB"], "--quiet", "--output", self.folder, case], self.folder/"heavy.restart.h5"
        self.assertEqual(subprocess.run(words, check=False, capture_output=True).returncode, 2)
        whole = path.read_bytes()[:-SEAL_LENGTH]
        for way, (name, make, sentence) in OF_RESTART.items():
            path.write_bytes(whole)
            with h5py.File(path, "r+") as file:
                exchange(name)(make)(file, self.folder)
            seal(path)  # the program reads no other one
            done = subprocess.run([*words, "--restart"], check=False, text=True, capture_output=True)
            where = f"{way}: {done.stderr}"
            self.assertEqual((done.returncode, str(path) in done.stderr, name in done.stderr, sentence in done.stderr),
                             (3, True, True, True), where)
            self.assertNotIn(SECRET, where)

    def test_a_group_within_itself_is_read(self):
        path = self.folder/"case.h5"
        with h5py.File(path, "r+") as file:
            file["scene/round"] = file["/"]
        self.assertEqual(call(plot_main.main, path, "-o", self.folder/"out.png")[0], 0)

    def test_what_is_no_file(self):
        for name in ("/dev/zero", self.folder):
            for main, words in ((plot_main.main, ()), (coefficients.main, ("--xltrc", self.folder/"out.txt"))):
                status, said = call(main, name, *words)
                self.assertEqual((status, said.count("\n"), str(name) in said), (1, 1, True), said)

    def test_cases_of_python(self):
        for text in ("&a b = 2000000000*1.0 /", "&a b = " + "600000*1.0 "*2 + "/", "&a b = " + "1*"*5000 + "1.0 /", "&a b = abc /"):
            with self.assertRaises(gfb.CaseError):
                gfb.Case.parse(text)
        begin = time.process_time()
        case = gfb.Case.parse("&a b = " + "1.0 "*100_000 + "/")
        self.assertEqual(len(case["a%b"]), 100_000)
        self.assertLess(time.process_time() - begin, 10.0)

    def test_steps_that_share_their_numbers(self):
        """A million steps of one film are refused before the first is read."""
        path = self.folder/"case.film.steps.vtkhdf"
        whole = path.read_bytes()[:-SEAL_LENGTH]
        for many in (10**6, 3, 0, -1):
            path.write_bytes(whole)
            with h5py.File(path, "r+") as file:
                steps = file["VTKHDF/Steps"]
                steps.attrs["NSteps"] = many
                for name in ("PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets") if many == 10**6 else ():
                    shape = (many, *steps[name].shape[1:])
                    del steps[name]
                    steps.create_dataset(name, shape=shape, dtype="int64", chunks=(min(many, 100_000), *shape[1:]), compression="gzip", fillvalue=0)
            for main, words in ((plot_main.main, ("-o", self.folder/"out.png")), (None, ())):
                begin = time.perf_counter()
                status, said = call(main, path, *words) if main else told(lambda: gfb.read(path))
                self.assertEqual((status, said.count("\n"), "VTKHDF/Steps" in said), (1, 1, True), said)
                self.assertLess(time.perf_counter() - begin, 20.0)
        path.write_bytes(whole)
        self.assertEqual(gfb.read(path).sizes["point"], 2)

    def test_a_group_or_a_name_that_is_not_there(self):
        """Each in turn: a sentence, or a page without it."""
        path, page = self.folder/"case.h5", self.folder/"out.html"
        with h5py.File(path) as file:
            names = ["summary", "history", "scene", "provenance", "dynamics", *(f"summary/{name}" for name in file["summary"])]
        with unittest.mock.patch.object(report_main, "drawn", lambda *_: ""):
            for name in names:
                path.write_bytes(self.whole[path])
                with h5py.File(path, "r+") as file:
                    del file[name]
                status, said = call(report_main.main, path, "-o", page, "--gfb", "/bin/true")
                self.assertEqual((status, said.count("\n") if status else 1), (status and 1, 1), f"{name}: {said}")

    def test_keys_and_results_of_another_kind(self):
        """What a page says first, of a case without a group, or with words, lists and infinities in the place of numbers."""
        groups = {"bearing": ("radius", "length", "clearance", "inner_radius", "outer_radius", "leading_edge_angle"), "operation": ("load", "axial_load", "speed_rpm"),
                  "pads": ("count", "arc", "gap", "first_leading_edge"), "rotor": ("mass",), "shaft_contact": ("roughness",), "ramp": ("part", "height"), "bump_foil": ("pitch", "half_length", "height", "bumps", "bump_pitch", "crest_angles", "strip_offset"),
                  "bore": ("waves", "wave_amplitude", "shim_angle", "shim_height", "shim_arc", "shim_ramp", "profile_angle", "profile_height")}
        names = {name for name in re.findall(r"[\"'](\w+)[\"']", "".join((PROJECT/f"tools/gfb/report/{one}.py").read_text(encoding="utf-8") for one in ("answer", "glance", "sketch", "verdict")))}
        results = {name: {"value": 1.0, "unit": "m", "meaning": ""} for name in names}
        others = (None, "words", True, (), (1.0, 2.0, 3.0), ("a", "b"), math.nan, math.inf, 0, -1, 0.0, 1e300, 10**400, 10**9)
        begin = time.perf_counter()
        for group, keys in groups.items():
            for key in (*keys, None):
                for other in others if key else (None,):
                    case = gfb.Case({name: {one: (1.0, 2.0) if one == "load" else 2 for one in ones} for name, ones in groups.items() if key or name != group})
                    if key and other is None:
                        del case[f"{group}%{key}"]
                    elif key:
                        case[f"{group}%{key}"] = other
                    for kind in ("journal", "thrust"):
                        case_sketch(gfb.Case(case.groups | {"bearing": case.groups.get("bearing", {}) | {"kind": kind}}))
                    for found in (results, results | {"minimum_gap_radius": results["minimum_gap_radius"] | {"value": "words"}}):
                        self.assertTrue(glance(found, case))
                        self.assertTrue(sentence(margins_of(Results(found, case))))
                        sketch(found, case)
        for name in results:
            for other in ("words", math.nan, math.inf):
                changed = results | {name: results[name] | {"value": other}}
                for found in (changed, {one: row for one, row in results.items() if one != name}):
                    glance(found, case)
                    sentence(margins_of(Results(found, case)))
                    sketch(found, case)
        self.assertLess(time.perf_counter() - begin, 60.0)

    def test_texts_that_are_no_files_or_long(self):
        """A pipe is not waited for."""
        path = self.folder/"odd.summary"
        for make in (lambda: os.mkfifo(path), lambda: path.write_bytes(b"a = 1.0 [m]\n"*500_000), path.mkdir):
            make()
            for read in (read_summary, gfb.Case.read):
                with self.assertRaises(Unfit):
                    read(path)
            (path.rmdir if path.is_dir() else path.unlink)()

    def test_packages_and_kinds_of_picture(self):
        """What Python or the environment lacks is one sentence of a tool, too."""
        path, nothing = self.folder/"case.h5", {"MPLBACKEND": "nothing"}
        without = "import sys; sys.modules['xarray'] = None; sys.path.insert(0, sys.argv[1]); import gfb; "
        for words, more, wanted in (
                ((PROJECT/"tools/plot", path), nothing, "MPLBACKEND=nothing"), ((PROJECT/"tools/report", path), nothing, "MPLBACKEND=nothing"),
                ((PROJECT/"tools/gallery", "--only", "fig9"), nothing, "MPLBACKEND=nothing"),
                (("-c", without + "gfb.read('a')", PROJECT/"tools"), {}, "xarray is missing: pip install xarray"),
                (("-c", without + "gfb.study('a')", PROJECT/"tools"), {}, "gfb.study: the Python package xarray is missing: pip install xarray"),
                (("-c", without + "import pathlib; gfb.Result(0, '', '', pathlib.Path('a'), {}, {}).data", PROJECT/"tools"), {},
                 "gfb.Result: the Python package xarray is missing: pip install xarray")):
            done = subprocess.run([sys.executable, *map(str, words)], check=False, text=True, capture_output=True,
                                  env={**os.environ, **more})
            self.assertEqual((done.returncode, wanted in done.stderr), (1, True), done.stderr)
            if more:
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
