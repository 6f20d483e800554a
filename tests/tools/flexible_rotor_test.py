#!/usr/bin/env python3
"""Bearings for flexible shafts of ROSS: gfb.ross_bearings and gfb.ross_modes, on made-up files, with a stand-in for ROSS and, where it is
installed, with ROSS itself."""

import contextlib
import importlib.util
import math
import os
import pathlib
import sys
import tempfile
import types
import unittest
import warnings

import h5py
import numpy

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
sys.path.insert(0, str(PROJECT/"tools"))
import gfb  # noqa: E402 (found only now)
from gfb.results import Unreadable  # noqa: E402

RPM = numpy.array([3000.0, 1500.0])
SPEED = RPM*math.pi/30.0
FREQUENCY = numpy.array([50.0, 100.0, 200.0, 400.0, 500.0])*math.pi  # 1500 and 3000 rpm are the first two
STIFFNESS = 1.0e6 + 1.0e5*numpy.arange(80.0).reshape(5, 4, 4)
DAMPING = 10.0*numpy.cos(numpy.arange(80.0)).reshape(5, 4, 4)
SCIPY = importlib.util.find_spec("scipy") is not None  # ROSS needs it
VERSIONS = ("2.3.0", "3.1.0") if SCIPY else ("3.1.0",)


def stand_in(version):
    """A module whose elements keep what they were given, with tables of one or two axes as that version of ROSS has."""
    module = types.ModuleType("ross")
    module.__version__ = version

    class BearingElement:
        def __init__(self, n, kxx, cxx, frequency=None, tag=None, **others):
            if version.startswith("2.") and "speed" in others:
                raise TypeError("ROSS 2 has no axis over the speed")
            self.n, self.kxx, self.cxx, self.frequency, self.tag = n, kxx, cxx, frequency, tag
            self.__dict__.update(others)

    module.BearingElement = BearingElement
    return module


@contextlib.contextmanager
def imported_as_ross(module):
    """Makes `import ross` give a module; other modules that are imported meanwhile stay, as most cannot be twice."""
    before = sys.modules.get("ross")
    sys.modules["ross"] = module
    try:
        yield
    finally:
        del sys.modules["ross"]
        if before is not None:
            sys.modules["ross"] = before


class OneMass:
    """What ross_modes asks of a rotor, for a mass on one bearing, with a gyroscopic coupling of x and y."""

    number_dof = 2

    def __init__(self, frequency, stiffness, damping, coupling):
        self.bearing_elements = [types.SimpleNamespace(frequency=numpy.array(frequency)), types.SimpleNamespace(frequency=None)]
        self.stiffness, self.damping, self.coupling = stiffness, damping, coupling

    def A(self, speed, frequency=None):  # noqa: N802 (ROSS's name)
        force = -self.stiffness(frequency)*numpy.eye(2), -self.damping*numpy.eye(2) - speed*self.coupling*numpy.array([[0.0, 1.0], [-1.0, 0.0]])
        return numpy.block([[numpy.zeros((2, 2)), numpy.eye(2)], [force[0], force[1]]])


class MadeUpFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def sweep(self, name, frequency=None, scale=1.0, parameter="speed_rpm"):
        """A made-up sweep, K and C of the second point three times those of the first."""
        with h5py.File(self.folder/name, "w") as file:
            file["dynamics/frequency"] = numpy.stack((FREQUENCY, FREQUENCY)) if frequency is None else frequency
            file[f"history/{parameter}"] = RPM
            file["dynamics/stiffness"], file["dynamics/damping"] = (numpy.stack((scale*one, 3.0*scale*one)) for one in (STIFFNESS, DAMPING))
        return self.folder/name

    def single(self, name, rpm, scale=1.0):
        """A made-up result of one speed."""
        with h5py.File(self.folder/name, "w") as file:
            file["dynamics/frequency"], file["dynamics/stiffness"], file["dynamics/damping"] = FREQUENCY, scale*STIFFNESS, DAMPING
            file["scene/case_file"] = f"&operation\n  speed_rpm = {rpm}\n/\n"
        return self.folder/name


