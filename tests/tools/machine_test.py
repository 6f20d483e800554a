#!/usr/bin/env python3
"""Machines in Python, tools/plot and tools/report: bearings' files, what stands in the pictures, on the page, and what limits a machine."""

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

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(PROJECT/"tools"))
import gfb  # noqa: E402
from gfb.bearing_files import names_of, renamed, with_whole_names, write_copy  # noqa: E402
from gfb.design_machine import api_unbalance, permissible, unbalance_of  # noqa: E402
from gfb.members import find_member, run_member  # noqa: E402
from gfb.plot import machine as plot_machine  # noqa: E402
from gfb.plot import machine_motions as plot_motions  # noqa: E402
from gfb.plot import machine_time as plot_time  # noqa: E402
from gfb.plot.machine_motions import pyplot  # noqa: E402
from gfb.program import find_program  # noqa: E402
from gfb.report.answer import Results  # noqa: E402
from gfb.report.machine import MachineTables, draw_machine, largest_radius, machine_picture  # noqa: E402
from gfb.report.main import needs_of, read_run, write_page  # noqa: E402
from gfb.report.verdict import margins_of, not_computed, sentence  # noqa: E402

INPUTS = PROJECT/"inputs/machines"
MESH = {"mesh%circumferential_elements": 32, "mesh%axial_elements": 4}
LEFT, RIGHT = 9.0e-6, 2.0e-5  # films that the bearings' files want [m]


def write_small(folder):
    """The machine of the manual on coarse meshes; its case."""
    for side, wanted in (("left", LEFT), ("right", RIGHT)):
        bearing = gfb.Case.read(INPUTS/f"rotor_{side}.nml")
        bearing.update(MESH)
        bearing["capacity%smallest_gap"] = wanted
        bearing.write(folder/f"rotor_{side}.nml")
    (folder/"rotor.nml").write_text((INPUTS/"rotor.nml").read_text(encoding="utf-8"), encoding="utf-8")
    return gfb.Case.read(folder/"rotor.nml")


class MachineTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        case = write_small(cls.folder)
        cls.alone = gfb.run(case, cls.folder, "alone")
        case["sweep%parameter"], case["sweep%values"] = "speed_rpm", (8000.0, 12000.0, 15000.0)
        cls.sweep = gfb.run(case, cls.folder, "sweep")

    def setUp(self):
        self.addCleanup(pyplot.close, "all")

    def drawn(self, result, drawing):
        """A picture of a result."""
        path = pathlib.Path(f"{result.stem}.h5")
        with h5py.File(path, "r") as file:
            return drawing(path, file)

    def test_the_machine_is_to_scale_with_its_line(self):
        above, line, moments, _ = self.drawn(self.alone, plot_machine.draw).axes
        boxes = [patch.get_bbox().bounds for patch in above.patches]
        self.assertIn((40.0, -12.5, 320.0, 25.0), [tuple(round(one, 9) for one in box) for box in boxes])
        self.assertEqual(sum(patch.get_hatch() is not None for patch in above.patches), 4)  # sleeves of two bearings
        z, x = line.lines[0].get_data()
        for number, place in ((1, 20.0), (2, 380.0)):
            self.assertAlmostEqual(float(numpy.interp(place, z, x)), -1.0e6*self.alone[f"eccentricity_x_{number}"], places=6)
        largest = moments.lines[0].get_data()[1]
        self.assertGreater(largest.max(), 10.0*largest[[0, -1]].max())

    def test_modes_in_space_have_their_numbers(self):
        figure = self.drawn(self.alone, plot_motions.draw_shapes)
        first = figure.axes[0].get_title()
        self.assertIn(f"{self.alone['whirl_frequency']/(2.0*math.pi):.4g} Hz", first)
        self.assertIn("forward", first)
        with h5py.File(f"{self.alone.stem}.h5", "r") as file:
            self.assertEqual(len(figure.axes), min(6, len(file["dynamics/mode_shape"])))

    def test_campbell_response_and_ellipses(self):
        figure = self.drawn(self.sweep, plot_motions.draw_campbell)
        labels = figure.axes[0].get_legend_handles_labels()[1]
        self.assertIn(f"onset {self.sweep['onset_speed_rpm']:,.0f} rpm", labels)
        self.assertTrue(any(one.startswith("meets the speed: ") for one in labels))
        figure = self.drawn(self.sweep, plot_motions.draw_response)
        self.assertEqual(len([one for one in figure.axes[0].lines if len(one.get_xdata()) == 3]), 6)  # x and y at two bearings and a disc
        figure = self.drawn(self.alone, plot_motions.draw_response)
        self.assertEqual([chart.get_title().split("\n")[0] for chart in figure.axes], ["bearing 1", "bearing 2", "disc"])

    def test_a_machine_over_time(self):
        case = write_small(self.folder)
        del case.groups["dynamics"]
        case["scene%analysis"], case["machine%stations"], case["machine%speed_rpm"] = "transient", (0.1,), 10000.0
        case.groups["transient"] = {"turns": 4.0, "steps_per_turn": 40}
        moved = gfb.run(case, self.folder, "moved")
        with h5py.File(f"{moved.stem}.h5", "r") as file:
            orbits = plot_time.draw(pathlib.Path("moved.h5"), file, None).axes
            self.assertEqual([chart.get_title().split(":")[0] for chart in orbits], ["bearing 1", "bearing 2", "disc 1", "station 1"])
            (reach,) = [line.get_xydata() for line in orbits[0].lines if line.get_label() == "clearance at rest"]
            numpy.testing.assert_allclose(numpy.hypot(*reach.T), 31.8)
            way = orbits[2].lines[0].get_data()
            numpy.testing.assert_allclose(way[0], 1.0e6*file["transient/x_disc_1"][...])
            thinnest = plot_time.draw(pathlib.Path("moved.h5"), file, "thinnest").axes[0]
            self.assertEqual(len([line for line in thinnest.lines if line.get_label().startswith("bearing")]), 2)
            spectrum = plot_time.draw(pathlib.Path("moved.h5"), file, "waterfall").axes[0]
            self.assertIn("of y of ", spectrum.get_title())
            points = plot_time.draw(pathlib.Path("moved.h5"), file, "bifurcation").axes
            self.assertEqual([len(chart.lines[0].get_xdata()) for chart in points], [5]*4)

    def test_critical_speeds_are_those_of_closed_forms(self):
        """A disc on a stiff shaft in its middle: sqrt(2 k/m); a stiff spring: the shaft held at both ends."""
        with h5py.File(f"{self.alone.stem}.h5", "r") as file:
            mass, stiffness, polar = (file[f"shaft/{name}"][...] for name in ("mass", "stiffness", "polar_inertia"))
            whole, speed = mass[::2, ::2].sum(), float(file["summary/mass"][()])
            z = file["shaft/line"][:, 0]
        self.assertAlmostEqual(whole, speed, places=9)
        nodes = [int(numpy.abs(z - one).argmin()) for one in (0.02, 0.38)]
        weak = plot_motions.critical_speeds(mass, stiffness, polar, nodes, 10.0)[0]
        rigid = [numpy.ones(len(z)), z - 0.2]
        body = numpy.zeros((2, 2))
        springs = numpy.array([[20.0, 10.0*(0.02 + 0.38 - 0.4)], [0.0, 10.0*2.0*0.18**2]])
        for i, one in enumerate(rigid):
            for k, other in enumerate(rigid):
                left, right = (numpy.zeros(2*len(z)) for _ in range(2))
                left[::2], right[::2] = one, other
                left[1::2], right[1::2] = float(i), float(k)
                body[i, k] = left @ (mass - polar) @ right
        stiff = numpy.linalg.eigvals(numpy.linalg.solve(body, springs)).real
        self.assertAlmostEqual(weak/math.sqrt(stiff.min()), 1.0, places=4)
        held = plot_motions.critical_speeds(mass, stiffness, polar, nodes, 1.0e13)[0]
        free = [i for i in range(2*len(z)) if i not in [2*node for node in nodes]]
        inner = numpy.linalg.solve(stiffness[numpy.ix_(free, free)], (mass - polar)[numpy.ix_(free, free)])
        self.assertAlmostEqual(held*math.sqrt(numpy.linalg.eigvals(inner).real.max()), 1.0, places=4)
        self.drawn(self.alone, plot_motions.draw_critical)

    def test_the_longer_half_axis(self):
        ellipse = numpy.array([[0.0, 3.0, 0.0, 2.0, -0.5*math.pi], [0.0, 1.0, 0.7, 1.0, 0.7]])
        self.assertAlmostEqual(largest_radius(ellipse)[0], 3.0)
        self.assertAlmostEqual(largest_radius(ellipse)[1], math.sqrt(2.0))

    def test_a_page_says_which_bearing_limits(self):
        run = read_run(self.alone.stem, None, pictures=False)
        gap = 1.0e6*self.alone["minimum_gap_2"]
        self.assertIn("limits this machine", run["verdict"])
        margins = {one.subject: one for one in run["margins"]}
        self.assertEqual(margins["film of bearing 1"].state, "kept")
        self.assertEqual(margins["film of bearing 2"].state, "broken")
        self.assertAlmostEqual(margins["film of bearing 2"].factor, gap/20.0, places=5)
        self.assertEqual(margins["whirl"].is_broken, self.alone["growth_rate"] > 0.0)
        rows = {words: value for words, value, *_ in run["glance"]}
        self.assertEqual(rows["power loss of all bearings"], f"{self.alone['power_loss_1'] + self.alone['power_loss_2']:.4g} W")
        self.assertIn("temperature", run["open_questions"])
        page = write_page([run], self.folder/"page.html").read_text(encoding="utf-8")
        self.assertIn("the machine to scale", page)

    def test_the_sweep_names_its_onset(self):
        self.assertIn(f"onset of whirl at {self.sweep['onset_speed_rpm']:,.0f} rpm", " ".join(one.value for one in read_run(
            self.sweep.stem, None, pictures=False)["margins"]))

    def test_unbalance_beyond_a_third_of_the_film_is_said(self):
        case = gfb.Case.read(INPUTS/"rotor.nml")
        summary = {name: {"value": value, "unit": "m", "meaning": ""} for name, value in (("minimum_gap_1", 9.0e-6), ("minimum_gap_2", 1.0e-5))}
        tables = MachineTables(numpy.array([[0.02, 0.04, 0.02, 3.0e-5, 0.0]]*2), numpy.array([2.0e-6, 5.0e-6]), 1.0e6)
        results = Results(summary, case, machine=tables)
        one, = (margin for margin in margins_of(results) if margin.subject == "unbalance")
        self.assertTrue(one.is_broken)
        self.assertAlmostEqual(one.factor, 2.0/3.0)
        self.assertIn("bearing 2, 0.5 of its film", sentence(margins_of(results)))
        self.assertEqual(not_computed(results, margins_of(results)), ["whirl", "temperature"])

    def test_temperatures_are_those_of_the_files(self):
        case, file = gfb.Case.read(INPUTS/"blower_hot.nml"), gfb.Case.read(INPUTS/"blower_thrust_hot.nml")
        summary = {f"maximum_film_temperature_{number}": {"value": value} for number, value in ((1, 320.0), (2, 350.0), (3, 400.0))}
        tables = MachineTables(numpy.zeros((3, 5)), numpy.zeros(0), None, [gfb.Case(), gfb.Case(), file])
        one, = (margin for margin in margins_of(Results(summary, case, machine=tables)) if margin.subject == "temperature")
        self.assertEqual((one.state, one.value), ("unknown", "hottest film 126.9 °C, in bearing 3"))
        file["capacity%highest_temperature"] = 293.15 + 53.425
        one, = (margin for margin in margins_of(Results(summary, case, machine=tables)) if margin.subject == "temperature")
        self.assertTrue(one.is_broken)
        self.assertAlmostEqual(one.factor, 0.5)

    def test_the_sketch_of_a_machine_is_to_scale(self):
        case = gfb.Case.read(INPUTS/"rotor.nml")
        shapes = draw_machine(case).shapes
        sides = []
        for look, _, path in shapes:
            if look == "shaft":
                points = [tuple(map(float, one.split(","))) for one in path.removeprefix("M").removesuffix(" Z").split(" L")]
                sides.append((points[1][0] - points[0][0], points[0][1] - points[2][1]))
        self.assertAlmostEqual(sides[1][0]/sides[0][0], 8.0, places=1)
        self.assertAlmostEqual(sides[0][1]/sides[1][1], 38.1/25.0, places=1)
        self.assertEqual(sum(look == "pad" for look, *_ in shapes), 4)
        case["shaft%lengths"] = "long"
        self.assertIsNone(machine_picture(case))

    def test_the_page_has_the_bearings_files_and_what_the_machine_needs(self):
        run = read_run(self.alone.stem, None, pictures=False)
        self.assertEqual([gfb.Case.parse(text)["bearing%clearance"] for text in run["bearing_files"]], [31.8e-6, 28.0e-6])
        self.assertIn("film mesh: 32 x 4 elements", needs_of(run["case_file"], None, run["bearing_files"]))


