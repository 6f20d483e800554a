"""Tests of tools/plot on what moves or is rolled up: steps of a sweep, a shaft in time, film and foils in 3D, animations.

The shaft's motion is made up, so that its spectrum and its points once a turn are known; film and foils are gfb's own.
"""

import importlib.util
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy
from PIL import Image

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path[:0] = [str(PROJECT/"tools"), str(pathlib.Path(__file__).parent)]

import gfb  # noqa: E402 (found only now)
from gfb import steps  # noqa: E402
from gfb.plot import animation, clearance, rolled, scene, transient  # noqa: E402
from gfb.results import used_keys  # noqa: E402
from plot_test import BEAMS, call  # noqa: E402

CLEARANCE, RADIUS = 31.8e-6, 19.05e-3
SPEEDS = (20000.0, 30000.0)
ECHO = (f"&bearing\n  radius = {RADIUS} ! [m]\n  clearance = {CLEARANCE} ! [m]\n/\n"
        "&bump_foil\n  pitch = 4.572e-3 ! [m]\n  bumps = 26 ! [1]\n  half_length = 1.778e-3 ! [m]\n/\n")


def shaft_file(path, speed=(200.0, 1200.0), circle=2.0e-6, whirl=0.0, instants=20001, seconds=2.0):
    """A shaft that runs up, on a circle once a turn and one every other turn."""
    time = numpy.linspace(0.0, seconds, instants)
    slope = (speed[1] - speed[0])/seconds
    angle = speed[0]*time + 0.5*slope*time**2
    x = 10.0e-6 + circle*numpy.cos(angle) + whirl*numpy.cos(0.5*angle)
    y = 4.0e-6 + circle*numpy.sin(angle) + whirl*numpy.sin(0.5*angle)
    columns = {"time": (time, "s"), "turns": (angle/(2.0*math.pi), "1"), "speed": (speed[0] + slope*time, "rad/s"),
               "eccentricity_x": (x, "m"), "eccentricity_y": (y, "m"), "minimum_gap": (CLEARANCE - numpy.hypot(x, y), "m")}
    with h5py.File(path, "w") as file:
        for name, (values, unit) in columns.items():
            file[f"transient/{name}"] = values
            file[f"transient/{name}"].attrs.update(unit=unit, meaning="made up")
        file["scene/used"] = ECHO
        if angle[-1] >= 4.0*math.pi:
            speeds = numpy.array((speed[0], numpy.mean(speed), speed[1]) if seconds > 1.0 else speed[:1])
            ratio = numpy.arange(0.0, 8.1, 0.125)
            line = circle*(ratio == 1.0) + whirl*(ratio == 0.5)  # as the program's own tests have it
            for name, values in (("speed", speeds), ("time", seconds*(numpy.arange(len(speeds)) + 0.5)/len(speeds)),
                                 ("frequency", speeds[:, None]/(2.0*math.pi)*ratio), ("amplitude_y", line + 0.0*speeds[:, None])):
                file[f"spectrum/{name}"] = values
    return path