class BearingsTest(MadeUpFiles):
    """What ROSS gets."""

    def bearings(self, *words, version="3.1.0", **more):
        """gfb.ross_bearings with a stand-in."""
        with imported_as_ross(stand_in(version)):
            return gfb.ross_bearings(*words, **more)

    def test_each_node_has_its_bearing(self):
        left, right = self.single("left.h5", 3000.0), self.single("right.h5", 3000.0, scale=2.0)
        for version in VERSIONS:
            made = self.bearings([left, types.SimpleNamespace(stem=self.folder/"right")], (4, 1), version=version)
            self.assertEqual([(one.n, one.tag) for one in made], [(4, "left at node 4"), (1, "right at node 1")])
            for one, scale in zip(made, (1.0, 2.0)):
                numpy.testing.assert_array_equal(one.frequency, FREQUENCY)
                for i, row in enumerate("xy"):
                    for j, column in enumerate("xy"):
                        numpy.testing.assert_array_equal(getattr(one, f"k{row}{column}"), scale*STIFFNESS[:, i, j])
                        numpy.testing.assert_array_equal(getattr(one, f"c{row}{column}"), DAMPING[:, i, j])
        equal = self.bearings(left, (0, 2))
        self.assertEqual([one.n for one in equal], [0, 2])
        numpy.testing.assert_array_equal(equal[0].kxy, equal[1].kxy)
        self.assertEqual([one.n for one in self.bearings(right, 7)], [7])

    @unittest.skipUnless(SCIPY, "SciPy is not installed")
    def test_splines_of_ross_2_pass_through_the_table(self):
        (one,) = self.bearings(self.single("one.h5", 3000.0), 0, version="2.3.0")
        numpy.testing.assert_allclose(one.cxy_interpolated(FREQUENCY), DAMPING[:, 0, 1], rtol=1.0e-12)
        self.assertFalse(hasattr(self.bearings(self.folder/"one.h5", 0)[0], "cxy_interpolated"))

    def test_sweep_at_one_speed(self):
        path = self.sweep("sweep.h5", numpy.stack((FREQUENCY, 2.0*FREQUENCY)))
        for rpm, scale, factor in ((3000.0, 1.0, 1.0), (1500.0, 3.0, 2.0)):
            (one,) = self.bearings(path, 0, speed_rpm=rpm)
            numpy.testing.assert_array_equal(one.frequency, factor*FREQUENCY)
            numpy.testing.assert_array_equal(one.kyx, scale*STIFFNESS[:, 1, 0])

    def test_whole_sweep_over_speed_and_frequency(self):
        path = self.sweep("sweep.h5")
        (one,) = self.bearings(path, 0)
        numpy.testing.assert_allclose(one.speed, SPEED[::-1], rtol=1.0e-15)  # rising
        numpy.testing.assert_array_equal(one.kyx, numpy.stack((3.0*STIFFNESS[:, 1, 0], STIFFNESS[:, 1, 0])))
        with self.assertRaisesRegex(ValueError, "one axis: say speed_rpm=.*synchronous=True"):
            self.bearings(path, 0, version="2.3.0")

    def test_synchronous_tables_are_over_the_speed(self):
        for frequency, places in ((None, (0, 1)), (numpy.outer(SPEED, [0.5, 1.0, 2.0, 3.0, 4.0]), (1, 1))):
            path = self.sweep("sweep.h5", frequency)
            for version in VERSIONS:
                (one,) = self.bearings(path, 0, synchronous=True, version=version)
                numpy.testing.assert_allclose(one.frequency if version[0] == "2" else one.speed, SPEED[::-1], rtol=1.0e-15)
                wanted = [3.0*DAMPING[places[0], 0, 1], DAMPING[places[1], 0, 1]]
                numpy.testing.assert_array_equal(one.cxy, wanted)
        with self.assertRaisesRegex(Unreadable, "vibrations at the speed, 1500 rpm: give frequency_ratios with 1.0"):
            self.bearings(self.sweep("none.h5", numpy.stack((FREQUENCY, FREQUENCY)) + 1.0), 0, synchronous=True)

    def test_wrong_calls_are_told(self):
        sweep, slow, fast = self.sweep("sweep.h5"), self.single("slow.h5", 1500.0), self.single("fast.h5", 3000.0)
        load = self.sweep("load.h5", parameter="load")
        lost = self.sweep("lost.h5", scale=numpy.nan)
        with h5py.File(self.folder/"none.h5", "w") as file:
            file["history/force_x"] = [1.0]
        for words, more, error, text in ((([slow, fast], (0, 1)), {}, ValueError, "different speeds: 1500, 3000 rpm"),
                                         (([sweep, fast], (0, 1)), {}, ValueError, "beside results of one speed"),
                                         (([slow, slow], (0, 1, 2)), {}, ValueError, "2 bearings for 3 nodes"),
                                         ((sweep, 0), {"speed_rpm": 2000.0}, Unreadable, "2000 rpm, only of 3000, 1500"),
                                         ((slow, 0), {"speed_rpm": 3000.0}, Unreadable, "3000 rpm, only of 1500"),
                                         ((load, 0), {}, Unreadable, "not over speed_rpm"),
                                         ((load, 0), {"synchronous": True}, Unreadable, "a sweep over speed_rpm"),
                                         ((slow, 0), {"synchronous": True}, Unreadable, "a sweep over speed_rpm"),
                                         ((sweep, 0), {"synchronous": True, "speed_rpm": 3000.0}, ValueError, "leave speed_rpm out"),
                                         ((lost, 0), {"speed_rpm": 3000.0}, Unreadable, "no answer at 3000 rpm"),
                                         ((self.folder/"none.h5", 0), {}, Unreadable, "linear_dynamics")):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                self.bearings(*words, **more)
        with self.assertRaises(FileNotFoundError):
            self.bearings(self.folder/"not_there.h5", 0)

    def test_thrust_bearing_and_no_answer_are_told(self):
        """What ROSS has no place for is said once, and why a run has no coefficients."""
        with h5py.File(self.folder/"thrust.h5", "w") as file:
            file["dynamics/frequency"] = FREQUENCY
            file["dynamics/stiffness"], file["dynamics/damping"] = STIFFNESS[:, :3, :3], DAMPING[:, :3, :3]
        for version in VERSIONS:
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                made = self.bearings(self.folder/"thrust.h5", (0, 1), version=version)
            numpy.testing.assert_array_equal(made[1].kzz, STIFFNESS[:, 0, 0])
            self.assertEqual(len(said), 1)
            self.assertRegex(str(said[0].message), "thrust: .*against a tilt of the runner are lost")
        with h5py.File(self.folder/"refused.h5", "w") as file:
            file["summary/outcome"], file["summary/reason"] = "refused", "the load is more than it carries"
        with self.assertRaisesRegex(Unreadable, r"^[^:]*refused.h5: there is no answer, .*\(refused: the load is more"):
            self.bearings(self.folder/"refused.h5", 0)

    def test_a_missing_ross_is_named_with_its_versions(self):
        for module, text in ((None, "ROSS is not here"), (types.ModuleType("ross"), "another one")):
            with imported_as_ross(module), self.assertRaises(ImportError) as caught:
                gfb.ross_bearings(self.folder/"a.h5", 0)
            for word in (text, "ross-rotordynamics==2.3.0", "plotly<6"):
                self.assertIn(word, str(caught.exception))

    def test_a_case_is_run_once(self):
        case = gfb.Case({"scene": {"analysis": "linear_dynamics"}, "bearing": {"radius": 0.02, "length": 0.04, "clearance": 2.0e-5},
                         "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5}, "operation": {"speed_rpm": 20000.0, "load": (-20.0, 0.0)},
                         "model": {"foil": "rigid"}, "mesh": {"circumferential_elements": 48, "axial_elements": 8},
                         "dynamics": {"frequency_ratios": (0.5, 1.0, 1.5, 2.0)}})
        (one,) = self.bearings(case, 3, folder=self.folder/"cases")
        numpy.testing.assert_allclose(one.frequency, 20000.0*math.pi/30.0*numpy.array([0.5, 1.0, 1.5, 2.0]), rtol=1.0e-12)
        written = (self.folder/"cases/bearing_1.h5").stat().st_mtime_ns
        (again,) = self.bearings(case, 3, folder=self.folder/"cases", speed_rpm=20000.0)
        numpy.testing.assert_array_equal(again.kxx, one.kxx)
        self.assertEqual((self.folder/"cases/bearing_1.h5").stat().st_mtime_ns, written, "what is there is computed again")
        with self.assertRaisesRegex(Unreadable, "only of 20000"):
            self.bearings(case, 3, folder=self.folder/"cases", speed_rpm=10000.0)


