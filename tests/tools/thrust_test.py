"""Tests of the tools on thrust bearings: sectors in pictures, matrices of a runner, what tools/bench thrust says. Runs are made up."""

import os
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy

os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(pathlib.Path(os.environ["GFB_SOURCE"])/"tools"))

from gfb import coefficients  # noqa: E402 (found only now)
from gfb.bench import thrust  # noqa: E402
from gfb.plot import dynamics, foil, main, ring  # noqa: E402

STATIONS, ROWS = 5, 3
STIFFNESS = numpy.array([[[4.0e7, 0.0, 0.0], [0.0, 3.0e4, 3.0e3], [0.0, -3.0e3, 3.0e4]], [[5.0e7, 0.0, 0.0], [0.0, 4.0e4, 2.0e3], [0.0, -2.0e3, 4.0e4]]])


def film_file(path):
    """Two pads of 60 degrees, their pressure rising along the motion."""
    theta = numpy.repeat(numpy.concatenate([numpy.linspace(first, first + 60.0, STATIONS) for first in (0.0, 180.0)]), ROWS)
    radius = numpy.tile([0.02, 0.03, 0.04], 2*STATIONS)
    with h5py.File(path, "w") as file:
        angle = numpy.radians(theta)
        file["VTKHDF/Points"] = numpy.column_stack([radius*numpy.cos(angle), radius*numpy.sin(angle), numpy.zeros(len(theta))])
        values = {"theta": angle, "pad": numpy.repeat([1.0, 2.0], STATIONS*ROWS), "pressure": 1.0e5 + 10.0*(theta % 180.0),
                  "gap": 1.0e-5 + 1.0e-7*(numpy.arange(len(theta))//ROWS), "deflection": 0.0*theta}
        for name, value in values.items():
            file[f"VTKHDF/PointData/{name}"] = value
            file[f"VTKHDF/PointData/{name}"].attrs["unit"] = {"theta": "rad", "pad": "1", "pressure": "Pa"}.get(name, "m")


def case_file(path):
    """Stiffness and damping of a runner at two frequencies."""
    with h5py.File(path, "w") as file:
        for name, value in {"frequency": [100.0, 200.0], "stiffness": STIFFNESS, "damping": 1.0e-4*STIFFNESS}.items():
            file[f"dynamics/{name}"] = value


def foil_file(path):
    """The top foil of a pad of 60 degrees: it sinks from its leading edge on and touches one crest, but for the inner end."""
    angle = numpy.repeat(numpy.radians(numpy.linspace(0.0, 60.0, STATIONS)), ROWS)
    radius = numpy.tile([0.02, 0.03, 0.04], STATIONS)
    touches = numpy.zeros((STATIONS, ROWS))
    touches[2, 1:] = 1.0
    corner = numpy.arange(STATIONS*ROWS).reshape(STATIONS, ROWS)[:-1, :-1].ravel()
    with h5py.File(path, "w") as file:
        file["VTKHDF/Points"] = numpy.column_stack([radius*numpy.cos(angle), radius*numpy.sin(angle), 0.0*angle])
        file["VTKHDF/Connectivity"] = numpy.column_stack([corner, corner + 1, corner + ROWS + 1, corner + ROWS]).ravel()
        file["VTKHDF/PointData/displacement"] = numpy.column_stack([0.0*angle, 0.0*angle, -5.0e-6*angle/angle[-1]])
        file["VTKHDF/PointData/contact_state"] = touches.ravel()


class Run(dict):
    """Results and time."""

    def __init__(self, factorizations, cpu=1.0):
        super().__init__(factorizations=factorizations, factorizations_finest=5.0, unknowns=10.0, newton_iterations=10.0)
        self.cpu = cpu


class ThrustTest(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def test_sectors_are_drawn_in_their_plane(self):
        path = pathlib.Path(self.folder)/"two.film.vtkhdf"
        film_file(path)
        with h5py.File(path) as file:
            self.assertTrue(ring.is_ring(file))
            sectors = ring.sectors_of(file)
            figure = ring.draw_ring(path, file)
        self.assertEqual([nodes.shape for nodes in sectors], [(STATIONS, ROWS)]*2)
        charts = [chart for chart in figure.axes if chart.get_xlabel() == "x [mm]"]
        self.assertEqual([chart.get_title() for chart in charts], ["absolute pressure [kPa]", "film thickness [um]"])  # rigid: no deflection
        edges = [line.get_xydata() for line in charts[0].get_lines() if len(line.get_xydata()) == ROWS]
        numpy.testing.assert_allclose(edges[0][:, 0], [20.0, 30.0, 40.0])
        numpy.testing.assert_allclose(edges[1][:, 0], [-20.0, -30.0, -40.0])
        self.assertIn("thinnest\n10 um", [text.get_text() for text in charts[1].texts])
        ring_at = next(line.get_xydata() for line in charts[1].get_lines() if line.get_marker() == "o")
        numpy.testing.assert_allclose(ring_at, [[40.0, 0.0]], atol=1.0e-9, err_msg="of nodes that are alike the outermost, as the log has it")

    def test_a_top_foil_is_drawn_in_its_plane_and_in_space(self):
        path = pathlib.Path(self.folder)/"two.top_foil_1.vtkhdf"
        foil_file(path)
        with h5py.File(path) as file:
            self.assertTrue(ring.is_ring(file))
            self.assertEqual(foil.shape_of(path, file), (STATIONS, ROWS, 3))
            figure = main.draw_foil(path, file, [])
        chart, space = figure.axes[:2]
        self.assertEqual(chart.get_title(), "deflection away from the runner [um]; dashed: crests that push")
        edge, crest = (line.get_xydata() for line in chart.get_lines() if len(line.get_xydata()) == ROWS)
        numpy.testing.assert_allclose(edge, [[20.0, 0.0], [30.0, 0.0], [40.0, 0.0]])
        numpy.testing.assert_allclose(numpy.hypot(*crest.T), [numpy.nan, 30.0, 40.0])
        numpy.testing.assert_allclose(numpy.degrees(numpy.arctan2(crest[1:, 1], crest[1:, 0])), 30.0)
        self.assertEqual(space.get_title(), "displacements x 1000, the runner is above")  # 5 um on a side of 35 mm: 5 mm
        self.assertAlmostEqual(space.get_zlim()[0], -5.0, delta=0.3)

    def test_a_runner_gives_axial_coefficients_to_rotor_codes(self):
        path = pathlib.Path(self.folder)/"runner.h5"
        case_file(path)
        frequency, stiffness, damping = coefficients.read_coefficients(path)
        columns = coefficients.columns_of(stiffness, damping)
        numpy.testing.assert_allclose(columns["kzz"], [4.0e7, 5.0e7])
        numpy.testing.assert_allclose(columns["czz"], [4.0e3, 5.0e3])
        self.assertFalse(columns["kxx"].any() or columns["cyy"].any())
        self.assertIn("kzz = [40000000.0, 50000000.0]", coefficients.ross_text(frequency, columns, "runner"))
        with self.assertRaises(SystemExit):
            coefficients.table_writer(coefficients.xltrc_text, (frequency, stiffness, damping), "runner")

    def test_its_matrices_are_drawn(self):
        path = pathlib.Path(self.folder)/"runner.h5"
        case_file(path)
        with h5py.File(path) as file:
            figure = dynamics.draw(path, file)
        numpy.testing.assert_allclose(figure.axes[0].get_lines()[0].get_ydata(), [40.0, 50.0])
        self.assertEqual([line.get_label() for line in figure.axes[2].get_lines()][:4],
                         ["phi_x phi_x", "phi_x phi_y", "phi_y phi_x", "phi_y phi_y"])

    def test_aims_that_are_missed_are_named(self):
        mesh = (32, 16, 2)
        pads = [("1 pad", [Run(8.0)]), ("6 pads, aligned", [Run(8.0, 1.2)]), ("6 pads, tilted", [Run(8.0)])]
        shells = [("sector", [Run(8.0, 2.4)]), ("journal", [Run(8.0, 2.0)])]
        counts = {("rigid, held", mesh): Run(9.0), ("radial mean, 200 N", mesh): Run(17.0), ("shells, 200 N", mesh): Run(30.0)}
        self.assertEqual(list(thrust.missed_aims(counts, pads, shells, 0.0)), [
            "rigid, held: 8 factorizations, coarse mesh and all; the aim is 7", "6 aligned pads: 1.20 times one; the aim is 1.1",
            "an iteration of a sector's shells: 1.20 times that of a journal's; the aim is 1.1"])


if __name__ == "__main__":
    unittest.main()