class ShaftTest(unittest.TestCase):
    """A shaft in time."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def chart(self, path, kind):
        """The axes of a picture."""
        with h5py.File(path, "r") as file:
            return transient.draw(path, file, kind).axes

    def test_orbit_is_the_shaft_in_its_bearing(self):
        path = shaft_file(self.folder/"a.h5", circle=8.0e-6)
        with h5py.File(path, "r+") as file:  # two crests with two nodes each, a line that is held, and 26 bumps in the echo
            for name, values in (("line", (1.0, 1.0, 0.0, 2.0, 2.0)), ("position_x", (2.0e-3, 2.0e-3, 3.0e-3, 7.0e-3, 7.0e-3))):
                file[f"contact/top/{name}"] = values
        chart, = self.chart(path, "orbit")
        way = next(line for line in chart.lines if len(line.get_xdata()) == 20001)
        numpy.testing.assert_allclose([way.get_xdata().mean(), way.get_ydata().mean()], [-10.0, -4.0], atol=0.4)
        lines = {line.get_label(): line for line in chart.lines}
        numpy.testing.assert_allclose(numpy.hypot(*lines["clearance"].get_data()), 31.8, rtol=1e-12)
        self.assertAlmostEqual(lines["pad edges"].get_ydata()[0], 0.0)
        marks = chart.lines[chart.lines.index(lines["bumps"]):][:2]
        places = [math.atan2(line.get_ydata()[0], line.get_xdata()[0])*RADIUS for line in marks]
        numpy.testing.assert_allclose(places, (2.0e-3, 7.0e-3), atol=1e-10)
        self.assertEqual([len(line.get_xdata()) for line in chart.lines].count(2), 2 + 2)  # crests, and the pad's two edges

    def test_a_small_orbit_is_drawn_once_more_and_larger(self):
        large, = self.chart(shaft_file(self.folder/"a.h5", circle=3.4e-6), "orbit")  # 6.8 um of 31.8
        self.assertFalse(large.patches)
        chart, larger = self.chart(shaft_file(self.folder/"b.h5", circle=3.0e-6), "orbit")
        numpy.testing.assert_allclose([larger.get_xlim(), larger.get_ylim()], [(-13.6, -6.4), (-7.6, -0.4)], atol=0.01)
        square, = chart.patches
        numpy.testing.assert_allclose((*square.get_xy(), square.get_width()), (-13.6, -7.6, 7.2), atol=0.01)
        whole = next(line for line in larger.lines if len(line.get_xdata()) == 20001)
        self.assertAlmostEqual(numpy.ptp(whole.get_xdata()), 6.0, places=4)
        self.assertEqual(len(self.chart(self.folder/"b.h5", None)), 3)
        still = shaft_file(self.folder/"still.h5", circle=0.0)
        self.assertAlmostEqual(numpy.ptp(self.chart(still, "orbit")[1].get_xlim()), 2.0e-4*31.8)

    def test_points_once_a_turn(self):
        chart, = self.chart(shaft_file(self.folder/"a.h5"), "bifurcation")
        for line, place in zip(chart.lines, (-12.0, -4.0)):  # at whole turns the circle's angle is 0
            numpy.testing.assert_allclose(line.get_ydata(), place, atol=0.02)
        chart, = self.chart(shaft_file(self.folder/"b.h5", whirl=3.0e-6), "bifurcation")
        found = chart.lines[0].get_ydata()                   # two points by turns: +-3 um
        numpy.testing.assert_allclose([found[0::2].mean(), found[1::2].mean()], [-15.0, -9.0], atol=0.05)

    def test_spectra_are_those_of_the_file(self):
        path = shaft_file(self.folder/"a.h5", speed=(600.0, 600.0), whirl=1.0e-6)
        chart, = self.chart(path, "waterfall")
        self.assertEqual((len(chart.lines), chart.get_ylabel()), (3 + 2, "time [s]"))  # the speed stays
        self.assertIn("over 8 turns", chart.get_title())
        chart, = self.chart(shaft_file(self.folder/"b.h5"), "waterfall")
        self.assertEqual(chart.get_ylabel(), "speed [rpm]")
        short = shaft_file(self.folder/"c.h5", speed=(600.0, 600.0), seconds=0.08, whirl=1.0e-6)
        chart, = self.chart(short, "waterfall")
        self.assertEqual(chart.get_ylabel(), "amplitude of e_y [um]")
        for ratio, height in ((1.0, 2.0), (0.5, 1.0)):
            shown = chart.lines[0]
            near = abs(shown.get_xdata() - ratio*600.0/(2.0*math.pi)) < 1.0
            self.assertAlmostEqual(shown.get_ydata()[near].max(), height)

    def test_lower_spectra_stand_in_front(self):
        """Whether the shaft runs up or coasts down, the white below a line hides nothing of those in front of it."""
        for speed in ((200.0, 1200.0), (1200.0, 200.0)):
            chart = self.chart(shaft_file(self.folder/"a.h5", speed=speed), "waterfall")[0]
            foot = [line.get_ydata()[-1] for line in chart.lines[:3]]  # behind the peaks a line is at its speed
            numpy.testing.assert_allclose(foot, numpy.array((speed[0], 700.0, speed[1]))*30.0/math.pi)
            depth = numpy.array([(line.get_zorder(), fill.get_zorder()) for line, fill in zip(chart.lines, chart.collections)])
            order = depth[numpy.argsort(foot)[::-1]].ravel()[[1, 0, 3, 2, 5, 4]]
            self.assertTrue((numpy.diff(order) > 0.0).all(), order)  # from the highest down: white, line, white, ...
            (self.folder/"a.h5").unlink()

    def test_whirl_does_not_hide_unbalance(self):
        """Heights are roots, as the axis at the right has them: a peak of a hundredth is seen."""
        path = shaft_file(self.folder/"a.h5", speed=(600.0, 1200.0))
        with h5py.File(path, "r+") as file:
            file["spectrum/amplitude_y"][...] *= numpy.array((0.01, 0.05, 1.0))[:, None]
        chart = self.chart(path, "waterfall")[0]
        peaks = [numpy.ptp(line.get_ydata()) for line in chart.lines[:3]]
        apart = 300.0*30.0/math.pi
        numpy.testing.assert_allclose(peaks, transient.TALLEST*apart*numpy.sqrt((0.01, 0.05, 1.0)), rtol=1e-12)
        self.assertGreater(peaks[0], 0.3*apart)
        axis, = chart.child_axes
        self.assertIn("root", axis.get_ylabel())
        self.assertEqual([text.get_text() for text in axis.get_yticklabels()], ["0", "0.1", "0.5", "2"])
        numpy.testing.assert_allclose(axis.get_yticks() - 600.0*30.0/math.pi, peaks[2]*numpy.sqrt((0.0, 0.05, 0.25, 1.0)), atol=1e-9)

    def test_thinnest_film(self):
        chart, = self.chart(shaft_file(self.folder/"a.h5"), "thinnest")
        self.assertAlmostEqual(chart.lines[1].get_ydata()[0], 31.8 - math.hypot(10.0, 4.0) - 2.0, delta=0.01)

    def test_two_bearings(self):
        """A rotor that tilts: the orbit of each journal, the thinnest film of each bearing."""
        path = shaft_file(self.folder/"a.h5")
        with h5py.File(path, "r+") as file:
            for number, shift in ((1, 3.0e-6), (2, -3.0e-6)):
                for name in ("eccentricity_x", "eccentricity_y", "minimum_gap"):
                    file[f"transient/{name}_{number}"] = file[f"transient/{name}"][...] + shift
            file.move("spectrum/amplitude_y", "spectrum/amplitude_y_1")
        orbit, = self.chart(path, "orbit")
        words = [text.get_text() for text in orbit.get_legend().get_texts()]
        self.assertTrue({"bearing at +z", "bearing at -z"} <= set(words), words)
        whole = [line for line in orbit.lines if len(line.get_xdata()) == 20001]
        for line, shift in zip(whole, (3.0, -3.0)):
            self.assertAlmostEqual(line.get_xdata()[0], -12.0 - shift, delta=0.01)
        self.assertEqual(len(whole), 2)
        thinnest, = self.chart(path, "thinnest")
        self.assertAlmostEqual(thinnest.lines[1].get_ydata()[0] - thinnest.lines[0].get_ydata()[0], -6.0, delta=0.01)
        spectrum, = self.chart(path, "waterfall")
        self.assertIn("at +z", spectrum.get_title())
        with unittest.mock.patch.object(animation, "FRAMES", 4):
            self.assertEqual(call(self.folder, "a.h5", "--animate"), (0, "drawn: a.h5.gif\n"))

    def test_the_load_and_the_thinnest_film_are_seen(self):
        """An arrow along the load; of the moving picture a ring beside the clearance in the direction of the shaft's centre."""
        path = shaft_file(self.folder/"a.h5")
        with h5py.File(path, "r+") as file:
            del file["scene/used"]
            file["scene/used"] = ECHO + "&operation\n  load = -30.0, 40.0 ! [N]\n/\n"
        chart = self.chart(path, "orbit")[0]
        (arrow,) = chart.texts
        numpy.testing.assert_allclose(numpy.array(arrow.xy)/numpy.hypot(*arrow.xy), (-0.6, 0.8))
        self.assertIn("load on the shaft", [text.get_text() for text in chart.get_legend().get_texts()])
        with h5py.File(path, "r") as file:
            figure, frame, frames, _ = animation.of_orbit(path, file)
            frame(frames - 1)
            e = numpy.array([file[f"transient/eccentricity_{axis}"][-1] for axis in "xy"])
        (ring,) = [line for line in figure.axes[0].lines if str(line.get_label()).startswith("thinnest film")]
        place = numpy.concatenate(ring.get_data())
        numpy.testing.assert_allclose(place/numpy.hypot(*place), -e/numpy.hypot(*e), atol=1e-2)  # an aligned ring is thinnest there
        self.assertAlmostEqual(numpy.hypot(*place), animation.BESIDE*1.0e6*CLEARANCE)
        self.assertIn(f"film {1.0e6*(CLEARANCE - numpy.hypot(*e)):.3g} um", figure._suptitle.get_text())

    def test_calls(self):
        shaft_file(self.folder/"a.h5", instants=3001)
        shaft_file(self.folder/"short.h5", instants=30, seconds=1.0e-3)
        shaft_file(self.folder/"instant.h5", instants=2)
        self.assertEqual(call(self.folder, "a.h5"), (0, "drawn: a.h5.png\n"))
        for kind in transient.KINDS:
            self.assertEqual(call(self.folder, "a.h5", "--show", kind), (0, f"drawn: a.h5.{kind}.png\n"))
        with unittest.mock.patch.object(animation, "FRAMES", 6):
            self.assertEqual(call(self.folder, "a.h5", "--animate"), (0, "drawn: a.h5.gif\n"))
        with Image.open(self.folder/"a.h5.gif") as film:
            self.assertEqual((film.n_frames, film.width), (6, 960))  # the orbit is small: it is there twice
        for words, said in ((("short.h5", "--show", "waterfall"), "less than two turns"),
                            (("short.h5", "--show", "bifurcation"), "less than two turns"),
                            (("instant.h5",), "no more than 2 instants"),
                            (("a.h5", "--animate", "--show", "orbit"), "goes without"),
                            (("a.h5", "--3d"), "no a.film.vtkhdf")):
            status, found = call(self.folder, *words)
            self.assertEqual((status, said in found), (1, True), found)


