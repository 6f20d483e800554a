"""Tests of what is made of a bearing's stiffness and damping: tools/coefficients, and the picture of tools/plot.

The file is made up here with known numbers.
"""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import tomllib
import unittest
import unittest.mock

import h5py
import numpy

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(PROJECT/"tools"))

from gfb import coefficients  # noqa: E402 (found only now)
from gfb.plot import dynamics, main as plot_main  # noqa: E402

FREQUENCY = numpy.array([100.0, 200.0, 400.0])
STIFFNESS = numpy.arange(48.0).reshape(3, 4, 4)*1.0e5 - 1.0e6
DAMPING = numpy.arange(48.0).reshape(3, 4, 4)*10.0 + 1.0/3.0


def call(main, *words):
    """Status and words of a tool, in this process."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), \
            unittest.mock.patch("sys.argv", ["tool", *map(str, words)]):
        try:
            status = main()
        except SystemExit as end:
            status = end.code
    return status, said.getvalue()


class CoefficientsTest(unittest.TestCase):
    """Three frequencies."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plot_main.pyplot.close, "all")
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder/"made up.h5"
        with h5py.File(self.path, "w") as file:
            file["dynamics/frequency"], file["dynamics/stiffness"], file["dynamics/damping"] = FREQUENCY, STIFFNESS, DAMPING
        with h5py.File(self.folder/"other.h5", "w") as file:
            file["history/force_x"] = [1.0]

    def test_file_for_ross_holds_every_digit(self):
        status, said = call(coefficients.main, self.path, "--ross", self.folder/"a.toml")
        self.assertEqual((status, said.startswith("written: ")), (0, True), said)
        with open(self.folder/"a.toml", "rb") as file:
            (table,) = tomllib.load(file).values()
        self.assertEqual((table["n"], table["tag"], table["frequency"]), (0, "made up", FREQUENCY.tolist()))
        for row, name in enumerate("xy"):
            for column, other in enumerate("xy"):
                self.assertEqual(table[f"k{name}{other}"], STIFFNESS[:, row, column].tolist())
                self.assertEqual(table[f"c{name}{other}"], DAMPING[:, row, column].tolist())

    def sweep(self, name, frequency, speeds, stiffness=None, parameter="speed_rpm"):
        """A made-up sweep, and status and words of its file for ROSS."""
        path = self.folder/name
        with h5py.File(path, "w") as file:
            file["dynamics/frequency"], file[f"history/{parameter}"] = frequency, speeds
            file["dynamics/stiffness"] = numpy.stack((STIFFNESS, 3.0*STIFFNESS)) if stiffness is None else stiffness
            file["dynamics/damping"] = numpy.stack((DAMPING, 3.0*DAMPING))
        return call(coefficients.main, path, "--ross", self.folder/f"{name}.toml")

    def test_file_for_ross_over_speed_and_frequency(self):
        status, said = self.sweep("two.h5", numpy.stack((FREQUENCY, FREQUENCY)), [3000.0, 1500.0])
        self.assertEqual((status, "for ROSS 3" in said), (0, True), said)
        text = (self.folder/"two.h5.toml").read_text(encoding="utf-8")
        self.assertRegex(text, "^# gfb, for ROSS 3: .* speed of the shaft")
        (table,) = tomllib.loads(text).values()
        self.assertEqual(table["frequency"], FREQUENCY.tolist())
        numpy.testing.assert_allclose(table["speed"], [50.0*numpy.pi, 100.0*numpy.pi], rtol=1e-15)  # in their order
        self.assertEqual(table["kxy"], [(3.0*STIFFNESS[:, 0, 1]).tolist(), STIFFNESS[:, 0, 1].tolist()])
        self.assertEqual(table["cyx"], [(3.0*DAMPING[:, 1, 0]).tolist(), DAMPING[:, 1, 0].tolist()])
        status, said = call(coefficients.main, self.folder/"two.h5", "--ross", self.folder/"one.toml", "--point", "2")
        self.assertEqual((status, "for ROSS 2 and 3" in said), (0, True), said)
        text = (self.folder/"one.toml").read_text(encoding="utf-8")
        self.assertRegex(text, "^# gfb, for ROSS 2 and 3: ")
        self.assertEqual(next(iter(tomllib.loads(text).values()))["kxy"], (3.0*STIFFNESS[:, 0, 1]).tolist())

    def test_sweeps_that_are_no_table_over_the_speed(self):
        same, none = numpy.stack((FREQUENCY, FREQUENCY)), numpy.stack((STIFFNESS, numpy.nan*STIFFNESS))
        for words, text in (((numpy.stack((FREQUENCY, 2.0*FREQUENCY)), [1.0, 2.0]), "frequencies, not frequency_ratios"),
                            ((same, [1.0, 1.0]), "there are equal ones"), ((same, [1.0, 2.0], none), "point 2 has none"),
                            ((same, [1.0, 2.0], None, "load"), "not over speed_rpm")):
            status, said = self.sweep("none.h5", *words)
            self.assertEqual((status, said.count("\n"), text in said), (1, 1, True), said)
            self.assertFalse((self.folder/"none.h5.toml").exists())

    def test_columns_of_xltrc(self):
        self.assertEqual(call(coefficients.main, self.path, "--xltrc", self.folder/"a.txt")[0], 0)
        lines = (self.folder/"a.txt").read_text(encoding="utf-8").splitlines()
        self.assertEqual([word.split("[")[0] for word in lines[1].split()],
                         ["Freq", "Kxx", "Kxy", "Kyx", "Kyy", "Cxx", "Cxy", "Cyx", "Cyy"])
        rows = numpy.array([[float(word) for word in line.split()] for line in lines[2:]])
        wanted = numpy.column_stack([FREQUENCY*30.0/numpy.pi, STIFFNESS[:, :2, :2].reshape(3, 4), DAMPING[:, :2, :2].reshape(3, 4)])
        numpy.testing.assert_allclose(rows, wanted, rtol=1.0e-7)

    def test_picture(self):
        self.assertEqual(call(plot_main.main, self.path, "--show", "dynamics", "-o", self.folder/"a.png")[0], 0)
        with h5py.File(self.path) as file:
            charts = dynamics.draw(self.path, file).axes
        drawn = [chart.lines[2] for chart in charts]  # the third one is row 2, column 1
        for line, values in zip(drawn, (STIFFNESS[:, 1, 0]/1.0e6, DAMPING[:, 1, 0]/1.0e3, STIFFNESS[:, 3, 2], DAMPING[:, 3, 2])):
            numpy.testing.assert_allclose(line.get_xdata(), FREQUENCY)
            numpy.testing.assert_allclose(line.get_ydata(), values, rtol=1.0e-12)

    def test_picture_of_a_point_of_a_sweep(self):
        path = self.folder/"swept.h5"
        with h5py.File(path, "w") as file:
            file["dynamics/frequency"] = numpy.stack((FREQUENCY, 2.0*FREQUENCY))
            file["dynamics/stiffness"], file["dynamics/damping"] = (numpy.stack((one, 3.0*one)) for one in (STIFFNESS, DAMPING))
        with h5py.File(path) as file:
            for steps, point in (([], 2), ([1], 1)):
                figure = dynamics.draw(path, file, steps)
                self.assertEqual(figure._suptitle.get_text(), f"swept: point {point} of 2")
                numpy.testing.assert_allclose(figure.axes[0].lines[0].get_xdata(), point*FREQUENCY)
        status, said = call(plot_main.main, path, "--show", "dynamics", "--step", "3")
        self.assertEqual((status, "--step 1 to 2" in said), (1, True), said)

    def test_wrong_calls_are_told(self):
        to = ("--ross", self.folder/"b.toml")
        (self.folder/"text.h5").write_text("no HDF5", encoding="utf-8")
        for main, words, text in ((coefficients.main, (self.folder/"none.h5", *to), "there is no such file"),
                                  (coefficients.main, (self.folder/"other.h5", *to), "linear_dynamics"),
                                  (coefficients.main, (self.folder/"text.h5", *to), "not a whole file"),
                                  (coefficients.main, (self.path,), "nothing to write"),
                                  (plot_main.main, (self.folder/"other.h5", "--show", "dynamics"), "linear_dynamics"),
                                  (plot_main.main, (self.path, "--show", "dynamics", "--step", "1"), "without --step")):
            status, said = call(main, *words)
            self.assertEqual((status, said.count("\n"), text in said), (1, 1, True), f"{words}: {said}")
        self.assertEqual(call(coefficients.main, self.path, "--ross", self.folder/"no/b.toml")[0], 3)


if __name__ == "__main__":
    unittest.main()