@unittest.skipUnless(SCIPY, "SciPy is not installed")
class ModesTest(unittest.TestCase):
    """A mass of 1 kg with stiffness 100 w, gyroscopic moments g and damping c: frequencies in closed form."""

    def test_coefficients_are_those_of_the_modes_own_frequency(self):
        # m w^2 - (+-) g w - 100 w = 0, so w = 100 +- g: forward the faster one
        found = gfb.ross_modes(OneMass([20.0, 70.0, 200.0], lambda w: 100.0*w, 0.0, 0.3), 300.0/math.pi*10.0)
        wanted = 100.0*0.3
        self.assertEqual([mode.forward for mode in found], [False, True])
        numpy.testing.assert_allclose([mode.frequency for mode in found], [100.0 - wanted, 100.0 + wanted], rtol=1.0e-8)

    def test_decay(self):
        # s^2 + c s + k(w) = 0: growth -c/2, w^2 = 100 w - c^2/4
        first, second = gfb.ross_modes(OneMass([20.0, 60.0, 200.0], lambda w: 100.0*w, 20.0, 0.0), 1000.0)
        frequency = 50.0 + math.sqrt(2500.0 - 100.0)
        for mode in (first, second):
            self.assertAlmostEqual(mode.frequency/frequency, 1.0, delta=1.0e-8)
            self.assertAlmostEqual(mode.growth_rate, -10.0, delta=1.0e-8)
            self.assertAlmostEqual(mode.logarithmic_decrement, 20.0*math.pi/frequency, delta=1.0e-8)
            self.assertAlmostEqual(mode.damping_ratio, 10.0/math.hypot(10.0, frequency), delta=1.0e-9)

    def test_nothing_beyond_the_tables(self):
        self.assertEqual(gfb.ross_modes(OneMass([110.0, 200.0], lambda w: 100.0*w, 0.0, 0.0), 0.0), [])
        rotor = OneMass([20.0, 200.0], lambda w: 100.0*w, 0.0, 0.0)
        rotor.bearing_elements[1].frequency = numpy.array([110.0, 300.0])
        self.assertEqual(gfb.ross_modes(rotor, 0.0), [], "one table reaches the mode, the other does not")
        rotor.bearing_elements[1].frequency = numpy.array([300.0, 400.0])
        with self.assertRaisesRegex(ValueError, "no range of frequencies"):
            gfb.ross_modes(rotor, 0.0)
        rotor.bearing_elements = [types.SimpleNamespace(frequency=None)]
        with self.assertRaisesRegex(ValueError, "no bearing of this rotor has a table"):
            gfb.ross_modes(rotor, 0.0)


