"""Tests of the pictures of several pads and of strips side by side: nothing is drawn where a bearing has nothing, and colours tell all.

The bearings are gfb's own, small ones of inputs/.
"""

import math
import os
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(PROJECT/"tools"))

import gfb  # noqa: E402 (found only now)
from gfb.plot import animation, colours, contact, film, foil, heat, polar, rolled, strip  # noqa: E402
from gfb.results import open_results  # noqa: E402

PADS, ARC = 3, math.degrees(2.0)  # of inputs/three_pads_shell.nml
BEGINS = [120.0*pad for pad in range(PADS)]
CUT, LENGTH, STRIPS = 0.6, 38.1, 3  # of inputs/third_generation_bearing.nml [mm]


def case_of(name, **changes):
    """A case of inputs/ with other keys; `group__key` for `group%key`."""
    case = gfb.Case.read(PROJECT/f"inputs/{name}.nml")
    for key, value in changes.items():
        case[key.replace("__", "%")] = value
    return case


def leaves_its_pad(low, high):
    """Whether angles from low to high [deg] are not all on one pad: they reach over a gap, or into it."""
    return all(not begin - 0.01 <= low <= high <= begin + ARC + 0.01 for begin in BEGINS)


def polygons(chart):
    """The polygons of a chart's filled contours."""
    for collection in chart.collections:
        for path in collection.get_paths():
            yield from path.to_polygons()


class PadsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        pads = case_of("three_pads_shell", model__foil="beam", mesh__axial_elements=4, mesh__arc_elements=4)
        gfb.run(pads, cls.folder, "pads")
        pads["sweep%parameter"], pads["sweep%values"] = "load", (30.0, 60.0)
        gfb.run(pads, cls.folder, "loads")
        gfb.run(case_of("thermal_three_pads", mesh__circumferential_elements=72, mesh__axial_elements=4), cls.folder, "warm")
        gfb.run(case_of("thrust_plate"), cls.folder, "sectors")
        gfb.run(case_of("third_generation_bearing", mesh__axial_elements=6, mesh__arc_elements=4), cls.folder, "strips")

    def tearDown(self):
        film.pyplot.close("all")

    def see_gaps(self, chart):
        """A chart over theta has patches and lines on every pad, and none over a gap."""
        seen = set()
        for polygon in polygons(chart):
            low, high = polygon[:, 0].min(), polygon[:, 0].max()
            self.assertFalse(leaves_its_pad(low, high), f"{low} to {high} deg")
            seen.add(int((low + 1.0)//120.0))
        return seen

    def test_no_patch_and_no_line_of_a_film_spans_a_gap(self):
        for name, draw in (("pads", film.draw_film), ("warm", heat.draw_film)):
            path = self.folder/f"{name}.film.vtkhdf"
            with open_results(path) as file:
                figure = draw(path, file)
            charts = [chart for chart in figure.axes if chart.get_ylabel() == "z [mm]"]
            self.assertEqual(len(charts), 3)
            for chart in charts:
                self.assertEqual(self.see_gaps(chart), set(range(PADS)))
            curves = [line for chart in figure.axes for line in chart.lines if len(line.get_xdata()) > 3]
            self.assertGreaterEqual(len(curves), 6)
            for line in curves:
                theta = line.get_xdata()[numpy.isfinite(line.get_ydata())]
                broken = numpy.ma.clump_unmasked(numpy.ma.masked_invalid(line.get_xdata()))
                self.assertEqual([(round(line.get_xdata()[part][0]), round(line.get_xdata()[part][-1])) for part in broken],
                                 [(round(begin), round(begin + ARC)) for begin in BEGINS])
                self.assertEqual(len(theta), numpy.isfinite(line.get_xdata()).sum())
            self.assertEqual(charts[0].get_xlim(), (0.0, 360.0))  # the last gap is shown, too

    def test_no_line_around_the_shaft_and_no_frame_of_a_film_spans_a_gap(self):
        path = self.folder/"pads.film.vtkhdf"
        with open_results(path) as file:
            charts = polar.draw(path, file).axes
        for line in [line for chart in charts for line in chart.lines if len(line.get_xdata()) > 2]:
            angle = numpy.degrees(line.get_xdata())
            self.assertFalse(leaves_its_pad(angle[0], angle[-1]))
        path = self.folder/"loads.film.steps.vtkhdf"
        with open_results(path) as file:
            figure, frame, *_ = animation.of_film(path, file)
            frame(1)
        for chart in (chart for chart in figure.axes if chart.get_ylabel() == "z [mm]"):
            spans = [(mesh.get_coordinates()[..., 0].min(), mesh.get_coordinates()[..., 0].max()) for mesh in chart.collections]
            self.assertEqual(len(spans), PADS)
            self.assertFalse(any(leaves_its_pad(*span) for span in spans))

    def test_every_pad_has_its_place_in_space_and_in_one_scale(self):
        case, paths = rolled.paths_of(self.folder/"pads.h5")
        surfaces = []
        for name, path in paths.items():
            with open_results(path) as file:
                surfaces.append(rolled.read_surface(name, file))
        shaft = rolled.read_shaft(self.folder/f"{case}.h5", surfaces)
        for surface in surfaces:
            corners, _ = rolled.patches(surface, surface.rolled(shaft), surface.points[:, 0])
            angle = numpy.degrees(numpy.arctan2(corners[..., 1], corners[..., 0])) % 360.0
            angle = numpy.where(angle > 359.9, 0.0, angle)
            across = [leaves_its_pad(one.min(), one.max()) for one in angle]
            self.assertFalse(any(across), surface.name)
            pad = int(surface.name[-1])*120.0 - 120.0 if surface.kind != "film" else 0.0
            self.assertAlmostEqual(angle.min(), pad, places=3, msg=surface.name)
        away = numpy.concatenate([one.away(shaft) for one in surfaces if one.kind != "film"])
        self.assertLess(away.min(), -2.0*away.max())  # a free edge lifts
        figure = rolled.draw(self.folder/"pads.h5", grid=False)
        norm = figure.axes[3]._colorbar.norm
        self.assertLessEqual(norm.vmin, 1.0e6*away.min())
        self.assertAlmostEqual(norm.vmax, 1.0e6*away.max())

    def test_sectors_are_drawn_in_space(self):
        figure = rolled.draw(self.folder/"sectors.h5")
        self.assertFalse((self.folder/"sectors.3d.vtkhdf").exists())  # the files lie in space already
        self.assertEqual([chart.get_title() for chart in figure.axes[:2]][0], "film on the sectors")
        for chart in figure.axes[:2]:
            corners = chart.collections[0]._vec[:2]
            self.assertAlmostEqual(numpy.hypot(*corners).min(), 25.0, places=3)
            self.assertAlmostEqual(numpy.hypot(*corners).max(), 50.0, places=3)

    def test_a_bearing_on_the_runners_other_side_covers_nothing(self):
        """Six pads, and six on the other side, whose numbers go on: they stand higher, and away from the runner is up there."""
        shaft = rolled.Shaft(0.05, tuple(numpy.arange(6.0)), 0.0, 0.0, runner=True)
        sinks = {"displacement": numpy.array([[0.0, 0.0, -2.0e-6]])}
        for name, opposite in (("top_foil_6", False), ("top_foil_7", True)):
            surface = rolled.Surface(name, "top_foil", numpy.array([[0.03, 0.0, 0.0]]), numpy.zeros((0, 4)), 1, sinks, {})
            self.assertAlmostEqual(float(surface.rolled(shaft)[0, 2]), 0.05*rolled.APART*opposite)
            self.assertAlmostEqual(float(surface.away(shaft)[0]), -2.0e-6 if opposite else 2.0e-6)

    def test_a_foil_tells_the_angles_of_its_pad(self):
        path = self.folder/"pads.top_foil_2.vtkhdf"
        with open_results(path) as file:
            chart = foil.draw(path, file, []).axes[0]
        chart.figure.canvas.draw()
        (theta,) = chart.child_axes
        self.assertAlmostEqual(theta.get_xlim()[0], 120.0)
        self.assertAlmostEqual(theta.get_xlim()[1], 120.0 + ARC, places=6)

    # --- contacts ---

    def test_contacts_show_forces_and_the_borders_of_pads(self):
        path = self.folder/"pads.h5"
        with open_results(path) as file:
            top, force, sleeve, _ = strip.draw([path], [file], "contact", []).axes[:4]
            number, pushes, state = (file[f"contact/top/{name}"][...].ravel() for name in ("line", "normal_force", "state"))
        self.assertEqual([line.get_xdata()[0] for line in top.lines], [8.5, 16.5])     # 8 bumps a pad
        self.assertEqual([line.get_xdata()[0] for line in sleeve.lines], [15.5, 30.5])  # the first of 16 lines is held
        self.assertEqual([text.get_text() for text in top.texts], ["pad 1", "pad 2", "pad 3"])
        for line, mesh in enumerate(force.collections, start=1):
            shown = mesh.get_array()
            pushed = 1.0e-3*pushes[(number == line) & (state > 0.0)]
            if len(pushed):
                self.assertAlmostEqual(shown.max(), pushed.max())
            else:
                self.assertTrue(numpy.ma.getmaskarray(shown).all())

    def test_contacts_show_cuts(self):
        path = self.folder/"strips.h5"
        with open_results(path) as file:
            charts = strip.draw([path], [file], "contact", []).axes[:4]
            z = 1.0e3*numpy.unique(file["contact/top/position_z"][...])
        wide = (LENGTH - (STRIPS - 1)*CUT)/STRIPS
        for chart in charts:
            boxes = [band.get_path().get_extents(band.get_patch_transform()) for band in chart.patches]
            bands = [(box.y0, box.y1) for box in boxes]
            numpy.testing.assert_allclose(bands, [(-0.5*wide - CUT, -0.5*wide), (0.5*wide, 0.5*wide + CUT)])
            self.assertFalse(any(low + 1.0e-9 < place < high - 1.0e-9 for low, high in bands for place in z))

    def test_cuts_of_a_foil_in_one_piece_are_none(self):
        self.assertEqual(contact.cuts_of(-1.0, 1.0, {}), [])


class ColoursTest(unittest.TestCase):
    """What a scale makes of lightly and heavily loaded films."""

    def shades(self, name, field, places):
        """How many colours a field has at these places."""
        look = colours.look_of(name, field.min(), field.max())
        levels = colours.levels_of(field.min(), field.max(), look["norm"])
        return len(set(numpy.digitize(field[places], levels)))

    def test_the_loaded_zone_has_colours_of_its_own(self):
        angle = numpy.linspace(-math.pi, math.pi, 721)
        for thickest, thinnest, flat in ((140.0, 2.4, 6), (34.0, 29.9, 2)):  # as 400 N and 3 N leave it on the bearing of [Gu2020]
            gap = thinnest + (thickest - thinnest)*numpy.sin(0.5*angle)**flat
            self.assertGreater(self.shades("gap", gap, abs(angle) < 1.0), 20, f"{thinnest} to {thickest} um")
        lifts = numpy.linspace(-10.0, 0.4, 721)  # a free edge beside the loaded part
        self.assertGreaterEqual(self.shades("deflection", lifts, lifts > 0.0), 25)

    def test_a_free_edge_that_lifts_leaves_the_load_its_colours(self):
        norm = colours.around_zero(-30.0, 5.0)["norm"]
        self.assertEqual((norm(0.0), norm(5.0), norm(-30.0)), (0.5, 1.0, 0.0))
        norm = colours.around_zero(-0.4, 5.0)["norm"]  # and what lifts little is pale
        self.assertAlmostEqual(norm(-0.4), 0.46)
        self.assertEqual(colours.around_zero(0.0, 0.0)["norm"](0.0), 0.5)

    def test_scales_bear_round_numbers_within(self):
        for low, high in ((2.41, 140.0), (29.9, 34.0), (0.3, 0.31)):
            numbers = colours.round_ticks(colours.look_of("gap", low, high)["norm"])
            self.assertGreaterEqual(len(numbers), 3)
            self.assertTrue(all(low <= number <= high for number in numbers), numbers)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