class ClearanceTest(unittest.TestCase):
    """Where pads, bumps and the limit of the shaft are, beside what gfb itself has."""

    LAYOUTS = {  # keys of &bump_foil and the like; where the first crest is
        "trailing": ("fixed_edge = 'trailing'", 2.0*math.pi*RADIUS - 25*4.572e-3 - 1.778e-3),
        "leading": ("fixed_edge = 'leading'", 1.778e-3),
        "flat": ("fixed_edge = 'leading' fixed_line = 'flat'", 4.572e-3 - 1.778e-3),
        "half_flat": ("fixed_line = 'half_flat'", 2.0*math.pi*RADIUS - 25.5*4.572e-3),
        "lists": ("fixed_edge = 'leading' bump_pitch = 13*4.4e-3, 13*4.6e-3 bump_half_length = 13*1.7e-3, 13*1.8e-3", 1.7e-3),
        "strips": ("fixed_edge = 'leading' strips = 2 cut_width = 1.0e-3 strip_offset = 0.0, 0.5e-3", 1.778e-3)}

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)

    def run_case(self, name, case):
        """A case's result file and the keys of its echo."""
        (self.folder/f"{name}.nml").write_text(case, encoding="utf-8")
        subprocess.run([os.environ["GFB"], "--output", self.folder, self.folder/f"{name}.nml"], check=True, stdout=subprocess.DEVNULL)
        file = h5py.File(self.folder/f"{name}.h5", "r")
        self.addCleanup(file.close)
        return file, used_keys(file)

    def rest_gap(self, name):
        """theta and the gap at rest that the program itself has there; where each pad begins."""
        with h5py.File(self.folder/f"{name}.film.vtkhdf", "r") as film, h5py.File(self.folder/f"{name}.h5", "r") as file:
            fields = {field: data[...] for field, data in film["VTKHDF/PointData"].items()}
            e = [file[f"summary/eccentricity_{axis}"][()] for axis in "xy"]
        theta = fields["theta"]
        gap = fields["gap"] - fields["deflection"] - e[0]*numpy.cos(theta) - e[1]*numpy.sin(theta)
        pad = fields.get("pad", numpy.ones(len(theta)))
        return theta, gap, [theta[pad == number].min() for number in numpy.unique(pad)]

    def crests_in(self, path):
        """x of the crests at both ends in a bump foil's file: stations that are higher than their neighbours."""
        with h5py.File(path, "r") as file:
            points = file["VTKHDF/Points"][...]
        found = set()
        for z in (points[:, 2].min(), points[:, 2].max()):  # of two strips both
            line = points[points[:, 2] == z]
            line = line[numpy.argsort(line[:, 0])]
            high = line[:, 1]
            found |= set(numpy.round(line[1:-1, 0][(high[1:-1] > high[:-2]) & (high[1:-1] > high[2:])], 12))
        return sorted(found)

    def test_crests_are_those_of_the_program(self):
        for name, (words, first) in self.LAYOUTS.items():
            case = BEAMS.replace("bumps = 26 /", f"bumps = 26 {words} /").replace("25.0e-6, 8.0e-6", "5.0e-6, 3.0e-6")
            if name == "lists":
                case = case.replace("half_length = 1.778e-3\n", "\n").replace("pitch = 4.572e-3 bumps", "bumps")
            if name == "strips":
                case = case.replace("foil = 'beam'", "foil = 'shell'")
            if "leading" in words:
                case = case.replace("poissons_ratio = 0.29 /\n&bump_foil", "poissons_ratio = 0.29 fixed_edge = 'leading' /\n&bump_foil")
            with self.subTest(name):
                crests = clearance.crests_of(*self.run_case(name, case))
                self.assertEqual(len(crests), 52 if name == "strips" else 26)
                self.assertAlmostEqual(RADIUS*crests[0], first, delta=1e-10)
                numpy.testing.assert_allclose(RADIUS*crests, self.crests_in(self.folder/f"{name}.bump_foil.vtkhdf"), atol=1e-10)

    def test_several_pads_with_a_preload(self):
        pads = "&pads count = 3 first_leading_edge = 0.3 gap = 0.1 preload = 0.3 preload_offset = 0.6 /\n"
        case = BEAMS.replace("bumps = 26", "bumps = 8").replace("25.0e-6, 8.0e-6", "3.0e-6, 2.0e-6") + pads
        file, keys = self.run_case("pads", case)
        theta, gap, begins = self.rest_gap("pads")
        bearing = clearance.bearing_of(keys)
        numpy.testing.assert_allclose(bearing.begins, begins, rtol=1e-12)
        crests = numpy.concatenate([begin + numpy.array(self.crests_in(self.folder/f"pads.bump_foil_{number}.vtkhdf"))/RADIUS
                                    for number, begin in enumerate(begins, 1)])
        numpy.testing.assert_allclose(clearance.crests_of(file, keys), crests, atol=2e-9)
        angle = numpy.linspace(0.0, 2.0*math.pi, 200)
        across = numpy.cos(theta[:, None] - angle)
        touches = numpy.where(across > 0.1, gap[:, None]/numpy.maximum(across, 0.1), numpy.inf).min(axis=0)
        # Between the film's nodes a pad is nearer by the square of half an element at most.
        step = 0.5*numpy.diff(numpy.unique(theta)).max()
        numpy.testing.assert_allclose(bearing.limit(angle), touches, rtol=1.5*step**2)
        self.assertLess(bearing.limit(angle).min(), 0.75*CLEARANCE)
        self.assertTrue((bearing.limit(angle) <= touches*(1.0 + 1e-9)).all())
        with h5py.File(self.folder/"pads.film.vtkhdf", "r") as film:  # its gap without the foils' deflection is that of the shaft at -e
            rigid = film["VTKHDF/PointData/gap"][...] - film["VTKHDF/PointData/deflection"][...]
        self.assertAlmostEqual(bearing.thinnest(-file["summary/eccentricity_x"][()], -file["summary/eccentricity_y"][()]),
                               theta[numpy.argmin(rigid)], delta=step)

    def test_pads_as_they_may_be_given(self):
        def bearing(pads="", edge=0.0, condition="slit"):
            lines = [f"&bearing\n  radius = {RADIUS} !\n  clearance = {CLEARANCE} !\n  leading_edge_angle = {edge} !\n"
                     f"  leading_edge_condition = '{condition}' !\n/\n&pads\n", *(f"  {line}\n" for line in pads.split(";")), "/\n"]
            with h5py.File(self.folder/"keys.h5", "w") as file:
                file["scene/used"] = "".join(lines)
                return clearance.bearing_of(used_keys(file))
        for found, arc, ring in ((bearing(), 2.0*math.pi, False), (bearing(condition="periodic"), 2.0*math.pi, True),
                                 (bearing(edge=0.6), 2.0*math.pi - 0.6, False),
                                 (bearing("count = 4 !;gap = 0.0 ! (default)"), 0.5*math.pi, False),
                                 (bearing("count = 1 !;gap = 0.2 !"), 2.0*math.pi - 0.2, False),
                                 (bearing("count = 3 !;arc = 1.5 !;gap = 0.0 ! (default)"), 1.5, False)):
            self.assertAlmostEqual(found.arc, arc)
            self.assertEqual(found.ring, ring)
        half = bearing("count = 1 !;arc = 1.5 !")  # nothing holds the shaft back on the other side
        self.assertEqual(half.limit(numpy.array(math.pi + 0.75)), numpy.inf)
        self.assertAlmostEqual(float(half.limit(numpy.array(0.75))), CLEARANCE)