@unittest.skipIf(importlib.util.find_spec("ross") is None, "ROSS is not installed")
class RossItself(MadeUpFiles):
    """Elements of ROSS itself give back the table's numbers."""

    def compare(self, element, at, stiffness, damping):
        """K and C of an element, evaluated as ROSS does."""
        numpy.testing.assert_allclose(element.K(*at)[:2, :2], stiffness[:2, :2], rtol=1.0e-12)
        numpy.testing.assert_allclose(element.C(*at)[:2, :2], damping[:2, :2], rtol=1.0e-9)

    def test_over_the_frequency(self):
        (one,) = gfb.ross_bearings(self.single("one.h5", 3000.0), 0)
        (point,) = gfb.ross_bearings(self.sweep("sweep.h5"), 0, speed_rpm=1500.0)
        for k, frequency in enumerate(FREQUENCY):
            self.compare(one, (frequency,), STIFFNESS[k], DAMPING[k])
            self.compare(point, (frequency,), 3.0*STIFFNESS[k], 3.0*DAMPING[k])

    def test_synchronous(self):
        (one,) = gfb.ross_bearings(self.sweep("sweep.h5"), 0, synchronous=True)
        self.compare(one, (SPEED[1],), 3.0*STIFFNESS[0], 3.0*DAMPING[0])
        self.compare(one, (SPEED[0],), STIFFNESS[1], DAMPING[1])

    def test_over_speed_and_frequency(self):
        import ross
        if ross.__version__.startswith("2."):
            self.assertRaises(ValueError, gfb.ross_bearings, self.sweep("sweep.h5"), 0)
            return
        (one,) = gfb.ross_bearings(self.sweep("sweep.h5"), 0)
        for k, frequency in enumerate(FREQUENCY):
            self.compare(one, (frequency, SPEED[0]), STIFFNESS[k], DAMPING[k])
            self.compare(one, (frequency, SPEED[1]), 3.0*STIFFNESS[k], 3.0*DAMPING[k])


if __name__ == "__main__":
    unittest.main()
