"""Tests of tools/plot on strips and on bearings with foils: what stands in the pictures, what it says to wrong calls.

Files are made up here with known numbers; one is gfb's own, of a small strip.
"""

import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(PROJECT/"tools"))

from gfb.plot import contact as plot_contact  # noqa: E402 (found only now)
from gfb.plot import dynamics as plot_dynamics  # noqa: E402
from gfb.plot import film as plot_film  # noqa: E402
from gfb.plot import foil as plot_foil  # noqa: E402
from gfb.plot import heat as plot_heat  # noqa: E402
from gfb.plot import main as plot_main  # noqa: E402
from gfb.plot import polar as plot_polar  # noqa: E402
from gfb.plot import rotor as plot_rotor  # noqa: E402
from gfb.plot import sample as plot_sample  # noqa: E402
from gfb.plot import scene as plot_scene  # noqa: E402
from gfb.plot import strip as plot_strip  # noqa: E402
from slow import slow  # noqa: E402

SMALL = """&scene analysis = 'strip' /
&bump_foil thickness = 0.127e-3 youngs_modulus = 207.0e9 poissons_ratio = 0.3 half_length = 3.3e-3
  height = 0.9e-3 pitch = 7.0e-3 bumps = 2 width = 18.0e-3 fixed_edge = '{edge}' /
&contact friction_top = 0.2 friction_sleeve = 0.2 /
&strip_load kind = 'plates' maximum_force = 50.0 steps_up = 4 steps_down = 4 /
&mesh arc_elements = 4 flat_elements = 1 axial_elements = 8 /
"""

BEAMS = """&scene analysis = 'fixed_position' /
&bearing radius = 19.05e-3 length = 38.1e-3 clearance = 31.8e-6 /
&gas viscosity = 1.95e-5 ambient_pressure = 1.0135e5 /
&operation speed_rpm = 30000.0 eccentricity = 25.0e-6, 8.0e-6 /
&top_foil thickness = 0.102e-3 youngs_modulus = 214.0e9 poissons_ratio = 0.29 /
&bump_foil thickness = 0.102e-3 youngs_modulus = 214.0e9 poissons_ratio = 0.29 half_length = 1.778e-3
  height = 0.508e-3 pitch = 4.572e-3 bumps = 26 /
&contact friction_top = 0.1 friction_sleeve = 0.1 /
&model foil = 'beam' /
&mesh circumferential_elements = 104 axial_elements = 4 arc_elements = 4 flat_elements = 1 /
"""


def call_command(folder, *words):
    """tools/plot as a user calls it: status, and what it said."""
    done = subprocess.run([sys.executable, PROJECT/"tools/plot", *words], cwd=folder, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def call(folder, *words):
    """The same in this process, which has loaded what draws."""
    said = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), \
            unittest.mock.patch("sys.argv", ["tools/plot", *words]):
        try:
            status = plot_main.main()
        except SystemExit as end:
            status = end.code
    plot_strip.pyplot.close("all")
    return status, said.getvalue()


def used(friction, law="'tanh_drag' ! law (default)"):
    """An echo of a case, as far as labels need it."""
    return (f"&scene\n  title = 'mu = {friction}' ! title\n/\n&contact\n  friction_sleeve = {friction} ! [1] mu\n"
            f"  stick_length = {1.0 + friction} ! [m] follows the load (default)\n  friction_law = {law}\n/\n")


def strip_file(path, force, deflection, echo=used(0.1), travel=None, states=None):
    """A strip's result file; deflection: (steps, bumps) [m]; states: (steps, lines, rows) of half a width."""
    with h5py.File(path, "w") as file:
        def put(name, values, unit):
            file[name] = values
            file[name].attrs.update(unit=unit, meaning="made up")
        put("history/step", numpy.arange(1.0, len(force) + 1.0), "1")
        put("history/force", numpy.array(force), "N")
        for bump, column in enumerate(numpy.array(deflection).T, start=1):
            put(f"history/crest_deflection_{bump}", column, "m")
        if travel is not None:
            put("history/plate_travel", numpy.array(travel), "m")
            put("summary/dissipated_energy", 2.5e-3, "J")
        file.require_group("summary")
        file["scene/used"] = echo
        if states is not None:
            states = numpy.array(states, dtype=float)
            lines, rows = states.shape[1:]
            number = numpy.repeat(numpy.arange(1.0, lines + 1.0), rows)
            number[:rows] = 0.0  # the first line is held
            put("contact/sleeve/line", number, "1")
            put("contact/sleeve/position_z", numpy.tile(numpy.linspace(0.0, 0.01, rows), lines), "m")
            put("contact/sleeve/state", states.reshape(len(states), -1), "1")
    return path


def bearing_file(path, force, states):
    """A bearing's result file; force: (points, 2) [N]; states: (points, lines, rows) of half the width."""
    with h5py.File(path, "w") as file:
        columns = {"force_x": (numpy.array(force)[:, 0], "N"), "force_y": (numpy.array(force)[:, 1], "N"),
                   "minimum_gap_midplane": ([7.0e-6]*len(force), "m"), "minimum_gap_edge": ([6.0e-6]*len(force), "m"),
                   "eccentricity_x": ([1.0e-6]*len(force), "m")}
        for name, (values, unit) in columns.items():
            file[f"history/{name}"] = values
            file[f"history/{name}"].attrs.update(unit=unit, meaning="made up")
        file["scene/used"] = used(0.1)
        states = numpy.array(states, dtype=float)
        lines, rows = states.shape[1:]
        for surface in ("top", "sleeve"):
            file[f"contact/{surface}/line"] = numpy.repeat(numpy.arange(1.0, lines + 1.0), rows)
            file[f"contact/{surface}/position_z"] = numpy.tile(numpy.linspace(0.0, 0.01, rows), lines)
            file[f"contact/{surface}/state"] = states.reshape(len(states), -1)
    return path


