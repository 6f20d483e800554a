#!/usr/bin/env python3
"""gfb.optimize: optima that are known otherwise, kinks, cases without an answer, elements of lists, runs that are there already."""

import importlib.util
import math
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]/"tools"))
import gfb  # noqa: E402
from gfb import bundle  # noqa: E402

HAS_SCIPY = importlib.util.find_spec("scipy") is not None
NO_SCIPY = "SciPy is not installed (python3-scipy)"
RIGID = {"scene": {"analysis": "equilibrium"},
         "bearing": {"radius": 0.02, "length": 0.04, "clearance": 2.0e-5},
         "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5},
         "operation": {"speed_rpm": 20000.0, "load": (-20.0, 0.0)},
         "model": {"foil": "rigid"}, "mesh": {"circumferential_elements": 48, "axial_elements": 8}}
# A program whose power_loss is the sum of (value - target)^2 over a list. No answer where the first value is below 2, and a rule where it is
# above 8; no derivative where it is above 7.
STUB = """#!{python}
import pathlib, re, sys
if "--version" in sys.argv:
    sys.exit(print("gfb stub (x), of a test"))
if "--keys" in sys.argv:
    sys.exit(print("| group | key | type | unit | default | meaning |\\n| --- | --- | --- | --- | --- | --- |\\n| `&list` | `values` | list of reals | m | required | some |"))
path = pathlib.Path(sys.argv[-1])
with open({calls!r}, "a") as calls:
    calls.write(path.stem + "\\n")
targets = {targets!r}
values = [float(word) for word in re.search("values *= *(.*)", path.read_text())[1].split(",")]
stem = path.with_suffix("")

def keep(ending, *outcome):
    # What tells whose answer of which case it is.
    if {kept!r}:
        import h5py
        with h5py.File(f"{{stem}}{{ending}}.h5", "w") as file:
            for name, word in zip(("scene/case_file", "provenance/program_version", "provenance/commit", "summary/outcome"),
                                  (path.read_text(), "stub", "x", *outcome)):
                file[name] = word
            file.require_group("summary")

if values[0] > 8.0:
    sys.exit("case.nml:1: &list: values must be below 8") if "--check" not in sys.argv else sys.exit(1)
if values[0] < 2.0:
    pathlib.Path(f"{{stem}}.unconverged.summary").write_text("converged = false\\n")
    keep(".unconverged", "refused")
    sys.exit(2)
lines = [f"power_loss = {{sum((v - t)**2 for v, t in zip(values, targets))!r}} [W]"]
if values[0] <= 7.0:
    lines += [f"d_power_loss_d_list_values_{{i + 1}} = {{2.0*(v - t)!r}} [W]" for i, (v, t) in enumerate(zip(values, targets))]
pathlib.Path(f"{{stem}}.summary").write_text("".join(line + "\\n" for line in lines))
keep("")
pathlib.Path(f"{{stem}}.used.nml").write_text("&list\\n  values = 1.0 ! [m] some\\n/\\n&mesh\\n/\\n")
"""


def from_functions(objective, *constraints):
    """A function of the search from functions that give value and gradient."""
    def told(place):
        found = [one(*place) for one in (objective, *constraints)]
        return numpy.array([value for value, _ in found]), numpy.array([gradient for _, gradient in found])
    return told


def last_best(function, start, tolerance=1.0e-6):
    """The best place that a search has tried, of those that break no constraint, and how often it tried."""
    tried = []

    def told(place):
        found = function(place)
        tried.append((place, found))
        return found
    bundle.minimise(told, numpy.array(start), tolerance)
    kept = [(found[0][0], *place) for place, found in tried if found is not None and bundle.worst(found[0]) <= 10.0*tolerance]
    return min(kept), len(tried)


@unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
class Bundle(unittest.TestCase):
    def test_along_a_kink_that_is_bent(self):
        """2 |y - x^2| + (x - 0.7)^2 is not convex and least at (0.7, 0.49), at its kink."""
        def objective(x, y):
            side = math.copysign(2.0, y - x**2)
            return side*(y - x**2) + (x - 0.7)**2, [-2.0*side*x + 2.0*(x - 0.7), side]
        (value, x, y), tried = last_best(from_functions(objective), [0.1, 0.9])
        self.assertLess(value, 1.0e-4)
        self.assertAlmostEqual(x, 0.7, delta=1.0e-2)
        self.assertAlmostEqual(y, 0.49, delta=1.5e-2)
        self.assertLess(tried, 100)

    def test_a_corner_of_many_kinks(self):
        """The largest of |x_i - a_i| is least at a; only one of its slopes is seen at a time."""
        target = numpy.linspace(0.2, 0.8, 6)

        def objective(*place):
            away = numpy.array(place) - target
            most = int(numpy.argmax(abs(away)))
            return abs(away[most]), numpy.sign(away)*(numpy.arange(6) == most)
        (value, *_), tried = last_best(from_functions(objective), numpy.full(6, 0.5), 1.0e-5)
        self.assertLess(value, 1.0e-3)
        self.assertLess(tried, 60)

    def test_constraint(self):
        """x + y with x y not below 1/4: one, at (1/2, 1/2); from inside, and from where the constraint is broken."""
        function = from_functions(lambda x, y: (x + y, [1.0, 1.0]), lambda x, y: (0.25 - x*y, [-y, -x]))
        for start in ([0.9, 0.8], [0.1, 0.2]):
            with self.subTest(start):
                (value, x, y), _ = last_best(function, start, 1.0e-5)
                self.assertAlmostEqual(value, 1.0, delta=1.0e-3)
                self.assertAlmostEqual(x, y, delta=5.0e-2)

    def test_no_answer_is_stepped_back_from(self):
        """x is least at 0.6, below which there is no answer."""
        told = from_functions(lambda x, y: (x, [1.0, 0.0]))
        (value, *_), tried = last_best(lambda place: told(place) if place[0] >= 0.6 else None, [0.9, 0.5])
        self.assertAlmostEqual(value, 0.6, delta=1.0e-3)
        with self.assertRaisesRegex(ValueError, "no answer at the start"):
            bundle.minimise(lambda place: None, numpy.array([0.5]), 1.0e-6)


