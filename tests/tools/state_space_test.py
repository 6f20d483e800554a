"""Tests of the state-space matrices of tools/coefficients: a rational function that is known, and a bearing of gfb.

The bearing's matrices are held against its table, between the frequencies of the fit, in time, and against gfb's critical mass.
"""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
sys.path.insert(0, str(PROJECT/"tools"))

from gfb import coefficients  # noqa: E402 (found only now)
from gfb.running import run_file, write_case  # noqa: E402
from gfb.state_space import CannotFit, Fit, deviation, fit  # noqa: E402

RPM = 60000.0
SPEED = RPM*numpy.pi/30.0
RATIOS = numpy.concatenate((numpy.arange(0.05, 1.0, 0.05), numpy.arange(1.0, 2.1, 0.1)))
CASE = {
    "scene": {"analysis": "linear_dynamics"},
    "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
    "operation": {"speed_rpm": RPM, "load": (-30.0, 0.0)},
    "model": {"foil": "elastic_foundation", "foundation_stiffness": 5.0e9, "foundation_pressure": "axial_mean"},
    "mesh": {"circumferential_elements": 52, "axial_elements": 8},
    "dynamics": {"frequency_ratios": tuple(map(float, RATIOS))},
}


def call(*words):
    """Status and words of tools/coefficients, in this process."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), \
            unittest.mock.patch("sys.argv", ["tools/coefficients", *map(str, words)]):
        try:
            status = coefficients.main()
        except SystemExit as end:
            status = end.code
    return status, said.getvalue()


def table_file(path, frequency, impedance):
    """A result file of gfb's shape."""
    with h5py.File(path, "w") as file:
        file["dynamics/frequency"], file["dynamics/stiffness"] = frequency, impedance.real
        file["dynamics/damping"] = impedance.imag/frequency[:, None, None]
    return path


def made_up(with_rate):
    """Two real poles and a pair; displacements and tilts are of different units and do not couple at all entries."""
    random = numpy.random.default_rng(1)
    size = numpy.outer((1.0, 1.0, 1.0e-2, 1.0e-2), (1.0, 1.0, 1.0e-2, 1.0e-2))*1.0e6
    size[2:, :2] = 0.0
    residues = random.standard_normal((3, 4, 4)) + 1j*random.standard_normal((3, 4, 4))
    residues[:2] = residues[:2].real
    return Fit(numpy.array([-800.0, -6000.0, -900.0 + 2500.0j]), residues*size*1.0e3, random.standard_normal((4, 4))*size,
               random.standard_normal((4, 4))*size*1.0e-4*with_rate)