class StepsTest(unittest.TestCase):
    """Film and foils of a small sweep."""

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        case = BEAMS + f"&sweep parameter = 'speed_rpm' values = {SPEEDS[0]}, {SPEEDS[1]} /\n"
        (cls.folder/"beams.nml").write_text(case, encoding="utf-8")
        subprocess.run([os.environ["GFB"], "--output", cls.folder, cls.folder/"beams.nml"], check=True, stdout=subprocess.DEVNULL)

    def test_a_step_is_a_file_of_its_own(self):
        with h5py.File(self.folder/"beams.film.steps.vtkhdf", "r") as file, h5py.File(self.folder/"beams.film.vtkhdf", "r") as last:
            self.assertEqual((steps.count(file), scene.step_words(file, 0)), (2, "speed = 20000 rpm"))
            with steps.at_step(file, 1) as one:
                for name, data in last["VTKHDF/PointData"].items():
                    numpy.testing.assert_array_equal(one[f"VTKHDF/PointData/{name}"][...], data[...])
                    self.assertEqual(one[f"VTKHDF/PointData/{name}"].attrs["unit"], data.attrs["unit"])

    def test_python_reads_all_steps(self):
        film, last = (gfb.read(self.folder/f"beams.film{ending}.vtkhdf") for ending in (".steps", ""))
        self.assertEqual((dict(film.sizes)["point"], list(film["speed_rpm"].values), film["speed_rpm"].units), (2, list(SPEEDS), "rpm"))
        self.assertEqual(film["gap"].dims, ("point", "theta", "z"))
        numpy.testing.assert_array_equal(film["gap"][1].values, last["gap"].values)
        foil = gfb.read(self.folder/"beams.bump_foil.steps.vtkhdf")
        self.assertEqual((foil["displacement"].dims, foil["displacement"].units), (("point", "node", "component"), "m"))

    def test_rolled_up(self):
        status, said = call(self.folder, "--3d", "beams.h5")
        self.assertEqual((status, said), (0, "for ParaView: beams.3d.vtkhdf\ndrawn: beams.h5.3d.png\n"))
        with h5py.File(self.folder/"beams.3d.vtkhdf", "r") as file, h5py.File(self.folder/"beams.film.vtkhdf", "r") as film, \
                h5py.File(self.folder/"beams.top_foil.vtkhdf", "r") as top:
            grid = file["VTKHDF"]
            films, tops = len(film["VTKHDF/Points"]), len(top["VTKHDF/Points"])
            points, moved = grid["Points"][...], grid["PointData/displacement"][...].reshape(2, -1, 3)
            far = numpy.hypot(points[:, 0], points[:, 1])
            numpy.testing.assert_allclose(far[:films], RADIUS, rtol=1e-12)
            numpy.testing.assert_allclose(far[films:films + tops], RADIUS + CLEARANCE, rtol=1e-12)
            self.assertTrue((far[films + tops:] > RADIUS + CLEARANCE).all())
            # What v is towards the shaft, the rolled displacement is towards the axis.
            towards = -(moved[1, films:films + tops, :2]*points[films:films + tops, :2]).sum(axis=1)/(RADIUS + CLEARANCE)
            numpy.testing.assert_allclose(towards, top["VTKHDF/PointData/displacement"][:, 1], atol=1e-15)
            angle = numpy.arctan2(points[:films, 1], points[:films, 0]) % (2.0*math.pi)
            off = abs(angle - film["VTKHDF/PointData/theta"][...] % (2.0*math.pi))
            self.assertLess(numpy.minimum(off, 2.0*math.pi - off).max(), 1e-12)
            self.assertEqual(list(grid["Steps/Values"]), list(SPEEDS))
        if importlib.util.find_spec("vtk") is None:
            self.skipTest("no vtk in this Python")
        import vtk
        reader = vtk.vtkHDFReader()
        reader.SetFileName(str(self.folder/"beams.3d.vtkhdf"))
        reader.UpdateInformation()
        reader.UpdateTimeStep(SPEEDS[1])
        data = reader.GetOutput()
        self.assertEqual((reader.GetNumberOfSteps(), data.GetNumberOfPoints()), (2, len(points)))
        self.assertEqual(data.GetPointData().GetArray("displacement").GetTuple(films + 7), tuple(moved[1, films + 7]))

    def test_pictures_and_calls(self):
        for words, drawn in ((("beams.film.steps.vtkhdf",), "beams.film.steps.vtkhdf.png"),
                             (("beams.bump_foil.steps.vtkhdf", "--step", "1"), "beams.bump_foil.steps.vtkhdf.png"),
                             (("--animate", "beams.h5"), "beams.h5.gif")):
            self.assertEqual(call(self.folder, *words), (0, f"drawn: {drawn}\n"))
        with Image.open(self.folder/"beams.h5.gif") as film:
            self.assertEqual(film.n_frames, len(SPEEDS))
        for words, said in ((("beams.film.steps.vtkhdf", "--step", "3"), "no step 3; there are 2"),
                            (("beams.film.steps.vtkhdf", "--show", "loop"), "one is drawn"),
                            (("beams.h5", "--show", "orbit"), "nothing moves"),
                            (("--3d", "beams.h5", "--step", "1"), "--3d is of one case")):
            status, found = call(self.folder, *words)
            self.assertEqual((status, said in found), (1, True), found)

    def test_heights_and_displacements_are_drawn_larger_as_the_title_says(self):
        surface = rolled.Surface("top_foil", "top_foil", numpy.array([[0.0, 2.0e-3, 1.0]]), numpy.zeros((0, 4)), 1,
                                 {"displacement": numpy.array([[0.0, -1.0e-6, 0.0]])}, {})
        shaft = rolled.Shaft(0.02, (0.0,), 3.0e-3, 0.0)
        numpy.testing.assert_allclose(surface.rolled(shaft, 5.0, 100.0), [[0.02 + 5.0e-3 + 1.0e-4, 0.0, 1.0]])


if __name__ == "__main__":
    unittest.main()