class Optimize(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.said = []

    def optimize(self, case, **words):
        """A search that says nothing aloud."""
        return gfb.optimize(case, folder=self.folder, tell=self.said.append, **words)

    def stub(self, targets, kept=False):
        """The program STUB, and where its calls are written; kept: its answers are found again."""
        path, self.calls = self.folder/"stub", self.folder/"calls"
        path.write_text(STUB.format(python=sys.executable, calls=str(self.calls), targets=targets, kept=kept), encoding="utf-8")
        path.chmod(0o755)
        return path

    def called(self):
        """How often the program was called."""
        return len(self.calls.read_text(encoding="utf-8").split())

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_shape_of_the_largest_drag(self):
        """The drag of a concentric shaft is in proportion to R^3 L: with R + L given it is largest at R = 3/4 of the sum."""
        case = gfb.Case(RIGID | {"scene": {"analysis": "fixed_position"}, "operation": {"speed_rpm": 1000.0, "eccentricity": (0.0, 0.0)}})

        def radius_and_length(case):
            return case["bearing%radius"] + case["bearing%length"]
        words = {"maximize": "friction_torque", "subject_to": {radius_and_length: (None, 0.06)},
                 "vary": {"bearing%radius": (0.02, 0.055), "bearing%length": (0.01, 0.04)}}
        for method, tolerance in {"bundle": 1.0e-4, "SLSQP": 1.0e-6}.items():
            with self.subTest(method):
                found = self.optimize(case, method=method, name=method, tolerance=tolerance, **words)
                self.assertAlmostEqual(found.case["bearing%radius"]/0.045, 1.0, delta=math.sqrt(tolerance))
                self.assertLessEqual(radius_and_length(found.case)/0.06, 1.0 + tolerance)
                drag = 2.0e-5*1000.0*math.pi/30.0*2.0*math.pi*0.045**3*0.015/2.0e-5
                for row in (*found.results[:1], *found.finer[:1]):
                    self.assertAlmostEqual(row.after/drag, 1.0, delta=1.0e-3)
                self.assertEqual(found.active, ["radius_and_length"])
                self.assertTrue(found.within)
                self.assertLess(len(found.runs), 60)

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_largest_load_is_the_load_capacity(self):
        """The largest load with a film is what analysis = 'load_capacity' finds by its own search."""
        case = gfb.Case(RIGID)

        def load(case):
            return math.hypot(*case["operation%load"])
        found = self.optimize(case, maximize=load, subject_to={"minimum_gap": (6.0e-6, None)}, vary={"operation%load": (10.0, 400.0)}, finer={})
        capacity = gfb.Case(RIGID | {"scene": {"analysis": "load_capacity"}, "capacity": {"smallest_gap": 6.0e-6}})
        wanted = gfb.run(capacity, self.folder, "capacity")["load_capacity"]
        self.assertAlmostEqual(load(found.case)/wanted, 1.0, delta=1.0e-3)
        self.assertEqual(found.case["operation%load"][1], 0.0)
        self.assertEqual((found.active, found.finer), (["minimum_gap"], []))

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_critical_mass_as_a_bound_and_as_the_objective(self):
        """Less clearance carries more and loses more: the least loss has the mass that is asked for, the largest mass the least clearance."""
        case = gfb.Case(RIGID | {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequency_ratios": 0.5}})
        vary = {"bearing%clearance": (1.5e-5, 4.0e-5)}
        found = self.optimize(case, minimize="power_loss", subject_to={"critical_mass": (0.9, None)}, vary=vary, finer={})
        self.assertEqual(found.active, ["critical_mass"])
        self.assertAlmostEqual(gfb.run(found.case, self.folder, "plain")["critical_mass"]/0.9, 1.0, delta=2.0e-3)
        largest = self.optimize(case, maximize="critical_mass", vary=vary, finer={}, name="largest")
        self.assertEqual(largest.active, ["bearing%clearance"])
        self.assertGreater(largest.results[0].after, 1.2)

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_stress_as_a_bound(self):
        """The thickest film with less stress in thinner bumps: the bound is reached, and a plain run has the same stress."""
        sheet = {"thickness": 1.02e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29}
        case = gfb.Case(RIGID | {
            "bearing": {"radius": 0.0095, "length": 0.019, "clearance": 2.0e-5}, "operation": {"speed_rpm": 40000.0, "load": (-14.0, 2.0)},
            "top_foil": sheet, "bump_foil": {**sheet, "half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3, "bumps": 13},
            "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}, "model": {"foil": "beam"},
            "mesh": {"circumferential_elements": 52, "axial_elements": 4, "arc_elements": 4, "flat_elements": 2}})
        name = "maximum_bump_foil_stress"
        bound = 0.9*gfb.run(case, self.folder, "before")[name]
        found = self.optimize(case, maximize="minimum_gap", subject_to={name: (None, bound)}, finer={}, most_runs=25,
                              vary={"bump_foil%thickness": (0.06e-3, 0.14e-3), "top_foil%thickness": (0.08e-3, 0.14e-3)})
        self.assertIn(name, found.active)
        self.assertTrue(found.within)
        self.assertAlmostEqual(gfb.run(found.case, self.folder, "plain")[name]/bound, 1.0, delta=2.0e-3)
        self.assertIn("MPa", found.table())

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_elements_of_a_list(self):
        """Each by itself, (:), and two that share a value, which is then the mean of their targets."""
        program = self.stub((3.0, 5.0, 4.0, 1.0))
        case = gfb.Case({"list": {"values": (6.0, 6.0, 6.0, 6.0)}})
        alone = self.optimize(case, minimize="power_loss", vary={"list%values(:)": (2.0, 8.0)}, tolerance=1.0e-6, gfb=program)
        numpy.testing.assert_allclose(alone.case["list%values"], (3.0, 5.0, 4.0, 2.0), atol=2.0e-2)
        self.assertEqual(alone.active, ["list%values(4)"])
        self.assertEqual([row.unit for row in alone.variables], 4*["m"])
        together = self.optimize(case, minimize="power_loss", vary={"list%values(1), list%values(3)": (2.0, 8.0)}, tolerance=1.0e-6, gfb=program)
        numpy.testing.assert_allclose(together.case["list%values"], (3.5, 6.0, 3.5, 6.0), atol=2.0e-2)

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_no_answer(self):
        """The optimum is where there is none: the search ends before it, and never takes such a run for a number."""
        program = self.stub((1.0, 5.0))
        case = gfb.Case({"list": {"values": (6.0, 6.0)}})
        for method in ("bundle", "SLSQP"):
            with self.subTest(method):
                found = self.optimize(case, minimize="power_loss", vary={"list%values(:)": (1.0, 7.0)}, tolerance=1.0e-3, method=method,
                                      name=method, gfb=program)
                self.assertGreater(found.no_answer, 0)
                self.assertGreaterEqual(found.case["list%values"][0], 2.0)
                self.assertTrue(any("no answer" in words for words in self.said))
                self.assertLess(found.results[0].after, 0.3*found.results[0].before)
        bound = self.optimize(case, minimize="power_loss", vary={"list%values(:)": (1.0, 7.0)}, gfb=program)
        self.assertLess(bound.case["list%values"][0], 2.1)

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_a_rule_and_a_missing_derivative_are_no_answers(self):
        program = self.stub((30.0, 5.0))
        case = gfb.Case({"list": {"values": (6.0, 6.0)}})
        found = self.optimize(case, minimize="power_loss", vary={"list%values(:)": (2.0, 12.0)}, gfb=program)
        self.assertGreater(found.case["list%values"][0], 6.9)
        self.assertLessEqual(found.case["list%values"][0], 7.0)
        words = {run.words.split("&list: ")[-1] for run in found.runs}
        self.assertLessEqual({"values must be below 8", "no derivative: d_power_loss_d_list_values_1"}, words)

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_called_again_nothing_runs_again(self):
        program = self.stub((3.0, 5.0), kept=True)
        case, words = gfb.Case({"list": {"values": (6.0, 6.0)}}), {"minimize": "power_loss", "vary": {"list%values(:)": (1.0, 7.0)}}
        few = self.optimize(case, **words, most_runs=3, gfb=program)
        self.assertEqual((len(few.runs), few.computed, few.ending), (3, 3, "after 3 runs"))
        first = self.optimize(case, **words, gfb=program)
        self.assertEqual(first.computed, len(first.runs) - 3)
        before = self.called()
        again = self.optimize(case, **words, gfb=program)
        self.assertEqual((again.computed, self.called()), (0, before))
        self.assertEqual(again.case, first.case)
        self.assertIn(f"{len(first.runs)} runs, {first.no_answer} without an answer, 0 computed now", again.table())
        rows = (self.folder/"optimize.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual((len(rows), rows[0]), (len(first.runs) + 1, "run,files,list%values(1),list%values(2),power_loss"))

    @unittest.skipUnless(HAS_SCIPY, NO_SCIPY)
    def test_what_is_asked_for_wrongly(self):
        case = gfb.Case(RIGID)
        vary = {"bearing%clearance": (1.0e-5, 4.0e-5)}
        for reason, words in {
                "one of minimize and maximize": {"vary": vary},
                "method = 'trust-constr'": {"minimize": "power_loss", "vary": vary, "method": "trust-constr"},
                "nothing is varied": {"minimize": "power_loss", "vary": {}},
                "starts at 2e-05": {"minimize": "power_loss", "vary": {"bearing%clearance": (3.0e-5, 4.0e-5)}},
                "must stand in the case": {"minimize": "power_loss", "vary": {"bump_foil%height": (1.0e-4, 4.0e-4)}},
                "must be group%key": {"minimize": "power_loss", "vary": {"clearance": (1.0e-5, 4.0e-5)}},
                "must be a number": {"minimize": "power_loss", "vary": {"scene%analysis": (0.0, 1.0)}},
                "the case has 2 values": {"minimize": "power_loss", "vary": {"operation%load(3)": (0.0, 1.0)}},
                "needs analysis = 'linear_dynamics' and &dynamics": {"maximize": "critical_mass", "vary": vary},
                "no_such_result": {"minimize": "no_such_result", "vary": vary}}.items():
            with self.subTest(reason), self.assertRaisesRegex(gfb.CaseError, reason):
                self.optimize(case, **words)
        case["sweep%parameter"], case["sweep%values"] = "load", (20.0, 30.0)
        with self.assertRaisesRegex(gfb.CaseError, "&sweep"):
            self.optimize(case, minimize="power_loss", vary=vary)
        del case.groups["sweep"]
        case["operation%load"] = (0.0, 0.0)
        with self.assertRaisesRegex(gfb.CaseError, "no direction"):
            self.optimize(case, minimize="power_loss", vary={"operation%load": (0.0, 40.0)})
        program = self.stub((3.0, 5.0))
        words = {"vary": {"list%values(:)": (1.0, 7.0)}, "gfb": program}
        with self.assertRaisesRegex(gfb.CaseError, "is no start: no answer"):
            self.optimize(gfb.Case({"list": {"values": (1.0, 6.0)}}), minimize="power_loss", **words)
        with self.assertRaisesRegex(gfb.CaseError, "is no start: the answer has no critical_mass"):
            self.optimize(gfb.Case({"list": {"values": (6.0, 6.0)}}), minimize="critical_mass", **words)

    def test_without_scipy(self):
        with unittest.mock.patch.dict(sys.modules, {"scipy": None, "scipy.optimize": None}), \
                self.assertRaisesRegex(ImportError, "gfb.optimize: .*scipy.*pip install scipy, or apt-get install python3-scipy"):
            self.optimize(gfb.Case(RIGID), minimize="power_loss", vary={"bearing%clearance": (1.0e-5, 4.0e-5)})


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