class RationalFunction(unittest.TestCase):
    """Data without any error."""

    frequency = numpy.linspace(100.0, 8000.0, 24)

    def test_a_known_function_is_found_again(self):
        for with_rate in (False, True):
            known = made_up(with_rate)
            wanted = known(1j*self.frequency)
            found = fit(self.frequency, wanted, with_rate=with_rate)
            self.assertEqual(found.number, 4)
            self.assertLess(found.deviation, 1.0e-10)
            self.assertLess(found.between, 1.0e-10)
            numpy.testing.assert_allclose(numpy.sort_complex(found.all_poles), numpy.sort_complex(known.all_poles), rtol=1.0e-9)
            far = 1j*numpy.array([1.0, 3.0e4, 1.0e6])  # the function, not only its data
            self.assertLess(deviation(found(far), known(far)), 1.0e-8)

    def test_matrices_are_the_function(self):
        known = made_up(True)
        a, b, c, d, e = known.matrices()
        numpy.testing.assert_allclose(numpy.sort_complex(numpy.linalg.eigvals(a)), numpy.sort_complex(numpy.repeat(known.all_poles, 4)))
        for s in (0.0, 300.0j, 20.0 + 5000.0j):
            made = c@numpy.linalg.solve(s*numpy.eye(len(a)) - a, b.astype(complex)) + d + s*e
            numpy.testing.assert_allclose(made, known(s), rtol=1.0e-11, atol=1.0e-4)

    def test_poles_stay_on_the_left(self):
        growing = Fit(numpy.array([300.0 + 1000.0j]), numpy.ones((1, 4, 4), complex)*1.0e9, numpy.eye(4)*1.0e6, numpy.zeros((4, 4)))
        with tempfile.TemporaryDirectory() as folder:
            path = table_file(pathlib.Path(folder)/"a.h5", self.frequency, growing(1j*self.frequency))
            status, said = call(path, "--state-space")
            self.assertEqual((status, "--accept-deviation writes them" in said, said.count("\n")), (1, True, 2), said)
            status, said = call(path, "--state-space", "--accept-deviation")
            self.assertEqual((status, "warning: these equations are not those of the bearing" in said), (0, True), said)
            with numpy.load(path.with_suffix(".state_space.npz")) as file:
                self.assertLess(numpy.linalg.eigvals(file["A"]).real.max(), 0.0)
                self.assertGreater(file["deviation"], 1.0e-3)

    def test_a_small_deviation_is_no_warning(self):
        """A tenth of a percent is said as a number, and no more."""
        wanted = made_up(False)(1j*self.frequency)
        wanted *= 1.0 + 2.0e-3*numpy.cos(7.0*numpy.arange(wanted.size).reshape(wanted.shape))
        with tempfile.TemporaryDirectory() as folder:
            path = table_file(pathlib.Path(folder)/"a.h5", self.frequency, wanted)
            status, said = call(path, "--state-space", "--poles", "4")
            with numpy.load(path.with_suffix(".state_space.npz")) as file:
                self.assertTrue(1.0e-3 < file["deviation"] < 1.0e-2)
        self.assertEqual((status, "warning" in said, "largest deviation" in said), (0, False, True), said)

    def test_data_that_determine_nothing_are_refused(self):
        wanted = made_up(False)(1j*self.frequency)
        for take, poles in ((slice(4), None), ([0, 1, 1, 2, 3, 4], None), (slice(6), 5), (slice(None), 0), (slice(None), 25)):
            with self.assertRaises(CannotFit, msg=f"{take} {poles}"):
                fit(self.frequency[take], wanted[take], poles)
        with self.assertRaises(CannotFit):
            fit(self.frequency, wanted*numpy.nan)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            path = table_file(folder/"a.h5", self.frequency[:4], wanted[:4])
            whole = table_file(folder/"b.h5", self.frequency, wanted)
            for words, text in (((path, "--state-space"), "no state space"), ((whole, "--state-space", folder/"a.txt"), ".npz or .mat"),
                                ((whole, "--poles", "3", "--ross", folder/"a.toml"), "are of --state-space"),
                                ((whole, "--state-space", "--point", "1"), "--point is of sweeps")):
                status, said = call(*words)
                self.assertEqual((status, said.count("\n"), text in said), (1, 1, True), f"{words}: {said}")
            with h5py.File(folder/"c.h5", "w") as file:
                file["dynamics/frequency"] = numpy.stack((self.frequency, 2.0*self.frequency))
                file["dynamics/stiffness"], file["dynamics/damping"] = numpy.stack((wanted.real,)*2), numpy.stack((wanted.imag,)*2)
            status, said = call(folder/"c.h5", "--state-space")
            self.assertEqual((status, "--point, 1 to 2" in said), (1, True), said)
            self.assertEqual(call(folder/"c.h5", "--xltrc", folder/"c.txt", "--point", "2")[0], 0)
            first = (folder/"c.txt").read_text(encoding="utf-8").splitlines()[2].split()[0]
            self.assertAlmostEqual(float(first), 200.0*30.0/numpy.pi, places=3)


