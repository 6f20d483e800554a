#!/usr/bin/env python3
"""gfb from Python: reading, cases, runs, studies."""

import ast
import collections.abc
import graphlib
import inspect
import os
import pathlib
import pydoc
import re
import subprocess
import sys
import tempfile
import time
import typing
import unittest
import unittest.mock
import warnings

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]/"tools"))
import gfb  # noqa: E402
from gfb import result_names  # noqa: E402
from gfb.design_study import parts_of, rows_of, share_of  # noqa: E402
from gfb.design_work import Part, Progress, computed, tilt_words  # noqa: E402
from gfb.program import find_program, launcher, read_keys  # noqa: E402
from gfb.report import main as report  # noqa: E402
from gfb.results import Unreadable, read_history  # noqa: E402
from gfb.tool import ROOT  # noqa: E402
from slow import slow  # noqa: E402

SMALL = {"scene": {"title": "it's small", "analysis": "equilibrium"},
         "bearing": {"radius": 0.02, "length": 0.04, "clearance": 2.0e-5},
         "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5},
         "operation": {"speed_rpm": 20000.0, "load": (-20.0, 0.0)},
         "model": {"foil": "rigid"}, "mesh": {"circumferential_elements": 48, "axial_elements": 8}}


class PythonTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def assert_units(self, dataset):
        """Every number has a unit, as a coordinate too."""
        without = [name for name, one in dataset.variables.items() if one.dtype.kind in "fiub" and not one.attrs.get("units")]
        self.assertEqual(without, [])

    def test_run_and_read(self):
        result = gfb.run(gfb.Case(SMALL), self.folder, "small")
        data = result.data
        self.assertTrue(result.converged)
        self.assertEqual(float(data.minimum_gap), result["minimum_gap"])
        self.assertEqual((data.minimum_gap.dims, data.minimum_gap.units), ((), "m"))
        self.assertIn("smallest", data.minimum_gap.long_name)
        self.assertEqual(data.attrs["analysis"], "equilibrium")
        film = result.film
        self.assert_units(data)
        self.assert_units(film)
        self.assertIs(result.data, data, "read again")
        self.assertIs(result.film, film, "read again")
        self.assertEqual(film.gap.dims, ("theta", "z"))
        self.assertAlmostEqual(float(film.gap.min()), result["minimum_gap"], delta=1e-18)
        self.assertEqual(gfb.Case.parse(data.attrs["case_file"]), gfb.Case(SMALL))

    def test_what_is_shown(self):
        """A function with its signature; a result, and a case, in a line."""
        self.assertTrue(inspect.isfunction(gfb.run))
        self.assertEqual(list(inspect.signature(gfb.run).parameters), ["case", "folder", "name", "ranks", "options", "gfb"])
        self.assertIn("ranks: 'int' = 1", pydoc.render_doc(gfb.run))
        self.assertLessEqual(set(gfb.__all__), set(dir(gfb)))
        case = gfb.Case(SMALL)
        self.assertEqual(repr(case), "<gfb.Case equilibrium: 6 groups, 12 keys>")
        result = gfb.run(case, self.folder, "small")
        self.assertEqual(repr(result), f"<gfb.Result {self.folder}/small: {len(result.summary)} results>")
        case["operation%load"] = (-1.0e9, 0.0)
        shown = repr(gfb.run(case, self.folder, "heavy"))
        self.assertTrue(shown.startswith(f"<gfb.Result {self.folder}/heavy.unconverged: "), shown)
        self.assertLess(len(shown) - len(str(self.folder)), 300)

    def test_names_of_results(self):
        """Those that a type checker knows are of the kind that the program gives, and all that `gfb --results` has but for families."""
        kinds = {name: kind for kind, names in ((float, result_names.NumberName), (str, result_names.TextName)) for name in typing.get_args(names)}
        listed = subprocess.run([find_program(), "--results"], capture_output=True, text=True, check=True).stdout
        cells = [line.split("|")[1] for line in listed.splitlines()[2:]]
        self.assertEqual(sorted(kinds), sorted({name for cell in cells for name in cell.split("`")[1::2] if "<" not in name}))
        capacity = gfb.Case(SMALL | {"scene": {"analysis": "load_capacity"}, "capacity": {"smallest_gap": 1.0e-5}})
        for case in (gfb.Case.template("linear_dynamics"), gfb.Case.template("strip"), capacity):
            result = gfb.run(case, self.folder)
            wrong = [name for name, value in result.summary.items() if not isinstance(value, kinds.get(name, type(value)))]
            self.assertEqual((result.converged, wrong), (True, []))
        self.assertIn("limit_reached", result.summary)

    def test_no_circle_of_imports(self):
        """No module imports, by whatever way, one that imports it; inside of functions and for types neither."""
        names = {".".join(path.relative_to(ROOT/"tools").with_suffix("").parts).removesuffix(".__init__"): path for path in (ROOT/"tools/gfb").rglob("*.py")}
        graph = {}
        for name, path in names.items():
            nodes = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, (ast.Import, ast.ImportFrom))]
            found = {f"{node.module}.{one.name}" if isinstance(node, ast.ImportFrom) else one.name for node in nodes for one in node.names}
            graph[name] = {one if one in names else one.rpartition(".")[0] for one in found} & names.keys()
        self.assertEqual(set(graphlib.TopologicalSorter(graph).static_order()), set(names))
        self.assertIn("gfb.running", graph["gfb"])

    def test_several_ranks(self):
        """Started by what came with the program, or else by mpiexec, where nothing is said."""
        environment = {name: word for name, word in os.environ.items() if name != "GFB_MPIEXEC"}
        for name in ("gfb", "gfb-mpiexec"):
            with unittest.mock.patch.dict(os.environ, environment, clear=True):
                self.assertEqual(launcher(str(self.folder/"gfb")), "mpiexec")
            (self.folder/name).touch(mode=0o755)
        with unittest.mock.patch.dict(os.environ, environment, clear=True):
            self.assertEqual(launcher(str(self.folder/"gfb")), str(self.folder.resolve()/"gfb-mpiexec"))
        with unittest.mock.patch.dict(os.environ, GFB_MPIEXEC="srun"):
            self.assertEqual(launcher(str(self.folder/"gfb")), "srun")

    def test_sweep(self):
        case = gfb.Case(SMALL)
        case["sweep%parameter"], case["sweep%values"] = "load", [20.0, 30.0]
        result = gfb.run(case, self.folder, "sweep", options=("--csv",))
        numpy.testing.assert_array_equal(result.data.minimum_gap, read_history(f"{result.stem}.h5")["minimum_gap"])
        self.assertEqual(result.data["load"].dims, ("point",))
        self.assert_units(result.data)
        self.assert_units(gfb.read(f"{result.stem}.film.steps.vtkhdf"))

    def test_models(self):
        case = gfb.Case(SMALL)
        case["operation%load"] = (-10.0, 0.0)
        for key, value in {"thickness": 1.0e-4, "half_length": 1.8e-3, "pitch": 5.0e-3, "height": 5.0e-4, "bumps": 25,
                           "youngs_modulus": 2.1e11, "poissons_ratio": 0.3, "strips": 2, "cut_width": 1.0e-3}.items():
            case[f"bump_foil%{key}"] = value
        case["top_foil%thickness"], case["contact%friction_top"], case["contact%friction_sleeve"] = 1.0e-4, 0.1, 0.1
        for key, value in {"youngs_modulus": 2.1e11, "poissons_ratio": 0.3}.items():
            case[f"top_foil%{key}"] = value
        models = gfb.compare_models(case, ("rigid", "elastic_foundation", "nothing"), self.folder)
        self.assertEqual(list(models.data.status.values), [0, 0, 1])
        self.assert_units(models.data)
        self.assertEqual(sorted(models.reasons), ["nothing"])
        left_out = " ".join(models.left_out["rigid"])
        for word in ("`&contact`", "`strips`", "`cut_width`"):
            self.assertIn(word, left_out)
        rigid = gfb.Case(SMALL)
        rigid["operation%load"] = (-10.0, 0.0)
        self.assertAlmostEqual(float(models.data.minimum_gap[0])/gfb.run(rigid, self.folder)["minimum_gap"], 1.0, delta=1.0e-12)
        table = models.table()
        self.assertIn("| minimum_gap | um |", table)
        self.assertIn("not possible", table)
        self.assertGreater(models.plot(self.folder/"models.png").stat().st_size, 10000)
        written = (self.folder/"models_rigid.summary").stat().st_mtime_ns
        gfb.compare_models(case, ("rigid",), self.folder)
        self.assertEqual((self.folder/"models_rigid.summary").stat().st_mtime_ns, written, "what is there is computed again")

    @slow
    def test_slow_design(self):
        case = gfb.Case(SMALL | {"rotor": {"mass": 2.0}})
        said, filled, verdicts = [], [], []

        def fill(so_far):  # a page takes a while to draw, and other parts end meanwhile
            filled.append(list(so_far.rows))
            verdicts.append(so_far.verdict)
            time.sleep(0.3)
            so_far.page()

        found = gfb.design(case, self.folder, smallest_gap=8.0e-6, processes=2, tell=said.append, filled=fill)
        self.assertEqual([sum(row[1] == "not computed yet" for row in rows) for rows in filled], [6, 5, 4, 3, 2, 1, 0])
        self.assertEqual([words.split(" parts")[0] for words in verdicts[:-1]], [f"Not finished, {done} of 7" for done in range(1, 7)])
        self.assertEqual(verdicts[-1], found.verdict)
        self.assertEqual([part.name for part in found.parts if part.stem is None], ["lift_off"])
        self.assertTrue(all(part.question in " ".join(said) for part in found.parts if part.stem is not None))
        rows = {question: (answer, verdict) for question, answer, verdict, _ in found.rows}
        point = gfb.results.read_summary(self.folder/"design_point.summary")[0]
        self.assertEqual(rows["thinnest film"][0], f"{1.0e6*point['minimum_gap']:.4g} um")
        plain = gfb.run(gfb.Case(SMALL), self.folder)
        self.assertAlmostEqual(point["minimum_gap"]/plain["minimum_gap"], 1.0, delta=1.0e-9)
        self.assertIn(f"{point['critical_mass']:.4g} kg", rows["critical mass"][0])
        # A full bearing with a slit at theta = 0: loads from all sides, the case's among them.
        films = read_history(self.folder/"design_directions.h5")["minimum_gap"]
        self.assertAlmostEqual(films[0]/plain["minimum_gap"], 1.0, delta=1.0e-9)
        self.assertIn(f"thinnest film {1.0e6*films.min():.4g} um", rows["load from every direction"][0])
        capacity = read_history(self.folder/"design_capacity.h5")
        self.assertIn(f"the load is 20 N: {capacity['load_capacity'][2]/20.0:.3g} times", rows["load capacity over the speed, to a film of 8 um"][1])
        self.assertIn("no &shaft_contact", rows["lift-off speed"][1])
        unbalance = gfb.Case.read(self.folder/"design_orbit.nml")["unbalance%unbalance"]
        self.assertAlmostEqual(unbalance/(2.0*2.5e-3/(20000.0*numpy.pi/30.0)), 1.0, delta=1.0e-12)
        self.assertIn("± ", rows["what tolerances do to the thinnest film"][0])
        self.assertIn("| question | answer | margin |", found.table())
        times = {path: path.stat().st_mtime_ns for path in self.folder.glob("design_*.summary")}
        again = gfb.design(case, self.folder, smallest_gap=8.0e-6, tell=said.append)
        self.assertEqual(times, {path: path.stat().st_mtime_ns for path in times}, "what is there is computed again")
        self.assertEqual(again.rows, found.rows)
        with self.assertRaises(gfb.CaseError):
            case["bearing%radius"] = -1.0
            gfb.design(case, self.folder, "wrong", tell=said.append)

    def test_limits_of_a_study(self):
        """Those of the case hold where the bearing runs, not where a part looks for its end."""
        case = gfb.Case(SMALL | {"rotor": {"mass": 2.0}, "capacity": {"highest_temperature": 420.0, "largest_stress": 4.0e8}})
        limits = {part.name: part.case.groups.get("capacity", {}) for part in parts_of(case, None, 2.5) if part.case is not None}
        self.assertEqual(limits["point"], {"highest_temperature": 420.0, "largest_stress": 4.0e8})
        self.assertEqual(limits["orbit"], limits["point"])
        self.assertEqual((limits["capacity"], limits["misalignment"], limits["whirl"]), ({"smallest_gap": 4.0e-6}, {"smallest_gap": 4.0e-6}, {}))

    def test_tolerances_need_no_unit(self):
        """A tolerance is a share of its key; where the key has several values, or none, it is as it is."""
        case = gfb.Case(SMALL)
        self.assertEqual(share_of(case, "bearing%clearance", 0.05*case["bearing%clearance"]), "5 %")
        self.assertEqual(share_of(case, "operation%load", 0.5), "0.5")
        self.assertEqual(share_of(case, "bump_foil%height", 1.0e-5), "1e-05")

    def test_pictures_in_time(self):
        """No picture of a part is begun after its time, and what is left out is said."""
        result = gfb.run(gfb.Case(SMALL), self.folder)
        given, said = [], []

        def drawn(_, __, seconds):
            given.append(seconds)
            time.sleep(0.6)
            return "picture"

        with unittest.mock.patch.multiple("gfb.report.main", drawn=drawn, say=said.append, AT_ONCE=1):
            self.assertEqual(len(report.read_run(result.stem, None, seconds=1)["pictures"]), 2)
        self.assertTrue(0.0 < given[1] < 0.5 < given[0] <= 1.0, given)
        self.assertIn("1 of 3 pictures are left out", said[-1])
        self.assertIsNone(report.drawn([f"{result.stem}.film.vtkhdf"], self.folder/"late.png", 0.01))
        with unittest.mock.patch.multiple("gfb.report.main", drawn=lambda _, picture, __: picture.name, say=said.append, AT_ONCE=3):
            pictures = report.read_run(result.stem, None, seconds=60)["pictures"]
        self.assertEqual([name for _, name in pictures], ["1.png", "2.png", "3.png"], "in their order, each in a file of its own")

    def test_time_of_a_tilt(self):
        point = {"factorizations": 30.0, "wall_time": 18.0}
        self.assertEqual(tilt_words(gfb.Case(SMALL), point), "", "a rigid bearing takes no time")
        sectors = {"bearing": {"kind": "thrust"}, "pads": {"count": 6}, "model": {"foil": "shell"}}
        for groups, words in (({"model": {"foil": "shell"}}, ": 1.2 to 16 min"), (sectors, ": 3.6 to 48 min")):
            self.assertIn(words, tilt_words(gfb.Case(groups), point))

    def test_words_of_a_study(self):
        """Before a part: what it does, and a time that is scaled from this call's states or not there."""
        said = []
        progress = Progress(4, said.append, 90, pause=0.05)
        first, second, search = (Part(name, name, states=states, work="work") for name, states in (("one", 1), ("twelve", 12), ("search", 0)))
        progress.begin(first)
        progress.at_work["one"] -= 3.0  # so long ago
        with progress.watching():
            time.sleep(0.2)
        self.assertIn("at work: one for 3", said[1])
        progress.end(first)
        progress.begin(second)
        progress.begin(search)
        with progress.watching():
            time.sleep(0.1)
        at_work = said[-1]
        lines = [line for line in said if not line.startswith("at work")]
        self.assertEqual(lines[0], "1 of 4 begins: one: work; how long is not known yet; its limit is 90 s")
        self.assertRegex(lines[1], "^one: done after 3.* s$")
        minutes = re.search(r"about (\d+) s, as one state took 3\.(\d) s so far", lines[2])
        self.assertAlmostEqual(float(minutes[1]), 12.0*(3.0 + 0.1*float(minutes[2])), delta=0.7)
        self.assertRegex(at_work, f"^at work: twelve for .* s of about {minutes[1]} s, search for [^ ]* s$")
        self.assertIn("how long is not known", lines[3])
        self.assertRegex(progress.so_far("twelve", 60.0), f"^twelve for 60 s, longer than the {minutes[1]} s it was thought to take$")
        self.assertEqual(progress.expected(Part("whirl_1", "alone", states=7)), "how long is not known yet", "a bearing alone is no machine")

    def test_study_that_is_stopped(self):
        """A part that its limit stops has its last state, and goes on from there."""
        case, stem, times = gfb.Case.template("transient"), self.folder/"part", []
        case["transient%turns"] = 20.0
        for _ in range(2):
            seconds, last = 1, times[-1][-1] if times else 0.0
            reached = last
            while reached <= last and seconds < 60:  # a busy machine has taken no step yet after two
                seconds *= 2
                part = Part("orbit", "orbit", case)
                result = computed(part, case, stem, None, Progress(1, str, seconds))
                if result is not None:
                    with h5py.File(f"{result.stem}.h5") as file:
                        reached = file["transient/time"][-1]
            self.assertIn(f"limit of {seconds} s", part.stopped)
            with h5py.File(f"{result.stem}.h5") as file:
                times.append(file["transient/time"][...])
        self.assertGreater(times[1][-1], times[0][-1])
        self.assertEqual(list(times[1][:len(times[0])]), list(times[0]))
        # A program that is always stopped, with nothing to show, and that takes no restart file: it is asked to go on, then to begin.
        nothing = self.folder/"gfb"
        nothing.write_text("#!/bin/sh\n[ $# = 1 ] && echo gfb && exit\necho \"$@\" >>\"$0.said\"\n"
                           "case $* in *--restart*) exit 1 ;; esac\nexit 124\n", encoding="utf-8")
        nothing.chmod(0o755)
        part = Part("orbit", "orbit", case)
        (self.folder/"other.restart.h5").touch()
        self.assertIsNone(computed(part, case, self.folder/"other", nothing, Progress(1, str, 2)))
        calls = pathlib.Path(f"{nothing}.said").read_text(encoding="utf-8").splitlines()
        self.assertEqual(["--restart" in one for one in calls], [True, False])
        self.assertTrue(all("--time-limit 2 " in one for one in calls))
        self.assertEqual(rows_of([part, Part("whirl", "whirl", case)], {})[:2],
                         [("orbit", "stopped by its limit of 2 s", "before there was a state; another call goes on", True),
                          ("whirl", "not computed yet", "", False)])

    def test_sectors(self):
        case = gfb.Case.template("thrust")
        case["scene%analysis"] = "equilibrium"
        film = gfb.run(case, self.folder, "thrust").film
        self.assertEqual(film.gap.dims, ("theta", "radius"))
        self.assertAlmostEqual(float(film.radius[-1]), case["bearing%outer_radius"], delta=1e-12)
        self.assertEqual(set(film["pad"].values.ravel()), set(range(1, int(case["pads%count"]) + 1)))

    def test_no_answer(self):
        case = gfb.Case(SMALL)
        case["operation%load"] = (-1.0e9, 0.0)
        result = gfb.run(case, self.folder)
        self.assertFalse(result.converged)
        self.assertIn("unconverged", result.stem.name)

    def test_case(self):
        case = gfb.Case(SMALL)
        self.assertEqual(gfb.Case.parse(str(case)), case)
        self.assertIn("in order", case.check())
        case["bearing%clearence"] = 1.0e-5
        with self.assertRaisesRegex(gfb.CaseError, "did you mean 'clearance'"):
            case.check()
        with self.assertRaises(gfb.CaseError):
            gfb.run(case, self.folder)
        with self.assertRaises(KeyError):
            case["clearance"] = 1.0
        for analysis in ("equilibrium", "strip"):
            self.assertIn("in order", gfb.Case.template(analysis).check(strict=True))
        with self.assertRaisesRegex(gfb.CaseError, "no such analysis"):
            gfb.Case.template("nonsense")

    def test_a_case_is_a_mapping(self):
        case = gfb.Case(SMALL | {"Rotor": {"MASS": 1.0, "bearing_distance": None}, "sweep": None})
        self.assertIsInstance(case, collections.abc.MutableMapping)
        self.assertEqual(len(case), len(list(case)))
        self.assertEqual(case["rotor%mass"], case.get("Rotor%Mass"))
        self.assertEqual([key in case for key in ("rotor%mass", "ROTOR%MASS", "sweep%values", "rotor%bearing_distance", "rotor", "rotor%", "", 3)],
                         [True, True] + 6*[False])
        self.assertIsNone(case.get("rotor"))
        self.assertNotIn("sweep", case.groups)
        self.assertEqual(dict(case)["bearing%radius"], 0.02)
        case.update({"rotor%mass": 2.0}, **{"gas%temperature": 300.0})
        self.assertEqual((case.pop("rotor%mass"), case.pop("rotor%mass", 5.0), case.setdefault("gas%temperature", 1.0)), (2.0, 5.0, 300.0))
        self.assertIn("rotor", case.groups)  # an empty group is one that is asked for
        for wrong in ("rotor%mass", "novel%key", "radius", 3):
            with self.assertRaisesRegex(KeyError, str(wrong)):
                case[wrong]
            with self.assertRaises(KeyError):
                del case[wrong]
        turned = gfb.Case({group: dict(reversed(keys.items())) for group, keys in reversed(case.groups.items())})
        self.assertEqual(turned, case)
        self.assertNotEqual(turned, dict(case))
        turned["bearing%radius"] += 1.0e-12
        self.assertNotEqual(turned, case)
        case.clear()
        self.assertEqual((len(case), str(case)), (0, ""))

    def test_values_of_numpy(self):
        case = gfb.Case(SMALL)
        case["operation%load"] = numpy.array([-20.0, 0.0])
        case["mesh%axial_elements"], case["bearing%radius"] = numpy.int64(8), numpy.float64(0.02)
        self.assertEqual(case, gfb.Case(SMALL))
        self.assertEqual(str(gfb.Case({"a": {"b": numpy.bool_(True), "c": numpy.float32(0.5)}})), "&a\n  b = .true.\n  c = 0.5\n/\n")
        for wrong in (None, {1: 2}, {1.0}, object()):
            case["bearing%radius"] = wrong
            with self.assertRaisesRegex(TypeError, "no value of a case file"):
                str(case)

    def test_keys_of_the_program(self):
        keys = read_keys(find_program())
        self.assertEqual([keys[name].unit for name in ("bearing%clearance", "operation%speed_rpm", "gas%viscosity", "model%foil")],
                         ["m", "rpm", "Pa s", ""])
        echo = gfb.Case.read(gfb.run(gfb.Case(SMALL), self.folder).stem.with_suffix(".used.nml"))
        self.assertEqual([key for key in echo if key not in keys], [])

    def test_every_input_is_read_as_the_program_does(self):
        for path in sorted((ROOT/"inputs").glob("*.nml")):
            with self.subTest(path.name):
                case = gfb.Case.read(path)
                self.assertEqual(gfb.Case.parse(str(case)), case)
                self.assertIn("scene%analysis", case)
        values = gfb.Case.parse("&a b=3*1.0 c=.true., f d='x!/&' ! no\n e=1d-3 /")
        self.assertEqual(values.groups["a"], {"b": (1.0, 1.0, 1.0), "c": (True, False), "d": "x!/&", "e": 1.0e-3})

    def test_a_machine_runs_in_any_folder(self):
        case = gfb.Case.read(ROOT/"inputs/machines/rotor.nml")
        self.assertTrue(all(pathlib.Path(file).is_file() for file in case["bearings%files"]))
        case["scene%analysis"] = "equilibrium"
        for group in ("dynamics", "unbalance"):
            del case.groups[group]
        answer = gfb.run(case, self.folder)
        self.assertGreater(answer["minimum_gap_2"], 5.0e-6)

    def test_study(self):
        values = {"bearing%clearance": [2.0e-5, 2.5e-5], "operation%speed_rpm": [20000.0, 24000.0]}
        first = gfb.study(gfb.Case(SMALL), values, self.folder)
        self.assertEqual(first.minimum_gap.shape, (2, 2))
        self.assertEqual(first.minimum_gap.units, "m")
        self.assert_units(first)
        self.assertEqual([first[key].units for key in values], ["m", "rpm"])
        self.assertTrue((first.status == 0).all() and numpy.isfinite(first.minimum_gap).all())
        before = {path: path.stat().st_mtime_ns for path in self.folder.glob("*.summary")}
        again = gfb.study(gfb.Case(SMALL), values, self.folder)
        self.assertTrue(first.equals(again))
        self.assertEqual(before, {path: path.stat().st_mtime_ns for path in self.folder.glob("*.summary")})
        loads = gfb.study(gfb.Case(SMALL), {"operation%load": [(-20.0, 0.0), [0.0, -20.0]]}, self.folder, "loads")
        self.assertEqual((loads["operation%load"].values.tolist(), loads["operation%load"].units), ([(-20.0, 0.0), (0.0, -20.0)], "N"))
        self.assertTrue(numpy.isfinite(loads.minimum_gap).all())

    def test_study_starts_the_program_twice(self):
        """One call checks all members, one computes those that are missing; members without an answer are told."""
        counted, calls = self.folder/"counted", self.folder/"calls"
        counted.write_text(f'#!/bin/sh\n[ "$1" = --version ] || [ "$1" = --keys ] || echo "$#" >> "{calls}"\nexec "{find_program()}" "$@"\n', encoding="utf-8")
        counted.chmod(0o755)
        case, values = gfb.Case(SMALL), {"bearing%clearance": [2.0e-5, 9.0e-4], "operation%speed_rpm": [2.0e4, 2.2e4]}
        first = gfb.study(case, values, self.folder, gfb=counted)
        self.assertEqual(len(calls.read_text(encoding="utf-8").split()), 2)
        self.assertEqual(first.status.values.tolist(), [[0, 0], [2, 2]])
        (self.folder/"study_0002.h5").unlink()
        self.assertTrue(gfb.study(case, values, self.folder, gfb=counted).minimum_gap.equals(first.minimum_gap))
        self.assertEqual(len(calls.read_text(encoding="utf-8").split()), 4)
        self.assertEqual([path.name for path in self.folder.glob("*.batch*")], [])

    def test_a_study_that_was_stopped_goes_on(self):
        """Its first call is sent SIGINT at the second point of its first member: neither that member nor the next one has no answer."""
        stopped = self.folder/"stopped"
        stopped.write_text(f'''#!/usr/bin/env bash
set -m # or the shell has its children ignore SIGINT
case "$*" in *--check*|*--version*) exec "{find_program()}" "$@";; esac
[ -e "{self.folder}/once" ] && exec "{find_program()}" "$@"
touch "{self.folder}/once"
"{find_program()}" "$@" &
until grep -qs " point 2 of" "{self.folder}/study_0001.log"; do kill -0 $! || break; sleep 0.01; done
kill -INT $!
wait $!
''', encoding="utf-8")
        stopped.chmod(0o755)
        case, values = gfb.Case(SMALL), {"bearing%clearance": [2.0e-5, 2.5e-5]}
        case["sweep%parameter"], case["sweep%values"] = "load", [10.0 + i % 30 for i in range(150)]
        with self.assertRaisesRegex(gfb.RunError, "another call computes the rest") as raised:
            gfb.study(case, values, self.folder, gfb=stopped)
        self.assertEqual(raised.exception.status, 130)
        words = gfb.results.read_summary(self.folder/"study_0001.unconverged.summary")[0]
        self.assertEqual((words["outcome"], words["reason"].split(" after")[0]), ("stopped", "stopped by SIGINT"))
        self.assertIn(f"program = {words['program']}\n", (self.folder/"study_0001.unconverged.summary").read_text(encoding="utf-8"))
        with h5py.File(self.folder/"study_0001.unconverged.h5") as file:
            self.assertEqual(file["summary/outcome"][()].decode(), "stopped")
        table = gfb.study(case, values, self.folder, gfb=stopped)
        self.assertEqual(table.status.values.tolist(), [0, 0])
        self.assertTrue(numpy.isfinite(table.minimum_gap).all())

    def test_answers_of_another_program(self):
        """They are not taken for this one's: computed again, and said; nor is what an interrupted run of another case has left."""
        newer = self.folder/"newer"
        newer.write_text(f'#!/bin/sh\n[ "$1" = --version ] && exec echo "gfb 99.0 (abc), of a test"\nexec "{find_program()}" "$@"\n', encoding="utf-8")
        newer.chmod(0o755)
        case, values = gfb.Case(SMALL), {"bearing%clearance": [2.0e-5, 2.5e-5]}
        first = gfb.study(case, values, self.folder)
        with self.assertWarnsRegex(UserWarning, r"2 results of gfb \S+ \(.*\) are computed again by gfb 99.0 \(abc\)"):
            gfb.study(case, values, self.folder, gfb=newer)
        rigid = gfb.compare_models(case, ("rigid",), self.folder)
        with self.assertWarnsRegex(UserWarning, "models_rigid: there is a result of gfb .* computed again by gfb 99.0"):
            gfb.compare_models(case, ("rigid",), self.folder, gfb=newer)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gfb.compare_models(case, ("rigid",), self.folder)
            self.assertTrue(gfb.study(case, values, self.folder).minimum_gap.equals(first.minimum_gap))
        other = gfb.Case(SMALL | {"operation": {"speed_rpm": 20000.0, "load": (-30.0, 0.0)}})
        other.write(self.folder/"models_rigid.nml")  # a run of this case was killed before its end
        self.assertNotEqual(float(gfb.compare_models(other, ("rigid",), self.folder).data.minimum_gap[0]), float(rigid.data.minimum_gap[0]))

    def test_what_is_no_result(self):
        (self.folder/"bad.h5").write_bytes(b"no HDF5")
        with self.assertRaises(Unreadable):
            gfb.read(self.folder/"bad.h5")
        with self.assertRaises(FileNotFoundError):
            gfb.read(self.folder/"none.h5")


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