class BearingTest(unittest.TestCase):
    """Made-up bearings with foils."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plot_strip.pyplot.close, "all")
        self.folder = pathlib.Path(folder.name)

    def contact(self, lines, points, steps=()):
        """The contact states of a bearing of so many lines, whose last line alone slips in the last point."""
        states = numpy.zeros((points, lines, 3))
        states[-1, -1] = 2
        path = bearing_file(self.folder/"a_bearing.h5", [(-30.0*(i + 1), 40.0*(i + 1)) for i in range(points)], states)
        with h5py.File(path, "r") as file:
            return plot_strip.draw([path], [file], "contact", list(steps))

    def test_contacts_are_of_the_last_point(self):
        axes = self.contact(3, 2).axes
        self.assertEqual([chart.get_title() for chart in axes], ["point 2, 100 N: top", "point 2, 100 N: sleeve"])
        columns = [mesh.get_array().ravel().tolist() for mesh in axes[1].collections]
        self.assertEqual(columns, [[0]*5, [0]*5, [2]*5])

    def test_contacts_of_a_point_named_and_of_one_point_alone(self):
        chart = self.contact(3, 2, [1]).axes[0]
        self.assertEqual(chart.get_title(), "point 1, 50 N: top")
        self.assertEqual([mesh.get_array().max() for mesh in chart.collections], [0, 0, 0])
        self.assertEqual(self.contact(3, 1).axes[0].get_title(), "50 N: top")

    def test_many_lines_stand_below_each_other_and_bear_true_numbers(self):
        top, sleeve = self.contact(52, 1).axes
        self.assertGreater(top.get_position().y0, sleeve.get_position().y1)
        self.assertEqual(len(sleeve.collections), 52)
        places = sleeve.get_xticks()
        self.assertLess(len(places), 30)
        self.assertEqual([int(tick.get_text()) for tick in sleeve.get_xticklabels()], list(places))

    def test_top_foil_is_a_map_and_lines_of_its_deflection(self):
        x, z = numpy.linspace(0.0, 0.1, 6), numpy.linspace(-0.02, 0.02, 5)
        points, moved = numpy.zeros((6, 5, 3)), numpy.zeros((6, 5, 3))
        points[:, :, 0], points[:, :, 1], points[:, :, 2] = x[:, None], 5.0e-4, z
        moved[:, :, 1] = -1.0e-6*numpy.arange(6.0)[:, None] - 1.0e-4*z
        path = self.folder/"a.top_foil.vtkhdf"
        with h5py.File(path, "w") as file:
            file["VTKHDF/Points"] = points.reshape(-1, 3)
            file["VTKHDF/Connectivity"] = numpy.array([0, 5, 6, 1])
            file["VTKHDF/PointData/displacement"] = moved.reshape(-1, 3)
        with h5py.File(path, "r") as file:
            lines = plot_foil.draw(path, file, []).axes[1].lines
        for line, shift in zip(lines, (0.0, 2.0, -2.0)):
            numpy.testing.assert_allclose(line.get_ydata(), numpy.arange(6.0) + shift, atol=1e-12)
        numpy.testing.assert_allclose(lines[0].get_xdata(), 1.0e3*x, atol=1e-12)

    def test_columns_of_one_unit_share_a_chart_where_asked(self):
        path = bearing_file(self.folder/"b.h5", [(-10.0, 0.0), (-20.0, 0.0)], numpy.zeros((2, 3, 3)))
        names = ["minimum_gap_midplane", "force_x", "minimum_gap_edge"]
        with h5py.File(path, "r") as file:
            apart, together = (plot_main.draw_history(path, file, names, asked).axes for asked in (False, True))
        self.assertEqual([len(chart.lines) for chart in apart], [1, 1, 1, 0])
        self.assertEqual([len(chart.lines) for chart in together], [2, 1])
        for line, height in zip(together[0].lines, (7.0, 6.0)):
            numpy.testing.assert_allclose(line.get_ydata(), [height]*2, rtol=1e-12)

    def test_limits_are_drawn_first_where_nothing_is_named(self):
        path = bearing_file(self.folder/"b.h5", [(-10.0, 0.0), (-20.0, 0.0)], numpy.zeros((2, 3, 3)))
        with h5py.File(path, "r+") as file:
            for name, unit, values in (("load_capacity", "N", [10.0, 20.0]), ("minimum_gap", "m", [4.0e-6]*2),
                                       ("load_capacity_coefficient", "lbf/(in^3 krpm)", [0.4, 0.3])):
                file[f"history/{name}"] = values
                file[f"history/{name}"].attrs.update(unit=unit, meaning="made up")
            charts = plot_main.draw_history(path, file, []).axes
        self.assertEqual([chart.get_ylabel() for chart in charts], ["load capacity [N]", "coefficient [lbf/(in^3 krpm)]"])
        numpy.testing.assert_allclose(charts[0].lines[0].get_ydata(), [10.0, 20.0])

    @slow
    def test_slow_foils_of_gfb(self):
        (self.folder/"beams.nml").write_text(BEAMS, encoding="utf-8")
        subprocess.run([os.environ["GFB"], "--output", self.folder, self.folder/"beams.nml"], check=True,
                       stdout=subprocess.DEVNULL)
        for name in ("beams.top_foil.vtkhdf", "beams.bump_foil.vtkhdf", "beams.film.vtkhdf"):
            self.assertEqual(call(self.folder, name), (0, f"drawn: {name}.png\n"))
        with h5py.File(self.folder/"beams.bump_foil.vtkhdf", "r") as file:
            side, bars, _ = plot_foil.draw(self.folder/"beams.bump_foil.vtkhdf", file, []).axes
        self.assertEqual(len(bars.containers[0]), 26)
        self.assertEqual(len(side.lines[1].get_xdata()), 26*5 + 1)
        with h5py.File(self.folder/"beams.top_foil.vtkhdf", "r") as file:
            lines = plot_foil.draw(self.folder/"beams.top_foil.vtkhdf", file, []).axes[1].lines
        x, height = side.lines[0].get_data()
        above = [numpy.argmin(abs(lines[0].get_xdata() - x[crest])) for crest in plot_foil.crest_stations(height)]
        found = numpy.array([bar.get_height() for bar in bars.containers[0]]) - lines[0].get_ydata()[above]
        self.assertLess(abs(found[:13]).max(), 0.01)  # in contact, to the penetration
        self.assertGreater(found[-3], 0.1)            # lifted off
        self.assertEqual(call(self.folder, "beams.h5", "--show", "contact")[1], "drawn: beams.h5.contact.png\n")
        self.see_film_around_the_shaft()
        self.see_scene_and_edges()

    def see_film_around_the_shaft(self):
        """Lines, load, pad edges and thinnest film of --show polar."""
        path = self.folder/"beams.film.vtkhdf"
        with h5py.File(path, "r") as file:
            pressure, gap = plot_polar.draw(path, file).axes
        with h5py.File(self.folder/"beams.h5", "r") as file:
            force = [file[f"summary/force_{axis}"][()] for axis in "xy"]
            thinnest = 1.0e6*file["summary/minimum_gap"][()]
            highest, ambient = (1.0e-3*number for number in (file["summary/maximum_pressure"][()], 1.0135e5))
        (arrow,) = pressure.texts
        self.assertAlmostEqual(arrow.xy[0] % (2.0*numpy.pi), numpy.arctan2(*reversed(force)) % (2.0*numpy.pi), places=9)
        lines = {line.get_label(): line for line in pressure.lines}
        self.assertAlmostEqual(lines["midplane"].get_ydata().max(), highest, places=9)
        numpy.testing.assert_allclose(lines["edges"].get_ydata(), ambient)
        numpy.testing.assert_allclose(numpy.cos(lines["pad edges"].get_xdata()), 1.0)
        (ring,) = [line for line in gap.lines if line.get_label().startswith("thinnest")]
        along = numpy.argmin(gap.lines[0].get_ydata())
        self.assertAlmostEqual(ring.get_ydata()[0], thinnest, places=9)
        self.assertAlmostEqual(ring.get_xdata()[0], gap.lines[0].get_xdata()[along])
        self.assertIn("is of one CASE.film.vtkhdf", call(self.folder, "beams.top_foil.vtkhdf", "--show", "polar")[1])
        self.assertEqual(call(self.folder, "beams.film.vtkhdf", "--show", "polar")[1], "drawn: beams.film.vtkhdf.polar.png\n")

    def see_scene_and_edges(self):
        """What the pictures take from beams.h5, and how they show it."""
        path = self.folder/"beams.film.vtkhdf"
        with h5py.File(path, "r") as file:
            figure = plot_film.draw_film(path, file)
        with h5py.File(self.folder/"beams.h5", "r") as file:
            force = [file[f"summary/force_{axis}"][()] for axis in "xy"]
            gap, angle = 1.0e6*file["summary/minimum_gap"][()], numpy.degrees(numpy.arctan2(*reversed(force))) % 360.0
            table = plot_main.draw_history(self.folder/"beams.h5", file, []).axes[0].tables[0]
        title = f"beams: film force {numpy.hypot(*force):.4g} N, 30,000 rpm, beams"
        self.assertEqual(figure._suptitle.get_text(), title)
        lines = next(chart for chart in figure.axes if chart.get_ylabel() == "film thickness [um]")
        named = {line.get_label(): line for line in lines.lines}
        self.assertEqual(list(named), ["midplane", "edges, z = +-19.05 mm", "direction of the load", f"thinnest, {gap:.3g} um"])
        self.assertAlmostEqual(named["direction of the load"].get_xdata()[0], angle, places=6)
        self.assertAlmostEqual(named[f"thinnest, {gap:.3g} um"].get_ydata()[0], gap, places=9)
        words = [table[row, 0].get_text().get_text() for row in range(6)]
        self.assertEqual(words[:5], ["force along x", "force along y", "e_x", "e_y", "attitude angle"])
        with h5py.File(self.folder/"beams.top_foil.vtkhdf", "r") as file:
            chart, _, scale = plot_foil.draw(self.folder/"beams.top_foil.vtkhdf", file, []).axes
        self.assertEqual(scale._colorbar.norm(0.0), 0.5)  # white is zero
        (theta,) = chart.child_axes
        self.assertEqual(theta.get_xlabel(), "theta [deg]")
        other = self.folder/"beams.branches.1.film.vtkhdf"
        other.write_bytes(path.read_bytes())
        with h5py.File(other, "r") as file:
            self.assertEqual(plot_film.draw_film(other, file)._suptitle.get_text(), "beams.branches.1")
        (self.folder/"beams.h5").write_bytes(b"broken")
        with h5py.File(path, "r") as file:  # it is not this file that is broken
            self.assertEqual(plot_film.draw_film(path, file)._suptitle.get_text(), "beams")

    def test_a_title_says_the_load_that_is_given(self):
        """A shaft that moves has another film force than its load, one whose position is given no load."""
        for analysis, load, words, angle in (("equilibrium", "-20.0, 0.0", "load 20 N", 180.0), ("transient", "-20.0, 20.0", "load 28.28 N", 135.0),
                                             ("periodic", "-20.0, 0.0", "load 20 N", 180.0), ("transient", None, "film force 20 N", 180.0),
                                             ("linear_dynamics", "-21.0, 0.0", "film force 20 N", 180.0)):
            with h5py.File(self.folder/"a.h5", "w") as file:
                file["summary/force_x"], file["summary/force_y"] = -20.0, 0.0
                file.create_group("history")
                file["scene/used"] = f"&scene\n  analysis = '{analysis}'\n/\n&bearing\n  radius = 0.02 ! [m]\n/\n&operation\n" + \
                    f"  load = {load} ! [N]\n"*bool(load) + "/\n"
                scene = plot_scene.read_scene(file)
            self.assertEqual((scene.words, abs(scene.load_angle)), (words, angle))

    def test_grooves_are_drawn(self):
        """A line of each groove, within one turn, broken where a turn ends."""
        path = bearing_file(self.folder/"b.h5", [(-10.0, 0.0)], numpy.zeros((1, 3, 3)))
        with h5py.File(path, "r+") as file:
            del file["scene/used"]
            file["scene/used"] = ("&bearing\n  radius = 0.02\n/\n&grooves\n  on = 'sleeve'\n  angle = 0.3\n  depth = 1e-5\n  band_begin = -0.01\n"
                                  "  band_end = 0.01\n  pumping = 'up'\n  count = 5\n/\n")
            file.create_group("summary")
            scene = plot_scene.read_scene(file)
        self.assertEqual(len(scene.grooves), 5)
        figure, chart = plot_film.pyplot.subplots()
        film = plot_film.Film(numpy.array([10.0, 370.0]), numpy.array([-0.01, 0.01]), {}, {})
        plot_film.mark_grooves(chart, film, scene)
        for line in chart.lines:
            theta, along = line.get_data()
            self.assertTrue(numpy.nanmin(theta) >= 10.0 and numpy.nanmax(theta) <= 370.0)
            self.assertLess(numpy.nanmax(numpy.abs(numpy.diff(theta))), 180.0)
            self.assertEqual((numpy.nanmin(along), numpy.nanmax(along)), (-10.0, 10.0))
        self.assertTrue(any(numpy.isnan(line.get_xdata()).any() for line in chart.lines))
        plot_film.pyplot.close(figure)

    def test_a_sweep_of_a_key_is_drawn_over_it(self):
        """A film that is fed has its flow among what is drawn unasked, over the supply pressure; holes of its case are marked."""
        path = bearing_file(self.folder/"b.h5", [(-10.0, 0.0), (-20.0, 0.0)], numpy.zeros((2, 3, 3)))
        with h5py.File(path, "r+") as file:
            for name, unit, values in (("key_value", "Pa", [6.0e5, 4.0e5]), ("supply_flow", "kg/s", [2.0e-4, 1.0e-4])):
                file[f"history/{name}"] = values
                file[f"history/{name}"].attrs.update(unit=unit, meaning="made up")
            keys = "&bearing\n  radius = 0.02\n/\n&sweep\n  parameter = 'feed%supply_pressure'\n/\n&feed\n  kind = 'orifices'\n  orifices = 4\n  row_positions = -0.01, 0.01\n/\n"
            del file["scene/used"]
            file["scene/used"] = keys
            file.create_group("summary")
            (chart,) = [one for one in plot_main.draw_history(path, file, []).axes if one.get_ylabel() == "supply flow [g/s]"]
            holes = plot_scene.read_scene(file).holes
        self.assertEqual(chart.get_xlabel(), "supply pressure [kPa]")
        numpy.testing.assert_allclose(chart.lines[0].get_xydata(), [(600.0, 0.2), (400.0, 0.1)])
        numpy.testing.assert_allclose(sorted(holes), sorted((angle, along) for angle in (45.0, 135.0, 225.0, 315.0) for along in (-0.01, 0.01)))

    def test_calls(self):
        bearing_file(self.folder/"b.h5", [(-10.0, 0.0), (-20.0, 0.0)], numpy.zeros((2, 3, 3)))
        for words, picture in ((("--show", "contact", "--step", "1,2"), "b.h5.contact.png"), (("--step", "2"), "b.h5.png"),
                               (("minimum_gap_midplane", "minimum_gap_edge", "--together"), "b.h5.png")):
            self.assertEqual(call(self.folder, "b.h5", *words), (0, f"drawn: {picture}\n"))
        for words, text in ((("b.h5", "--step", "3"), "no step 3; there are 1 to 2"),
                            (("b.h5", "--show", "bumps"), "not a strip under loads")):
            status, said = call(self.folder, *words)
            self.assertEqual((status, text in said), (1, True), said)


class HeatTest(unittest.TestCase):
    """A made-up speed sweep with heat, whose third point is a fold, and a film."""

    speed = (1000.0, 2000.0, 3000.0, 2500.0)
    columns = {"power_loss": (10.0, 20.0, 40.0, 50.0), "heat_to_shaft": (-1.0, 2.0, 4.0, 5.0), "heat_to_top_foil": (10.0, 16.0, 32.0, 40.0),
               "heat_through_bumps": (10.0, 16.0, 32.0, 40.0), "heat_to_channel": (0.0,)*4, "heat_by_gas": (1.0, 2.0, 4.0, 5.0),
               "film_temperature": (300.0,)*4, "maximum_film_temperature": (310.0,)*4, "shaft_temperature": (310.0, 320.0, 350.0, 380.0),
               "running_clearance": (3.0e-5, 2.5e-5, 2.0e-5, 1.5e-5), "minimum_gap": (1.2e-5, 1.4e-5, 1.0e-5, 0.5e-5)}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plot_strip.pyplot.close, "all")
        self.folder = pathlib.Path(folder.name)

    def case(self, name, rows=slice(None), fold=True):
        """An open case file of some of the points."""
        file = h5py.File(self.folder/name, "w")
        self.addCleanup(file.close)
        file["scene/used"] = "&bearing\n  clearance = 3.2e-5\n/\n&sweep\n  parameter = 'speed_rpm'\n/\n"
        for column, values in self.columns.items():
            file[f"history/{column}"] = numpy.array(values)[rows]
            file[f"history/{column}"].attrs["unit"] = ""
        file["history/speed_rpm"] = numpy.array(self.speed)[rows]
        file["history/speed_rpm"].attrs["unit"] = "rpm"
        if fold:
            file["history/fold"] = (numpy.array(self.speed) == 3000.0)[rows].astype(float)
        file["summary/converged"] = float(fold)
        return file

    def test_bars_are_the_ways_of_the_heat(self):
        bars, levels = plot_heat.draw(pathlib.Path("a.h5"), self.case("a.h5"), [1], "speed_rpm").axes
        self.assertEqual([bar.get_width() for bar in bars.patches], [10.0, -1.0, 10.0, 1.0])  # nothing goes into a channel
        self.assertEqual([text.get_text().split()[-2:] for text in bars.texts[1:]], [["-10", "%"], ["100", "%"], ["10", "%"]])
        self.assertEqual([text.get_text() for text in levels.texts], ["300.0 K, at most 310.0 K", "310.0 K"])

    def test_a_held_top_foil_takes_what_nothing_carries_on(self):
        self.columns = self.columns | {"heat_through_bumps": (0.0,)*4}
        bars = plot_heat.draw(pathlib.Path("a.h5"), self.case("a.h5"), [2], "speed_rpm").axes[0]
        self.assertEqual([bar.get_width() for bar in bars.patches], [20.0, 2.0, 2.0, 16.0])
        self.assertEqual(bars.get_yticklabels()[-1].get_text(), "into the top foil, held")

    def test_runaway_is_where_a_hotter_shaft_turns_the_branch_back(self):
        charts = plot_heat.draw(pathlib.Path("a.h5"), self.case("a.h5"), [], "speed_rpm").axes
        words = [text.get_text() for text in charts[1].get_legend().get_texts()]
        self.assertEqual(words, ["running clearance", "thinnest film", "clearance, cold", "runaway: 3,000 rpm"])
        solid, pale = charts[1].lines[:2]
        numpy.testing.assert_allclose(solid.get_xydata(), [(1000.0, 30.0), (2000.0, 25.0), (3000.0, 20.0)])
        numpy.testing.assert_allclose(pale.get_xydata(), [(3000.0, 20.0), (2500.0, 15.0)])
        numpy.testing.assert_allclose(charts[3].lines[0].get_ydata(), (-10.0, 10.0, 10.0))  # part of the power, shaft
        self.columns = self.columns | {"shaft_temperature": (380.0, 350.0, 320.0, 310.0)}
        charts = plot_heat.draw(pathlib.Path("b.h5"), self.case("b.h5"), [], "speed_rpm").axes
        self.assertEqual(charts[1].get_legend().get_texts()[-1].get_text(), "turns back: 3,000 rpm")

    def test_a_sweep_that_ends_early_says_where(self):
        charts = plot_heat.draw(pathlib.Path("a.h5"), self.case("a.h5", slice(2), fold=False), [], "speed_rpm").axes
        self.assertEqual(charts[0].get_legend().get_texts()[-1].get_text(), "last answer: 2,000 rpm")

    def test_film_marks_its_hottest_place(self):
        theta, z = numpy.meshgrid(numpy.radians((0.0, 90.0, 180.0, 270.0)), (-0.01, 0.0, 0.01), indexing="ij")
        fields = {"temperature": (300.0 + 10.0*numpy.sin(theta) - 1.0e4*z**2, "K"), "heat_flux_shaft": (2.0e3*numpy.sin(theta), "W/m2")}
        with h5py.File(self.folder/"a.film.vtkhdf", "w") as file:
            file["VTKHDF/Points"] = numpy.column_stack((theta.ravel(), 0.0*z.ravel(), z.ravel()))
            file["VTKHDF/PointData/theta"] = theta.ravel()
            for name, (values, unit) in fields.items():
                file[f"VTKHDF/PointData/{name}"] = values.ravel()
                file[f"VTKHDF/PointData/{name}"].attrs["unit"] = unit
            charts = plot_heat.draw_film(self.folder/"a.film.vtkhdf", file).axes
        rings = [line.get_xydata().tolist() for line in charts[0].lines if line.get_marker() == "o"]
        numpy.testing.assert_allclose(rings, [[(90.0, 0.0)]], atol=1.0e-12)
        numpy.testing.assert_allclose(charts[3].lines[0].get_ydata(), (0.0, 2.0, 0.0, -2.0), atol=1.0e-12)  # kW/m2 at the midplane

    def test_calls(self):
        self.case("a.h5").close()
        with h5py.File(self.folder/"cold.h5", "w") as file:
            file["history/power_loss"], file["scene/used"] = [1.0], used(0.1)
        for words, text in ((("a.h5", "--show", "heat", "--step", "9"), "no point 9; there are 1 to 4"),
                            (("a.h5", "--show", "heat", "--step", "1,2"), "the heat of one point is drawn"),
                            (("a.h5", "minimum_gap", "--show", "heat"), "without columns"),
                            (("cold.h5", "--show", "heat"), "the case has no &thermal")):
            status, said = call(self.folder, *words)
            self.assertEqual((status, text in said), (1, True), f"{words}: {said}")
        self.assertEqual(call(self.folder, "a.h5", "--show", "heat"), (0, "drawn: a.h5.heat.png\n"))


class RotorTest(unittest.TestCase):
    """Made-up sweeps with a rotor: its modes over the speed, its critical mass over load and speed."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plot_rotor.pyplot.close, "all")
        self.folder = pathlib.Path(folder.name)

    def sweep(self, name, parameter, values, operation, modes=None, **columns):
        """A case file of gfb's shape; modes has a row a point of (growth, frequency, share)."""
        path = self.folder/name
        with h5py.File(path, "w") as file:
            file["scene/used"] = f"&operation\n  {operation}\n/\n&sweep\n  parameter = '{parameter}'\n/\n"
            file["history/converged"] = numpy.ones(len(values))
            file[f"history/{parameter}"] = numpy.array(values)
            file.create_group("summary")
            file.create_group("dynamics")
            for column, numbers in columns.items():
                file[f"history/{column}"] = numpy.array(numbers)
            if modes is not None:
                growth, frequency, share = numpy.moveaxis(numpy.array(modes), -1, 0)
                kind = numpy.ones(growth.shape)
                for key, field in (("frequency", frequency), ("shaft_share", share), ("kind", kind), ("sense", kind),
                                   ("damping_ratio", -growth/numpy.hypot(growth, frequency))):
                    file[f"dynamics/mode_{key}"] = field
                file["summary/onset_speed_rpm"] = 1500.0
        return path

    def test_modes_of_the_rotor_over_the_speed(self):
        path = self.sweep("a.h5", "speed_rpm", (1000.0, 2000.0), "load = -10.0, 0.0",
                          [[(-3.0, 40.0, 0.9), (-1.0, 50.0, 1.0e-5)], [(6.0, 80.0, 0.9), (-1.0, 50.0, 1.0e-5)]])
        with h5py.File(path) as file:
            above, below = plot_rotor.draw([path], [file], "campbell").axes
        shown = [line for line in below.lines if len(line.get_xdata()) == 2 and line.get_marker() == "o"]
        self.assertEqual(len(shown), 1)
        numpy.testing.assert_allclose(shown[0].get_ydata(), (3.0/numpy.hypot(3.0, 40.0), -6.0/numpy.hypot(6.0, 80.0)))
        self.assertEqual(above.get_ylabel(), "frequency [Hz]")

    def test_a_branch_goes_on_as_it_came(self):
        """A mode that rises fast is followed past one that is nearer, by its last two points; one that goes round the other way is farther."""
        speed = numpy.array([10.0, 20.0, 30.0, 40.0, 50.0, 60.0])
        rate = numpy.array([[-56.0 + 734.0j, -115.0 + 1573.0j], [-50.0 + 874.0j, -96.0 + 1533.0j], [-48.0 + 1054.0j, -87.0 + 1564.0j],
                            [-42.0 + 1141.0j, -83.0 + 1592.0j], [-38.0 + 1258.0j, -85.0 + 1630.0j], [-28.0 + 1479.0j, -87.0 + 1772.0j]])
        flat, there = numpy.zeros(rate.shape), numpy.ones(rate.shape, bool)
        way = [(point, mode) for mode in range(2) for point in range(6)]
        self.assertEqual(sum(plot_rotor.branches(speed, rate, flat, flat, there), []), way)
        crossed = numpy.array([[-1.0 + 100.0j, -1.0 + 110.0j], [-1.0 + 106.0j, -1.0 + 103.0j]])
        for sense, other in ((numpy.array([[1.0, -1.0], [1.0, -1.0]]), 0), (numpy.array([[1.0, -1.0], [-1.0, 1.0]]), 1)):
            found = plot_rotor.branches(speed[:2], crossed, sense, flat[:2], there[:2])
            self.assertEqual(found, [[(0, 0), (1, other)], [(0, 1), (1, 1 - other)]])

    def test_branches_follow_the_modes_whatever_their_order(self):
        """Two modes change places in the list, one is there at one speed alone, one is the foil's."""
        rows = [[(-3.0, 40.0, 0.9), (-5.0, 90.0, 0.9), (-0.1, 60.0, 1.0e-4)], [(-2.0, 92.0, 0.9), (-4.0, 45.0, 0.9), (-0.1, 61.0, 1.0e-4)],
                [(-1.0, 94.0, 0.9), (-6.0, 50.0, 0.9), (-40.0, 300.0, 0.9)]]
        path = self.sweep("a.h5", "speed_rpm", (3000.0, 4000.0, 5000.0), "load = -10.0, 0.0", rows)
        with h5py.File(path, "r+") as file:
            file["dynamics/mode_foil_share"] = numpy.where(file["dynamics/mode_shaft_share"][...] < 0.5, 0.9, 0.01)
            owners = file["dynamics/mode_shaft_share"][...] > 0.5
            self.assertTrue((plot_rotor.of_rotor(plot_rotor.read_modes(file["dynamics"])) == owners).all())
            file["dynamics/mode_shaft_share"][...] = 0.5  # the owner is what counts where it is told
            file["dynamics/mode_owner"] = numpy.where(owners, plot_rotor.ROTOR, plot_rotor.FOIL).astype(float)
            above, _ = plot_rotor.draw([path], [file], "campbell").axes
        ways = [tuple(2.0*numpy.pi*line.get_ydata()) for line in above.lines if line.get_label().startswith("_") and line.get_marker() == "None"]
        self.assertEqual([numpy.round(way, 9).tolist() for way in ways if len(way) == 3], [[40.0, 45.0, 50.0], [90.0, 92.0, 94.0]])
        (foil,) = [line for line in above.lines if line.get_label() == "of the foil"]
        numpy.testing.assert_allclose(foil.get_xydata(), [(3000.0, 60.0/(2.0*numpy.pi)), (4000.0, 61.0/(2.0*numpy.pi))])
        (speed,) = [line for line in above.lines if line.get_label() == "running speed"]
        numpy.testing.assert_allclose(speed.get_ydata(), speed.get_xdata()/60.0)  # Hz

    def test_coefficients_next_to_a_foil_mode_are_not_joined(self):
        """A peak of 2 rad/s between points 100 rad/s apart is not seen: no line leads past it; one of 200 rad/s is, and any where the
        program has put frequencies until lines are right."""
        path = self.folder/"a.h5"
        for growth, miss, known in ((-1.0, None, False), (-100.0, None, True), (-1.0, 0.02, True), (-1.0, numpy.nan, False)):
            with h5py.File(path, "w") as file:
                for name, value in {"frequency": [100.0, 200.0, 300.0], "stiffness": numpy.arange(48.0).reshape(3, 4, 4)*1.0e6,
                                    "damping": numpy.ones((3, 4, 4)), "mode_frequency": [250.0, 150.0], "mode_shaft_share": [1.0e-4, 0.9],
                                    "mode_foil_share": [0.9, 1.0e-3], "mode_kind": [1.0, 1.0], "mode_sense": [1.0, 1.0],
                                    "mode_damping_ratio": [-growth/numpy.hypot(growth, 250.0), 0.1]}.items():
                    file[f"dynamics/{name}"] = value
                if miss is not None:
                    file["dynamics/interpolation_miss"] = [miss]
                file["scene/used"] = "&operation\n  speed_rpm = 2000.0 ! [rpm]\n/\n"
                file["history/whirl_ratio"] = [0.5]
                chart = plot_dynamics.draw(path, file).axes[0]
            expected = [0.0, 16.0, 32.0] if known else [0.0, 16.0, numpy.nan, 32.0]
            numpy.testing.assert_array_equal(chart.lines[0].get_ydata(), expected)
            marks = {line.get_label(): line.get_xdata()[0] for line in chart.lines}
            self.assertAlmostEqual(marks["mode of the foil"], 250.0)
            self.assertAlmostEqual(marks["running speed"], 2000.0*numpy.pi/30.0)
            self.assertAlmostEqual(marks["whirl of the critical mass"], 1000.0*numpy.pi/30.0)
            self.assertEqual(bool(chart.patches), not known)

    def test_members_of_a_sample_are_counted_and_summed_up(self):
        path, gaps = self.folder/"sample.h5", numpy.array([4.0e-6, numpy.nan, 2.0e-6, 3.0e-6])
        with h5py.File(path, "w") as file:
            file["history/seed"], file["history/minimum_gap"] = numpy.arange(4), gaps
            file["history/minimum_gap"].attrs["unit"] = "m"
            file["sample/quantiles"], file["sample/minimum_gap/quantiles"] = [[0.5]], [[3.0e-6]]
            file["sample/minimum_gap/mean"] = [[3.0e-6]]
            bars, steps = plot_sample.draw(path, file).axes
        self.assertEqual(sum(bar.get_height() for bar in bars.patches), 3)
        numpy.testing.assert_allclose(bars.lines[0].get_xdata(), 3.0)
        numpy.testing.assert_allclose(steps.lines[0].get_xydata(), [(2.0, 1/3), (3.0, 2/3), (4.0, 1.0)])
        numpy.testing.assert_allclose(steps.lines[1].get_xydata(), [(3.0, 0.5)])
        self.assertIn("no statistics of gap", call(self.folder, "sample.h5", "gap")[1])

    def test_map_takes_load_or_speed_from_sweep_or_case(self):
        paths = [self.sweep(f"{speed}.h5", "load", (10.0, 20.0, 30.0), f"speed_rpm = {speed}.0",
                            critical_mass=(1.0, 2.0, numpy.nan), whirl_ratio=(0.5, 0.4, numpy.nan))
                 for speed in (1000, 2000)]
        files = [h5py.File(path) for path in paths]
        chart = plot_rotor.draw(paths, files, "map").axes[0]
        points, crosses = (line.get_xydata() for line in chart.lines if line.get_marker() in (".", "x"))
        numpy.testing.assert_allclose(sorted(map(tuple, points)), [(1000, 10), (1000, 20), (2000, 10), (2000, 20)])
        numpy.testing.assert_allclose(sorted(map(tuple, crosses)), [(1000, 30), (2000, 30)])
        for file in files:
            file.close()

    def test_calls(self):
        self.sweep("load.h5", "load", (10.0, 20.0), "speed_rpm = 1000.0", critical_mass=(1.0, 2.0),
                   whirl_ratio=(0.5, 0.4))
        for words, text in ((("load.h5", "--show", "campbell"), "needs a sweep over speed_rpm with &rotor"),
                            (("load.h5", "--show", "map"), "needs two loads, two speeds")):
            status, said = call(self.folder, *words)
            self.assertEqual((status, text in said), (1, True), said)