class Bearing(unittest.TestCase):
    """A small one on springs, 30 frequencies."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.answer = run_file(os.environ["GFB"], write_case(folder.name, "small", CASE), folder.name, options=("--quiet",))
        cls.path = pathlib.Path(f"{cls.answer.stem}.h5")
        cls.frequency, stiffness, damping = coefficients.read_coefficients(cls.path)
        cls.table = stiffness + 1j*cls.frequency[:, None, None]*damping
        cls.said = call(cls.path, "--state-space")
        with numpy.load(cls.path.with_suffix(".state_space.npz")) as file:
            cls.matrices = [file[name] for name in "ABCDE"]
            cls.poles, cls.told = file["poles"], float(file["deviation"])

    def test_table_is_met_with_stable_poles(self):
        self.assertEqual((self.said[0], len(self.frequency)), (0, 30), self.said)
        self.assertLess(self.told, 1.0e-4)
        self.assertLess(self.poles.real.max(), 0.0)
        a, b, c, d, e = self.matrices
        found = numpy.array([c@numpy.linalg.solve(1j*w*numpy.eye(len(a)) - a, b) + d + 1j*w*e for w in self.frequency])
        self.assertAlmostEqual(deviation(found, self.table), self.told, delta=1.0e-9)
        self.assertFalse(e.any())

    def test_frequencies_that_the_fit_does_not_know(self):
        told = fit(self.frequency[::2], self.table[::2], 8)
        self.assertLess(deviation(told(1j*self.frequency), self.table), 1.0e-4)

    def test_force_of_a_motion_in_time(self):
        a, b, c, d, _ = self.matrices
        which = 10
        frequency, motion = self.frequency[which], numpy.array([1.0e-6, 0.5e-6j, 2.0e-5, 1.0e-5j])

        def place(time):
            return (motion*numpy.exp(1j*frequency*time)).real

        state, steps = numpy.zeros(len(a)), 4000
        step = 12*2.0*numpy.pi/frequency/steps  # twelve cycles: what was at rest is forgotten
        for i in range(steps):  # Runge and Kutta
            time = i*step
            slopes = []
            for part, before in ((0.0, 0.0), (0.5, 0.5), (0.5, 0.5), (1.0, 1.0)):
                slopes.append(a@(state + before*step*(slopes[-1] if slopes else 0.0)) + b@place(time + part*step))
            state = state + step/6.0*(slopes[0] + 2.0*slopes[1] + 2.0*slopes[2] + slopes[3])
            if i >= steps - steps//12:  # the last cycle
                end = time + step
                force = -(c@state + d@place(end))
                wanted = -(self.table[which]@motion*numpy.exp(1j*frequency*end)).real
                size = numpy.abs(self.table[which]@motion)
                self.assertLess(numpy.abs((force - wanted)/size).max(), 1.0e-4)

    def test_critical_mass_is_that_of_gfb(self):
        a, b, c, d, _ = self.matrices
        mass, ratio, states = self.answer["critical_mass"], self.answer["whirl_ratio"], len(a)
        shaft = numpy.block([[numpy.zeros((2, 2)), numpy.eye(2), numpy.zeros((2, states))],
                             [-d[:2, :2]/mass, numpy.zeros((2, 2)), -c[:2]/mass], [b[:, :2], numpy.zeros((states, 2)), a]])
        values = numpy.linalg.eigvals(shaft)
        least = max((value for value in values if value.imag > 0.05*SPEED), key=lambda value: value.real)
        self.assertLess(abs(least.real), 1.0e-5*SPEED)
        self.assertAlmostEqual(least.imag/SPEED, ratio, delta=1.0e-5)

    def test_matlab(self):
        path = self.path.with_suffix(".mat")
        with unittest.mock.patch("importlib.util.find_spec", return_value=None):
            status, said = call(self.path, "--state-space", path)
        self.assertEqual((status, "needs SciPy" in said), (1, True), said)
        try:
            from scipy.io import loadmat
        except ImportError:
            self.skipTest("no SciPy here")
        self.assertEqual(call(self.path, "--state-space", path)[0], 0)
        numpy.testing.assert_array_equal(loadmat(path)["A"], self.matrices[0])


if __name__ == "__main__":
    unittest.main()