class BlowerTest(unittest.TestCase):
    """The tutorial's machine, on coarse meshes."""

    def test_it_is_what_the_page_says(self):
        case = gfb.Case.read(INPUTS/"blower.nml")
        for number in (1, 2, 3):
            case[f"bearing_{number}%mesh%circumferential_elements"] = 12 if number == 3 else 48
            case[f"bearing_{number}%mesh%{'radial' if number == 3 else 'axial'}_elements"] = 6 if number == 3 else 4
        with tempfile.TemporaryDirectory() as folder:
            answer = gfb.run(case, folder, "blower")
            self.assertNotIn("warning", answer.log)  # of samples beside springs that relax some are no modes
            self.assertRegex(answer.log, r"(?m)^ +1 +7\d\.\d+ .* to and fro$")
            self.assertRegex(answer.log, r"(?m)^ +2 +1[23]\d\.\d+ .* forward$")
            self.assertEqual([plot_motions.way_of(sense) for sense in (0.04, 0.06, -0.06)], ["to and fro", "forward", "backward"])
            self.assertAlmostEqual(answer["mass"], 2.2, delta=0.05)
            self.assertLess(answer["growth_rate"], -20.0)
            self.assertAlmostEqual(abs(answer["force_z_3"]), 120.0, delta=1.0e-6)
            self.assertGreater(min(answer[f"minimum_gap_{number}"] for number in (1, 2, 3)), 5.0e-6)
            path = pathlib.Path(f"{answer.stem}.h5")
            with h5py.File(path, "r") as file:
                hertz = numpy.sort(file["dynamics/mode_frequency"][...].ravel()/(2.0*math.pi))
                bends = hertz[hertz > 800.0]
                self.assertTrue(((bends > 1000.0) & (bends < 1300.0)).all() and len(bends) == 2, hertz)
                read = plot_machine.read(path, file)
                reach, room = read.reach(1), read.room(1)
                self.assertAlmostEqual(numpy.nanmin(numpy.hypot(*reach.T)), 0.15*110.0e-6, delta=1.0e-9)  # its pads have a preload of 0.85
                self.assertAlmostEqual(room[0], reach[len(reach)//2, 0]*-1.0, delta=1.0e-6)  # onto pad 2
                self.assertAlmostEqual(room[1], reach[0, 0], delta=1.0e-6)  # between pads 3 and 1
                self.assertGreater(room[1], 1.5*room[0])
                above = plot_machine.draw(path, file).axes[0]
                mass, stiffness = (file[f"shaft/{name}"][...] for name in ("mass", "stiffness"))
            free = numpy.sort(numpy.sqrt(numpy.abs(numpy.linalg.eigvals(numpy.linalg.solve(mass, stiffness)))))[2]/(2.0*math.pi)
            self.assertAlmostEqual(free, 1100.0, delta=10.0)
            plates = [patch.get_bbox() for patch in above.patches if patch.get_hatch() is not None][4:]
            self.assertEqual([round(plate.x1, 9) for plate in plates], [283.0, 283.0])  # behind pads that face +z
            self.assertEqual(sorted(round(abs(end), 9) for end in plates[0].intervaly), [22.0, 45.0])
            run = read_run(answer.stem, None, pictures=False)
            self.assertIn("All known limits are kept; film of bearing 1 is nearest", run["verdict"])
            asked = []
            with unittest.mock.patch.multiple("gfb.report.main", drawn=lambda arguments, *_: asked.append(arguments), say=lambda _: None, AT_ONCE=1):
                read_run(answer.stem, None)
            self.assertEqual([one[0] for one in asked if one[-1] == "polar"], [f"{answer.stem}.bearing_{number}.film.vtkhdf" for number in (1, 2)])
            self.assertIn([f"{answer.stem}.bearing_3.film.vtkhdf"], asked)
            said = subprocess.run([PROJECT/"tools/plot", f"{answer.stem}.bearing_3.film.vtkhdf", "--show", "polar"], capture_output=True, text=True, check=False)
            self.assertEqual((said.returncode, "is of journals" in said.stderr), (1, True), said.stderr)
            pyplot.close("all")


class DesignTest(unittest.TestCase):
    """The study of a machine."""

    def test_unbalances_of_the_standards(self):
        """G 2.5 at 15,000 rpm leaves 1.59 um; 4 W/N with W in pounds and ounces times inches."""
        self.assertAlmostEqual(permissible(1.0, 15000.0, 2.5), 2.5e-3/(15000.0*math.pi/30.0), places=12)
        pound, ounce_inch = 0.45359237, 0.45359237/16.0*0.0254
        self.assertAlmostEqual(api_unbalance(10.0*pound, 8000.0)/(4.0*10.0/8000.0*ounce_inch), 1.0, places=3)
        case = gfb.Case({"unbalance": {"positions": (0.1, 0.2), "values": (1.0, -3.0), "angles": 0.5}})
        self.assertEqual(unbalance_of(case, 0.15, 8.0), {"positions": (0.1, 0.2), "values": (2.0, -6.0), "angles": 0.5})
        self.assertEqual(unbalance_of(gfb.Case(), 0.15, 8.0), {"positions": 0.15, "values": 8.0})

    def test_a_study_has_the_machine_and_each_bearing_alone(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            case = write_small(folder)
            found = gfb.design(case, folder/"study", "rotor", grade=2.5)
            again = gfb.design(case, folder/"study", "rotor", grade=2.5, tell=(said := []).append)
            self.assertEqual([part.stem is not None for part in found.parts], [True]*6)
            point = found.runs["point"]
            mass = point["summary"]["mass"]["value"]
            unbalance = gfb.Case.read(folder/"study/rotor_point.nml")["unbalance%values"]
            self.assertAlmostEqual(unbalance if isinstance(unbalance, float) else sum(unbalance), permissible(mass, 15000.0, 2.5), delta=1.0e-4*permissible(mass, 15000.0, 2.5))
            rows = {question: answer for question, answer, *_ in found.rows}
            self.assertIn("onset of whirl at ", rows["modes and response over the speed"])
            self.assertIn("grade G 2.5", " ".join(rows))
            alone = gfb.Case.read(folder/"study/rotor_whirl_1.nml")
            load = abs(alone["operation%load"][0])
            self.assertAlmostEqual(alone["rotor%mass"]*9.81, load, delta=1.0e-9*load)
            loads = [abs(gfb.Case.read(folder/f"study/rotor_capacity_{number}.nml")["operation%load"][0]) for number in (1, 2)]
            self.assertAlmostEqual(sum(loads), 9.81*mass, delta=1.0e-3)
            self.assertTrue(all("is there already" in line for line in said), said)
            self.assertEqual(again.verdict, found.verdict)
            self.assertIn("this machine", found.verdict)
            self.assertEqual({one.where for one in found.margins if one.subject == "load"}, {"bearing 1 alone", "bearing 2 alone"})


class FilesTest(unittest.TestCase):
    """The files of bearings go where the machine goes."""

    TEXT = "&bearings files = 'a.nml', 2*'sub/b''.nml' ! of three\n  positions = 0.1, 0.2, 0.3 /\n&machine speed_rpm = 1.0 /\n"

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def rigid(self):
        """The template's machine on a coarse mesh and rigid bearings."""
        case = gfb.Case.template("machine")
        for group in ("unbalance", "dynamics"):
            del case.groups[group]
        case["scene%analysis"], case["machine%journal_tilts"] = "equilibrium", False
        for number in (1, 2):
            bearing = case.bearing(number)
            bearing["model%foil"], bearing["mesh%circumferential_elements"], bearing["mesh%axial_elements"] = "rigid", 32, 4
            for group in ("top_foil", "bump_foil", "contact"):
                del bearing.groups[group]
        return case

    def test_names_of_files(self):
        self.assertEqual(names_of(self.TEXT), ("a.nml", "sub/b'.nml", "sub/b'.nml"))
        self.assertEqual(names_of("&scene files = 'a' /"), ())
        new = renamed(self.TEXT, ("x", "y", "z"))
        self.assertEqual(names_of(new), ("x", "y", "z"))
        self.assertEqual(new.replace("'x', 'y', 'z'", ""), self.TEXT.replace("'a.nml', 2*'sub/b''.nml'", ""))
        self.assertEqual(names_of(with_whole_names(self.TEXT, self.folder))[0], str(self.folder.resolve()/"a.nml"))

    def test_a_copy_has_its_bearings(self):
        (self.folder/"sub").mkdir()
        for name in ("a.nml", "sub/b'.nml"):
            (self.folder/name).write_text(f"&scene title = \"{name}\" /\n", encoding="utf-8")
        (self.folder/"there").mkdir()
        path = write_copy(self.TEXT, self.folder, self.folder/"there/new.nml")
        self.assertEqual(names_of(path.read_text(encoding="utf-8")), tuple(f"new.bearing_{number}.nml" for number in (1, 2, 3)))
        self.assertIn("sub/b'", (self.folder/"there/new.bearing_3.nml").read_text(encoding="utf-8"))

    def test_bearings_may_be_cases(self):
        case = self.rigid()
        self.assertEqual(case["bearing_1%bearing%clearance"], 31.8e-6)
        case["bearing_2%bearing%clearance"] = 40.0e-6
        self.assertEqual([case[f"bearing_{number}%bearing%clearance"] for number in (1, 2)], [31.8e-6, 40.0e-6])
        self.assertTrue("bearing_2%gas%viscosity" in case and "bearing_3%gas%viscosity" not in case)
        self.assertEqual(case, case.copy())
        other = case.copy()
        other["bearing_1%gas%viscosity"] = 3.0e-5
        self.assertNotEqual(case, other)
        with self.assertRaises(KeyError):
            case.bearing(3)
        self.assertIn("is in order", case.check())
        case["bearing_1%bearing%length"] = -1.0
        with self.assertRaisesRegex(gfb.CaseError, "bearing_1.nml.*length"):
            case.check()
        case["bearing_1%bearing%length"] = 0.0381
        answer = gfb.run(case, self.folder, "mine")
        self.assertGreater(answer["minimum_gap_2"], 0.0)
        again = gfb.Case.read(self.folder/"mine.nml")
        self.assertEqual(again["bearing_2%bearing%clearance"], 40.0e-6)
        self.assertEqual(gfb.run(again, self.folder, "again")["minimum_gap_2"], answer["minimum_gap_2"])
        both = gfb.study(case, {"bearing_1%bearing%clearance": [31.8e-6, 36.0e-6]}, self.folder/"study")
        self.assertEqual(float(both["minimum_gap_1"][0]), answer["minimum_gap_1"])
        self.assertNotEqual(float(both["minimum_gap_1"][1]), answer["minimum_gap_1"])

    def test_a_changed_bearing_is_computed_again(self):
        stem, program = self.folder/"one", find_program()
        self.rigid().write(self.folder/"machine.nml")
        case = gfb.Case.read(self.folder/"machine.nml")
        run_member(case, stem, program)
        self.assertIsNotNone(find_member(case, stem, program))
        bearing = case.bearing(2)
        bearing["bearing%clearance"] = 35.0e-6
        bearing.write(self.folder/"machine.bearing_2.nml")
        self.assertIsNone(find_member(case, stem, program))


if __name__ == "__main__":
    unittest.main()