class PlotTest(unittest.TestCase):
    """The made-up strip: two bumps, four steps up to 30 N and down again."""

    force = (10.0, 30.0, 12.0, 0.0)
    deflection = ((1.0e-6, 2.0e-6), (3.0e-6, -6.0e-6), (2.0e-6, 5.0e-6), (0.0, 0.0))
    travel = (1.5e-6, 4.5e-6, 4.0e-6, 0.0)
    states = [[[0, 0, 0], [1, 1, 0], [1, 2, 0]], [[0, 0, 0], [2, 2, 0], [1, 2, 2]],
              [[0, 0, 0], [1, 2, 0], [1, 1, 1]], [[0, 0, 0], [0, 0, 0], [0, 0, 0]]]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plot_strip.pyplot.close, "all")
        self.folder = pathlib.Path(folder.name)
        self.loop = strip_file(self.folder/"a_strip.h5", self.force, self.deflection, used(0.0), self.travel,
                               self.states)
        self.up = strip_file(self.folder/"a_strip_up.h5", self.force[:2], self.deflection[:2], used(0.1))

    def figure(self, paths, kind=None, steps=()):
        """A picture drawn in this process."""
        files = [h5py.File(path, "r") for path in paths]
        try:
            return plot_strip.draw(paths, files, kind, list(steps))
        finally:
            for file in files:
                file.close()

    def test_bars_are_the_deflections_at_the_largest_force(self):
        axes = self.figure([self.loop, self.up], "bumps").axes[0]
        heights = [[bar.get_height() for bar in bars] for bars in axes.containers if len(bars)]
        numpy.testing.assert_allclose(heights, [[3.0, -6.0], [3.0, -6.0]], rtol=1e-12)
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()],
                         ["friction_sleeve = 0.0", "friction_sleeve = 0.1"])

    def test_bars_of_a_step(self):
        axes = self.figure([self.loop], "bumps", [3]).axes[0]
        numpy.testing.assert_allclose([bar.get_height() for bar in axes.containers[0]], [2.0, 5.0], rtol=1e-12)
        self.assertIn("step 3", axes.get_title())

    def test_loop_starts_unloaded_and_shows_the_lost_work(self):
        chart, opened = self.figure([self.loop]).axes
        numpy.testing.assert_allclose(chart.lines[0].get_xdata(), [0.0, 1.5, 4.5, 4.0, 0.0], rtol=1e-12)
        numpy.testing.assert_allclose(chart.lines[0].get_ydata(), [0.0, *self.force])
        numpy.testing.assert_allclose(opened.lines[0].get_ydata(), [0.0, 0.0, 0.0, 12.0 - 30.0*4.0/4.5, 0.0],
                                      atol=1e-12)
        self.assertIn("2.5 mJ", chart.get_legend().get_texts()[0].get_text())
        self.assertIn("plate", chart.get_xlabel())

    def test_without_plates_the_largest_crest_deflection_moves(self):
        chart = self.figure([self.up], "loop").axes[0]
        numpy.testing.assert_allclose(chart.lines[0].get_xdata(), [0.0, 2.0, 3.0], rtol=1e-12)
        self.assertIn("crest", chart.get_xlabel())

    def test_what_is_drawn_unasked_follows_the_load(self):
        self.assertEqual(len(self.figure([self.loop]).axes), 2)
        self.assertEqual(len(self.figure([self.loop, self.up]).axes), 1)

    def test_contact_map_is_the_whole_width_without_the_held_line(self):
        chart = self.figure([self.loop], "contact", [2]).axes[0]
        columns = [mesh.get_array().ravel().tolist() for mesh in chart.collections]
        self.assertEqual(columns, [[0, 2, 2, 2, 0], [2, 2, 1, 2, 2]])
        self.assertEqual([tick.get_text() for tick in chart.get_xticklabels()], ["2", "3"])
        self.assertAlmostEqual(chart.collections[0].get_coordinates()[0, 0, 1], -10.0)

    def test_contact_map_has_a_row_a_step(self):
        titles = [chart.get_title() for chart in self.figure([self.loop], "contact", [1, 3]).axes]
        self.assertEqual(titles, ["step 1, 10 N: sleeve", "step 3, 12 N: sleeve"])

    def test_files_that_differ_in_nothing_are_told_apart_by_name(self):
        other = strip_file(self.folder/"b.h5", self.force, self.deflection, used(0.0), self.travel)
        with h5py.File(self.loop) as one, h5py.File(other) as two:
            self.assertEqual(plot_strip.labels([self.loop, other], [one, two]), ["a_strip", "b"])

    def test_a_key_that_one_file_leaves_to_its_default_is_in_the_label(self):
        other = strip_file(self.folder/"b.h5", self.force, self.deflection, used(0.0, "'coulomb' ! law"))
        with h5py.File(self.loop) as one, h5py.File(other) as two:
            self.assertEqual(plot_strip.labels([self.loop, other], [one, two]),
                             ["friction_law = 'tanh_drag'", "friction_law = 'coulomb'"])

    def test_calls(self):
        for words, picture in ((("a_strip.h5",), "a_strip.h5.png"),
                               (("a_strip.h5", "a_strip_up.h5", "-o", "b.png"), "b.png"),
                               (("a_strip.h5", "--show", "contact", "--step", "1,2", "-o", "c.png"), "c.png"),
                               (("a_strip.h5", "force", "plate_travel", "-o", "d.png"), "d.png")):
            status, said = call(self.folder, *words)
            self.assertEqual((status, said), (0, f"drawn: {picture}\n"))
            self.assertEqual((self.folder/picture).read_bytes()[:4], b"\x89PNG")
        status, said = call_command(self.folder, "a_strip.h5", "--list")
        self.assertEqual((status, "plate_travel" in said), (0, True))
        self.assertEqual(call_command(self.folder, "a_strip.h5"), (0, "drawn: a_strip.h5.png\n"))

    def test_wrong_calls_are_told(self):
        for words, text in ((("none.h5",), "there is no such file"),
                            (("a_strip.h5", "none.h5"), "there is no such file"),
                            (("a_strip.h5", "torque"), "no column torque"),
                            (("a_strip.h5", "a_strip_up.h5", "force"), "columns are drawn of one file"),
                            (("a_strip.h5", "--show", "bumps", "--step", "5"), "no step 5; there are 1 to 4"),
                            (("a_strip.h5", "--show", "loop", "--step", "2"), "a loop is of all steps"),
                            (("a_strip.h5", "a_strip_up.h5", "--show", "contact"), "one file at a time"),
                            (("a_strip_up.h5", "--show", "contact"), "no contacts")):
            status, said = call(self.folder, *words)
            self.assertEqual((status, text in said), (1, True), f"{words}: {said}")
        status, said = call_command(self.folder, "none.h5")
        self.assertEqual((status, "there is no such file" in said), (1, True), said)
        status, said = call(self.folder, "a_strip.h5", "--step", "two")
        self.assertEqual((status, "whole numbers" in said), (2, True), said)

    def test_map_of_gfb_agrees_with_its_counts(self):
        for edge in ("none", "leading"):
            case = self.folder/f"small_{edge}.nml"
            case.write_text(SMALL.format(edge=edge), encoding="utf-8")
            subprocess.run([os.environ["GFB"], "--output", self.folder, case], check=True,
                           stdout=subprocess.DEVNULL)
            slipping = 0
            with h5py.File(case.with_suffix(".h5"), "r") as file:
                for surface in ("sleeve", "top"):
                    _, z, node = plot_contact.line_table(file[f"contact/{surface}"])
                    told = sum(file[f"history/{surface}_{word}"][0] for word in ("open", "stick", "slip"))
                    whole = told < node.size  # the history counts the nodes of the half that was solved
                    for row, state in enumerate(file[f"contact/{surface}/state"][...]):
                        solved = state[node][:, z > -1.0e-12] if whole else state[node]
                        found = [int(numpy.count_nonzero(solved == value)) for value in range(3)]
                        told = [int(file[f"history/{surface}_{word}"][row]) for word in ("open", "stick", "slip")]
                        self.assertEqual(found, told, f"{edge}, {surface}, step {row + 1}")
                        slipping += found[2]
            self.assertGreater(slipping, 0)
            self.assertEqual(call(self.folder, f"small_{edge}.h5", "--show", "contact")[0], 0)

    def test_arrows_follow_the_loop(self):
        for chart in self.figure([self.loop]).axes:
            arrows = [(mark.xyann[0], mark.xy[0]) for mark in chart.texts if mark.arrow_patch is not None]
            self.assertEqual(len(arrows), 2)
            self.assertLess(arrows[0][0], arrows[0][1])     # travel grows
            self.assertGreater(arrows[1][0], arrows[1][1])  # and shrinks


if __name__ == "__main__":
    unittest.main()
