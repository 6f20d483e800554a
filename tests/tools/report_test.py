#!/usr/bin/env python3
"""tools/report: one page of one or several results, and what it says of files that are none."""

import html.parser
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]/"tools"))
import gfb  # noqa: E402
from gfb.report.answer import Results  # noqa: E402
from gfb.report.glance import glance  # noqa: E402
from gfb.report.grooves import groove_lines, groove_words
from gfb.report.main import read_run, thinnest_pad, write_page  # noqa: E402
from gfb.report.orifices import orifice_rows  # noqa: E402
from gfb.report.sensitivities import sensitivities  # noqa: E402
from gfb.report.margin import STOPPED, Margin  # noqa: E402
from gfb.report.sketch import Bearing, case_sketch, sketch  # noqa: E402
from gfb.report.thinnest import Place, place_of_thinnest  # noqa: E402
from gfb.report.verdict import colour_of, margins_of, not_computed, plain, sentence  # noqa: E402
from gfb.tool import ROOT  # noqa: E402
from slow import slow  # noqa: E402

VOID = {"meta", "link", "img", "br"}
SMALL = {"scene": {"title": "small & <rigid>", "analysis": "equilibrium"},
         "bearing": {"radius": 0.02, "length": 0.04, "clearance": 2.0e-5},
         "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5},
         "operation": {"speed_rpm": 20000.0, "load": (-20.0, 0.0)},
         "model": {"foil": "rigid"}, "mesh": {"circumferential_elements": 48, "axial_elements": 8}}


SOUGHT = {"quantity": "minimum_gap", "parameters": ("gas%viscosity", "bearing%clearance", "operation%load")}
HEAT = {"shaft": "given", "shaft_temperature": 320.0, "sleeve_conductance": 1.0, "top_foil": "given", "top_foil_temperature": 310.0}


class Page(html.parser.HTMLParser):
    """Whether every tag is closed, what the page refers to, and its text."""

    def __init__(self, text):
        super().__init__()
        self.open, self.sources, self.words, self.broken = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.sources += [value for name, value in attrs if name in ("src", "href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.broken.append(tag)

    def handle_data(self, data):
        self.words.append(data)


def report(*words):
    """Status and what was said."""
    done = subprocess.run([sys.executable, ROOT/"tools/report", *map(str, words)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        case = gfb.Case(SMALL)
        cls.first = gfb.run(gfb.Case(SMALL | {"thermal": HEAT, "sensitivity": SOUGHT}), cls.folder, "first")
        case["accuracy%quantity"], case["accuracy%target"] = "minimum_gap", 0.05
        gfb.run(case, cls.folder, "second")
        case = gfb.Case(SMALL)
        case["sweep%parameter"], case["sweep%values"], case["bearing%clearance"] = "load", (20.0, 1.0e9), 2.5e-5
        gfb.run(case, cls.folder, "beyond")

    def page(self, *words):
        """The page of some results."""
        output = self.folder/"page.html"
        status, said = report(*words, "-o", output)
        self.assertEqual(status, 0, said)
        page = Page(output.read_text(encoding="utf-8"))
        self.assertEqual((page.open, page.broken), ([], []))
        self.assertTrue(all(source.startswith("data:") for source in page.sources), "it needs another file")
        return page, " ".join(" ".join(page.words).split())

    @slow
    def test_slow_two_side_by_side(self):
        page, words = self.page(self.folder/"first.h5", self.folder/"second.summary")
        self.assertIn("small & <rigid>", words)
        self.assertIn(f"{self.first['minimum_gap']:.6g}", words)
        self.assertRegex(words, r"minimum_gap [0-9.e-]+ [0-9.e-]+ ± [0-9.e-]+ m smallest film thickness")
        self.assertIn("48 x 8", words)
        self.assertRegex(words, rf"Answer: first .*thinnest film {1.0e6*self.first['minimum_gap']:.4g} um .*load on the shaft 20 N 12\.5 kPa")
        self.assertRegex(words, r"Answer: second .*thinnest film [0-9.]+ ± [0-9.]+ um")
        self.assertRegex(words, rf"hottest film {self.first['maximum_film_temperature'] - 273.15:.4g} °C shaft 46\.85 °C")
        self.assertIn("program_version", words)
        self.assertEqual(sum(source.startswith("data:image/png") for source in page.sources), 8)  # three of each, two of heat
        flows = {name: self.first[name] for name in ("power_loss", "heat_to_shaft", "heat_to_top_foil", "heat_by_gas")}
        self.assertLess(flows["heat_to_shaft"], 0.0)  # the shaft is the hotter wall
        part = {name: f"{flow:.6g} {100.0*flow/flows['power_loss']:.3g}" for name, flow in flows.items()}
        self.assertIn(f"Where the heat goes: first heat [W] [%] power loss {part['power_loss']} into the shaft {part['heat_to_shaft']} "
                      f"with the film's gas {part['heat_by_gas']} into the top foil, held {part['heat_to_top_foil']}", words)

    def test_a_sweep_without_an_answer_beside_its_result(self):
        status, said = report(self.folder/"beyond.unconverged")
        self.assertEqual(status, 0, said)
        page = Page((self.folder/"beyond.unconverged.html").read_text(encoding="utf-8"))
        self.assertEqual((page.open, page.broken), ([], []))
        words = " ".join(" ".join(page.words).split())
        self.assertIn("No answer was found", words)
        self.assertIn("No answer was found", said)
        self.assertRegex(words, r"The last state reached ○ thinnest film, theta = \S+ deg.* load .*thinnest film")
        self.assertRegex(words, r"bearing%clearance 2\.5e-05")

    def test_the_most_influential_key_stands_first(self):
        found, parts = self.first, {"gas: viscosity": ("gas_viscosity", SMALL["gas"]["viscosity"]), "operation: load": ("operation_load", 20.0),
                                    "bearing: clearance": ("bearing_clearance", SMALL["bearing"]["clearance"])}
        per_cent = {words: found[f"d_minimum_gap_d_{name}"]*value/found["minimum_gap"] for words, (name, value) in parts.items()}
        order = sorted(per_cent, key=lambda words: -abs(per_cent[words]))
        self.assertLess(per_cent["operation: load"], 0.0)  # and a more viscous gas carries higher
        self.assertGreater(per_cent["gas: viscosity"], 0.0)
        _, words = self.page(self.folder/"first.h5")
        told = words.partition("What it depends on most")[2].partition("All results by name")[0]
        self.assertIn("what 1 % more of each key does", told)
        self.assertEqual(sorted(parts, key=told.index), order)
        for name, share in per_cent.items():
            self.assertRegex(told, rf"{name} [+-]\S+ um {re.escape(f'{share:+.3g}')} %")

    def test_bars_of_tolerances(self):
        """By tolerances or by 1 %, with what a sweep and the load's magnitude make of a key; the value of a list has that of the list."""
        def result(name, value, unit="m", meaning=""):
            return {name: {"value": value, "unit": unit, "meaning": meaning}}

        def derivative(key, value):
            return result(f"d_{key}", value, "1", f"derivative of minimum_gap by {key}")

        case = gfb.Case(SMALL | {"bump_foil": {"crest_gap": (0.0, 0.0)}})
        summary = result("minimum_gap", 5.0e-6) | derivative("bearing%clearance", -0.1) | derivative("operation%load", -1.0e-8) \
            | derivative("bump_foil%crest_gap(2)", 0.2) | result("standard_deviation_minimum_gap", 3.0e-7)
        (one,) = sensitivities(summary, case)
        self.assertEqual([(bar["key"], bar["effect"], bar["grows"]) for bar in one["bars"]],
                         [("bearing%clearance", "-0.02 um", False), ("operation%load", "-0.002 um", False)])
        self.assertEqual((one["silent"], one["left_out"], one["by_tolerance"]), (1, 0, False))
        (one,) = sensitivities(summary, case, {"operation%load": 400.0})
        self.assertEqual([bar["effect"] for bar in one["bars"]], ["-0.04 um", "-0.02 um"])
        case["sensitivity%parameters"] = "bearing%clearance, operation%load, bump_foil%crest_gap(:)"
        case["sensitivity%tolerances"] = (1.0e-6, 2.0, 1.0e-6)
        (one,) = sensitivities(summary, case)
        self.assertEqual([(bar["key"], bar["effect"], bar["length"]) for bar in one["bars"]],
                         [("bump_foil%crest_gap(2)", "+0.2 um", 100.0), ("bearing%clearance", "-0.1 um", 50.0), ("operation%load", "-0.02 um", 10.0)])
        self.assertEqual((one["spread"], one["silent"]), ("0.3 um", 0))
        self.assertEqual(sensitivities(result("minimum_gap", 5.0e-6), case), [])

    def test_the_foil_shown_is_that_of_the_thinnest_film(self):
        gaps = {name: {"value": value} for name, value in (("minimum_gap", 4.0e-6), ("minimum_gap_1", 9.0e-6), ("minimum_gap_2", 4.0e-6),
                                                            ("minimum_gap_10", 5.0e-6), ("minimum_gap_edge", 1.0e-6))}
        self.assertEqual((thinnest_pad(gaps), thinnest_pad({"minimum_gap": {"value": 4.0e-6}})), (2, 0))

    def test_margins(self):
        """What is asked first, against what the case says: better and worse than that."""
        def row(name, value, unit):
            return {name: {"value": value, "unit": unit, "meaning": ""}}

        case = gfb.Case(SMALL | {"rotor": {"mass": 0.5}, "shaft_contact": {"roughness": 1.0e-6}})
        some = row("minimum_gap", 4.0e-6, "m") | row("load_capacity", 15.0, "N") | row("critical_mass", 0.25, "kg") | \
            row("lift_off_speed_rpm", 5.0e3, "rpm") | row("growth_rate", 3.0, "1/s") | row("whirl_frequency", 628.3185307, "rad/s") | row("onset_speed_rpm", 15.0e3, "rpm")
        rows = {words: (value, verdict, bad) for words, value, verdict, bad in glance(some, case)}
        self.assertEqual(rows["thinnest film"], ("4 um", "4 times the roughness", False))
        self.assertEqual(rows["load capacity"], ("15 N", "the load is 20 N: 0.75 times", True))
        self.assertEqual(rows["critical mass"], ("0.25 kg", "this bearing carries 0.5 kg of the rotor: 0.5 times", True))
        self.assertEqual(rows["lift-off speed"], ("5,000 rpm", "the speed is 20,000 rpm: 4 times", False))
        self.assertEqual(rows["onset of whirl"], ("15,000 rpm", "the speed is 20,000 rpm: 0.75 times", True))
        self.assertEqual(rows["rotor's least damped mode"], ("100 Hz", "it grows", True))
        hot = row("running_clearance", 31.0e-6, "m") | row("running_play", 3.0e-6, "m")
        rows |= {words: (value, verdict, bad) for words, value, verdict, bad in glance(hot, case)}
        self.assertEqual((rows["clearance when it runs"], rows["its play under the preload"]),
                         (("31 um", "20 um cold", False), ("3 um", "on foils at rest", False)))
        case["rotor%mass"], case["operation%load"] = 0.1, (-3.0, 4.0)
        rows = {words: (verdict, bad) for words, _, verdict, bad in glance(some, case)}
        self.assertEqual((rows["load capacity"], rows["critical mass"]), (("the load is 5 N: 3 times", False), ("this bearing carries 0.1 kg of the rotor: 2.5 times", False)))
        drawn = sketch(some | row("eccentricity_x", -1.0e-5, "m") | row("eccentricity_y", 0.0, "m"), case)
        self.assertEqual((len(drawn["pads"]), drawn["thinnest"], drawn["centre"][2:]), (1, None, (162.0, 100.0)))
        self.assertEqual([path.rpartition(" L")[2] for look, _, path in drawn["shapes"] if look == "load line"], ["76.6,68.8"])  # towards (-3, 4), y up

    def test_the_sketch_of_a_case_is_to_scale(self):
        """Pads, preload, bumps, ramps and a bore stand where the case has them; half a number draws nothing."""
        def shapes(case, look):
            return [[tuple(map(float, pair.split(","))) for pair in re.findall(r"[-\d.]+,[-\d.]+", path)] for kind, _, path in case_sketch(case)["shapes"] if kind == look]

        def far(points):
            return [math.hypot(x - 100.0, y - 100.0) for x, y in points]

        case = gfb.Case.read(ROOT/"inputs/three_pads_stability.nml")
        foils = shapes(case, "foil line")
        self.assertEqual((len(foils), len(shapes(case, "bump line"))), (3, 24))
        gaps = [one - 64.0 for one in far(foils[0])]  # of 31.8 um on a radius of 19.05 mm, 100 times larger, on 64; 0.3 of it less in the middle
        self.assertAlmostEqual(min(gaps), 0.7*31.8e-6*100.0*64.0/19.05e-3, delta=0.1)
        self.assertAlmostEqual(max(gaps), (1.0 - 0.3*math.cos(1.0))*31.8e-6*100.0*64.0/19.05e-3, delta=0.1)
        ends = [math.atan2(100.0 - y, x - 100.0) % (2.0*math.pi) for x, y in (foils[1][0], foils[1][-1])]
        for end, angle in zip(ends, (2.0*math.pi/3.0, 2.0*math.pi/3.0 + 2.0)):
            self.assertAlmostEqual(end, angle, delta=2.0e-3)
        case["bearing%clearance"] = 40.0e-6
        self.assertAlmostEqual(min(far(shapes(case, "foil line")[0])) - 64.0, 0.7*40.0e-6*100.0*64.0/19.05e-3, delta=0.1)
        shimmed = far(shapes(gfb.Case.read(ROOT/"inputs/shimmed_bearing.nml"), "foil line")[0])
        self.assertAlmostEqual(max(shimmed) - min(shimmed), 12.0e-6*100.0*64.0/19.05e-3, delta=0.15)
        ring = gfb.Case.read(ROOT/"inputs/thrust_foundation.nml")
        self.assertEqual((len(shapes(ring, "pad")), len(shapes(ring, "ramp"))), (7, 7))  # the last is a pad that is cut
        self.assertAlmostEqual(min(far(shapes(ring, "pad")[0])), 42.5, delta=0.1)
        ring["ramp%part"] = 0.2
        turned = [math.degrees(math.atan2(100.0 - y, x - 100.0)) for x, y in shapes(ring, "ramp")[0]]
        self.assertAlmostEqual(max(turned) - min(turned), 0.2*45.0, delta=0.1)
        for key, value in (("bearing%radius", "30 mil"), ("bearing%radius", -1.0), ("pads%count", 0), ("pads%arc", 7.0), ("bearing%clearance", "2."), ("bump_foil%pitch", 0.0)):
            self.assertIsNone(case_sketch(gfb.Case(case.groups | {(group := key.split("%")[0]): case.groups[group] | {key.split("%")[1]: value}})), (key, value))

    def test_grooves_run_where_they_pump(self):
        """Lines rise with theta where grooves at rest pump up; on the shaft it is the other way round; spirals keep their angle; each is in the sketch."""
        journal, ring = (gfb.Case.read(ROOT/f"inputs/groove_{name}.nml") for name in ("herringbone", "spiral_thrust"))
        for member, sign in (("shaft", -1.0), ("sleeve", 1.0)):
            journal["grooves%on"] = member
            lines = groove_lines(Bearing(journal))
            self.assertEqual(len(lines), 2*20)
            for line, up in ((lines[0], sign), (lines[-1], -sign)):
                (begin, low), (end, high) = line[0], line[-1]
                self.assertAlmostEqual(15.0e-3*(end - begin), up*(high - low)/math.tan(0.489))
            self.assertEqual(groove_words(Bearing(journal)), f"grooves on the {member}, 28 deg, 12 um deep")
        for line in groove_lines(Bearing(ring)):
            for (begin, low), (end, high) in zip(line, line[1:]):
                self.assertAlmostEqual(0.5*(low + high)*(end - begin)/(high - low), 1.0/math.tan(0.297), delta=2.0e-3)
        for case, least in ((journal, 20), (ring, 24)):
            shapes = case_sketch(case)["shapes"]
            self.assertGreaterEqual(sum(look == "groove line" and groups == "grooves" for look, groups, _ in shapes), least)
        self.assertEqual(groove_lines(Bearing(gfb.Case(SMALL))), [])
        ring["grooves%angle"] = 2.0
        self.assertIsNone(case_sketch(ring))
        del ring["grooves%pumping"]
        self.assertEqual(groove_lines(Bearing(ring)), [])
        some = {name: {"value": value, "unit": unit, "meaning": ""} for name, value, unit in (
            ("minimum_gap", 9.0e-6, "m"), ("pumped_pressure", 9.5e4, "Pa"), ("flow_low", -0.8, "Pa m3/s"), ("flow_high", 0.8, "Pa m3/s"))}
        self.assertIn(("pumped up by grooves", "95 kPa", "0.8 Pa m3/s flow to larger z or radius", False), glance(some, journal))

    def test_orifices_are_where_the_program_has_them(self):
        """Gas enters around the places of the sketch, and nowhere else; each orifice has its flow, and says whether it is choked."""
        holes = {"kind": "orifices", "supply_pressure": 6.0e5, "orifice_diameter": 1.0e-4, "orifices": 4, "row_shift": 0.2, "first_orifice_angle": 0.5}
        journal = gfb.Case(SMALL | {"scene": {"analysis": "fixed_position"}, "operation": {"speed_rpm": 0.0, "eccentricity": (1.5e-5, 0.0)},
                                    "feed": holes | {"row_positions": (-0.01, 0.01)}, "model": {"foil": "rigid"}})
        sectors = gfb.Case({"scene": {"analysis": "fixed_position"}, "bearing": {"kind": "thrust", "outer_radius": 0.03, "inner_radius": 0.015},
                            "pads": {"count": 3, "arc": 1.9}, "gas": SMALL["gas"], "operation": {"speed_rpm": 0.0, "axial_gap": 1.0e-5}, "model": {"foil": "rigid"},
                            "feed": holes | {"orifices": 2, "row_positions": (0.02, 0.025), "first_orifice_angle": 0.4}})
        words = set()
        for name, case, places, listed in (("journal", journal, 8, 8), ("sectors", sectors, 12, 4)):
            done = gfb.run(case, self.folder, f"fed_{name}")
            found = Bearing(case).holes()
            self.assertEqual(list(found), list(range(1, places + 1)))
            with h5py.File(self.folder/f"fed_{name}.film.vtkhdf") as file:
                points, fed, theta = file["VTKHDF/Points"][...], file["VTKHDF/PointData/feed"][...], file["VTKHDF/PointData/theta"][...]
            if name == "journal":
                points = numpy.stack([0.02*numpy.cos(theta), 0.02*numpy.sin(theta), points[:, 2]], axis=1)
            centres = numpy.array([(along*math.cos(angle), along*math.sin(angle), 0.0) if name == "sectors" else
                                   (0.02*math.cos(angle), 0.02*math.sin(angle), along) for angle, along in found.values()])
            fed_there = numpy.abs(fed) > 1.0e-3*fed.max()
            far = numpy.linalg.norm((points[:, None, :] - centres)[fed_there, :, :3 if name == "journal" else 2], axis=2)
            self.assertLess(far.min(axis=1).max(), 2.0e-3)
            self.assertLess(far.min(axis=0).max(), 5.0e-4)
            results = Results(read_run(self.folder/f"fed_{name}", None, pictures=False)["summary"], case)
            rows = orifice_rows(results)
            self.assertEqual((len(rows), [row[0] for row in rows]), (listed, list(range(1, listed + 1))))
            self.assertAlmostEqual(sum(float(row[3]) for row in rows)*places/listed, 1.0e6*done["supply_flow"], delta=0.02)
            self.assertEqual([row[5] for row in rows], ["choked"*(float(row[4]) < 0.52828*600.0) for row in rows])
            words |= {row[5] for row in rows}
            shapes = [look for look, _, _ in case_sketch(case)["shapes"] if look.startswith("hole")]
            self.assertEqual(len(shapes), 8 + 4 if name == "journal" else 12)  # around the shaft, and those that the side shows
            rows = {what: (value, more) for what, value, more, _ in glance(results.summary, case)}
            self.assertEqual(rows["supply"][0], f"{1.0e3*done['supply_flow']:.4g} g/s")
        self.assertEqual(words, {"", "choked"})

    def test_a_supply_that_lifts(self):
        """The lowest supply pressure against that of the case, by what each is above the gas around; a film at its limit has no margin of its own."""
        case = gfb.Case(SMALL | {"feed": {"kind": "porous", "supply_pressure": 5.0e5}, "capacity": {"smallest_gap": 1.0e-5}})
        for lowest, words, factor in ((3.0e5, "lift-off at a supply of 3 bar", 2.0), (1.0e5, "no supply is needed", None)):
            some = {name: {"value": value, "unit": "", "meaning": ""} for name, value in (("lift_off_supply_pressure", lowest), ("minimum_gap", 1.0e-5))}
            (one,) = margins_of(Results(some, case))
            self.assertEqual((one.subject, one.value, one.factor), ("lift-off", words, factor))
        some = {name: {"value": value, "unit": "", "meaning": ""} for name, value in (("critical_mass", 2.0), ("axial_gap", 1.0e-5))}
        self.assertEqual([one.subject for one in margins_of(Results(some, case))], ["hammer"])

    def test_a_verdict_stands_first(self):
        """What limits, and by how much; the nearest of what is kept; and what has no limit, or was not computed."""
        def row(name, value, unit):
            return {name: {"value": value, "unit": unit, "meaning": ""}}

        def verdict(some, groups, **more):
            found = Results(some, gfb.Case(SMALL | groups), Place(3.0, 0.0))
            margins = margins_of(found, **more)
            return sentence(margins, "", not_computed(found, margins)), {(one.subject, one.sign) for one in margins}

        film, mass, wanted = row("minimum_gap", 4.0e-6, "m"), row("critical_mass", 0.25, "kg"), {"capacity": {"smallest_gap": 5.0e-6}}
        words, signs = verdict(film, {})
        self.assertEqual(words, "No limit is known for film: thinnest film 4 um at theta = 172 deg, z = 0 mm. Not computed: whirl, misalignment, temperature.")
        self.assertEqual(signs, {("film", "? no limit known")})
        [(_, _, against, is_bad), *_] = glance(film, gfb.Case(SMALL | wanted), Place(3.0, 0.0))
        self.assertEqual((against, is_bad), ("at theta = 172 deg, z = 0 mm; 5 um are wanted: 0.8 times", True))
        self.assertEqual(verdict(film, wanted)[0], "Film limits this bearing: thinnest film 4 um at theta = 172 deg, z = 0 mm, 5 um are wanted: 0.8 of what is needed. "
                         "Not computed: whirl, misalignment, temperature.")
        words, signs = verdict(film | mass | row("load_capacity", 30.0, "N"), {"rotor": {"mass": 0.1}})
        self.assertTrue(words.startswith("All known limits are kept; load is nearest to its own: load capacity 30 N, the load is 20 N: 1.5 times what is needed. "
                                         "No limit is known for film."), words)
        self.assertEqual(signs, {("film", "? no limit known"), ("load", "✓ kept"), ("whirl", "✓ kept")})
        words, signs = verdict(film | mass, wanted | {"rotor": {"mass": 0.5}})
        self.assertTrue(words.startswith("Whirl limits this bearing: critical mass 0.25 kg, this bearing carries 0.5 kg of the rotor: 0.5 of what is needed. Broken, too: film."), words)
        self.assertEqual(signs, {("film", "✗ broken"), ("whirl", "✗ broken")})
        words, _ = verdict(film | row("growth_rate", 2.0, "1/s") | row("damping_ratio", -0.01, "1") | row("whirl_frequency", 200.0*math.pi, "rad/s"), {}, smallest_gap=3.0e-6)
        self.assertTrue(words.startswith("Whirl limits this bearing: rotor's least damped mode at 100 Hz, it grows with a damping ratio of -0.01."), words)
        words, _ = verdict(film, {}, smallest_gap=2.0e-6)
        self.assertTrue(words.startswith("The one known limit is kept, that of film: thinnest film 4 um at theta = 172 deg, z = 0 mm, 2 um are wanted: 2 times"), words)
        for touch_down, sign in ((2.0e-9, "? no limit known"), (5.0e-6, "✗ broken")):  # the solver's own, and one of the case
            self.assertEqual(verdict(film, {"solver": {"touch_down_gap": touch_down}})[1], {("film", sign)})
        swept = row("onset_speed_rpm", 3.0e4, "rpm") | row("growth_rate", 2.0, "1/s")
        words, signs = verdict(film | swept, {"sweep": {"parameter": "speed_rpm", "values": (1.0e4, 4.0e4)}})
        self.assertTrue(words.startswith("The one known limit is kept, that of whirl: onset of whirl at 30,000 rpm, the speed is 20,000 rpm: 1.5 times"), words)
        self.assertEqual(signs, {("film", "? no limit known"), ("whirl", "✓ kept")})
        hot = row("maximum_film_temperature", 373.15, "K") | row("maximum_top_foil_stress", 2.0e8, "Pa")
        self.assertIn("No limit is known for temperature, stress.", verdict(film | hot, wanted)[0])
        limits = {"capacity": {"highest_temperature": 423.15, "largest_stress": 1.0e8}, "thermal": {"ambient_temperature": 323.15}}
        words, signs = verdict(film | hot, limits)
        self.assertTrue(words.startswith("Stress limits this bearing: largest stress 200 MPa, 100 MPa are allowed: 0.5 of what is needed. No limit is known for film."), words)
        self.assertEqual(signs, {("film", "? no limit known"), ("temperature", "✓ kept"), ("stress", "✗ broken")})
        words, _ = verdict(film | hot | row("maximum_top_foil_temperature", 448.15, "K"), limits)
        self.assertIn("Broken, too: temperature.", words)
        rows = {words: (value, verdict, bad) for words, value, verdict, bad in glance(film | hot, gfb.Case(SMALL | limits))}
        self.assertEqual((rows["allowed temperature"], rows["allowed stress"]), (("film and top foil at most 100 °C", "150 °C are allowed: 2 times", False),
                                                                                 ("largest stress 200 MPa", "100 MPa are allowed: 0.5 times", True)))
        cold = row("maximum_film_temperature", 313.15, "K")  # than the gas around
        self.assertEqual(verdict(film | cold, limits)[1], {("film", "? no limit known"), ("temperature", "✓ kept")})
        many = {"sweep": {"parameter": "speed_rpm", "values": (1.0e4, 4.0e4)}} | wanted | limits | {"capacity": wanted["capacity"] | limits["capacity"]}
        worst = row("film_margin", 0.5, "1") | row("temperature_margin", 0.8, "1") | row("stress_margin", 0.25, "1")
        words, signs = verdict(film | hot | worst, many)
        self.assertTrue(words.startswith("Stress limits this bearing: largest stress 400 MPa (at the worst point), 100 MPa are allowed: 0.25 of what is needed. "
                                         "Broken, too: film, temperature."), words)
        self.assertEqual([margin.value for margin in margins_of(Results(film | hot | worst, gfb.Case(SMALL | many)))],
                         ["thinnest film 2.5 um", "film and top foil at most 175 °C", "largest stress 400 MPa"])
        [(_, _, against, is_bad), *_] = glance(film | worst, gfb.Case(SMALL | many), Place(3.0, 0.0))
        self.assertEqual((against, is_bad), ("at theta = 172 deg, z = 0 mm; 5 um are wanted: 0.5 times (at the worst point)", True))
        self.assertEqual(margins_of(Results(film, gfb.Case(SMALL | {"scene": {"analysis": "load_capacity"}} | wanted))), [])
        self.assertEqual(sentence([Margin("film", "4 um")], "No answer was found."), "No answer was found.")
        parts = [Margin("film", "4 um", "2 um are wanted", 2.0), Margin("orbit", "orbit under G 2.5", "no answer")]
        self.assertEqual((sentence(parts), parts[1].sign), ("The one known limit is kept, that of film: 4 um, 2 um are wanted: 2 times what is needed. No answer: orbit.", "✗ no answer"))
        parts[1].limit = STOPPED
        self.assertEqual((sentence(parts).partition("needed. ")[2], parts[1].sign, colour_of(parts)), ("Stopped before the end: orbit.", "… stopped", ""))

    def test_page_and_terminal_begin_with_the_same_words(self):
        runs = [read_run(self.folder/name, None, pictures=False) for name in ("first", "second")]
        page = Page(write_page(runs, self.folder/"both.html").read_text(encoding="utf-8"))
        words = " ".join(" ".join(page.words).split())
        watts = self.first["power_loss"], runs[1]["summary"]["power_loss"]["value"]
        self.assertIn(f"Power loss of the 2 cases together: {sum(watts):.4g} W", words)
        for line in plain(runs).splitlines():
            self.assertIn(line.replace("first: ", "first : ").replace("second: ", "second : "), words)
        self.assertLess(words.index("No limit is known for film"), words.index("thinnest film", words.index("Answer")))
        self.assertRegex(words, r"project small & <rigid> case first, second computed \d{4}-\d\d-\d\d gfb \d+\.\d+\S* \S+ made by checked, date")

    def test_stiffness_has_its_frequency(self):
        """All entries of K and C, at the first frequency."""
        case = gfb.Case(SMALL | {"dynamics": {"frequencies": (200.0*math.pi, 600.0)}})
        case["scene%analysis"] = "linear_dynamics"
        found = gfb.run(case, self.folder, "dynamic")
        rows = {words: (value, verdict) for words, value, verdict, _ in read_run(self.folder/"dynamic", None, pictures=False)["glance"]}
        for words, scale in (("stiffness", 1.0e-6), ("damping", 1.0e-3)):
            for axes in ("xx", "xy", "yx", "yy"):
                self.assertIn(f"{axes} {scale*found[f'{words}_{axes}']:.4g}", rows[words][0])
            self.assertEqual(rows[words][1], "at 100 Hz, 0.3 times the speed")

    def test_the_thinnest_film_is_drawn_and_named_where_it_is(self):
        """Three preloaded pads, a bore with waves, a tilt, a thrust bearing: sketch, row, log and the film's own smallest value agree, and
        a journal's centre is elsewhere."""
        thrust = {"bearing": {"kind": "thrust", "outer_radius": 0.05, "inner_radius": 0.025}, "pads": {"count": 6, "arc": 0.78}, "ramp": {"part": 0.5, "height": 2.0e-5},
                  "operation": {"speed_rpm": 40000.0, "axial_load": 200.0, "moment": (0.4, -0.2)},
                  "model": {"foil": "elastic_foundation", "foundation_stiffness": 1.0e10, "foundation_pressure": "local"}, "mesh": {"circumferential_elements": 12, "radial_elements": 6}}
        held = {"speed_rpm": 20000.0, "eccentricity": (6.0e-6, 2.0e-6)}
        scenes = {"pads": {"pads": {"count": 3, "arc": 1.9, "preload": 0.5}}, "waves": {"bore": {"waves": 3, "wave_amplitude": 6.0e-6}},
                  "tilt": {"operation": held | {"tilt": (2.0e-4, 1.0e-4)}, "scene": {"analysis": "fixed_position"}}, "runner": thrust}
        for name, groups in scenes.items():
            result = gfb.run(gfb.Case(SMALL | groups), self.folder, name)
            run = read_run(self.folder/name, None, pictures=False)
            film = result.film
            across = "radius" if name == "runner" else "z"
            smallest = film.gap.where(film.gap <= film.gap.min()*(1.0 + 1.0e-9), drop=True)
            turn = {round(math.degrees(float(angle)) % 360.0, 6) for angle in smallest.theta}
            place, drawn = run["place"], run["sketch"]
            self.assertIn(round(math.degrees(place.angle) % 360.0, 6), turn, name)
            self.assertLess(min(abs(place.across - float(one)) for one in smallest[across]), 1.0e-9, name)
            x, y = drawn["thinnest"][0] - 100.0, 100.0 - drawn["thinnest"][1]
            self.assertLess(abs(math.remainder(math.atan2(y, x) - place.angle, 2.0*math.pi)), 1.0e-9, name)
            self.assertAlmostEqual(math.hypot(x, y), 85.0*place.across/0.05 if name == "runner" else 69.0, places=9)
            log = re.search(r"minimum gap .* at theta = (\S+) deg, z = (\S+) mm" if across == "z" else r"minimum gap .* at radius (?P<across>\S+) mm, (\S+) deg", result.log)
            angle, far = map(float, log.groups() if across == "z" else reversed(log.groups()))
            self.assertLess(abs(math.remainder(angle - math.degrees(place.angle), 360.0)), 0.1, result.log)
            self.assertLess(abs(far - 1.0e3*place.across), 0.01, name)
            rows = {words: verdict for words, _, verdict, _ in run["glance"]}
            self.assertIn(f"theta = {math.degrees(place.angle) % 360.0:.0f} deg", rows["thinnest film"])
            self.assertIn(drawn["words"], rows["thinnest film"])
            if across == "z":
                apart = math.degrees(math.remainder(math.atan2(-result["eccentricity_y"], -result["eccentricity_x"]) - place.angle, 2.0*math.pi))
                self.assertGreater(abs(apart), 10.0, name)
        self.assertIsNone(place_of_thinnest(self.folder/"pads", {"minimum_gap": {"value": 1.0}}), "the film of another state")
        self.assertIsNone(place_of_thinnest(self.folder/"nothing", {"minimum_gap": {"value": 1.0}}))

    @slow
    def test_slow_what_is_no_result(self):
        (self.folder/"bad.h5").write_bytes(b"no HDF5")
        for name, words in (("bad.h5", "not a whole file"), ("none.h5", "there is no such result")):
            status, said = report(self.folder/name)
            self.assertEqual((status, words in said, "Traceback" in said), (1, True, False), said)
        status, said = report(self.folder/"first", "-o", self.folder/"nowhere"/"page.html")
        self.assertEqual((status, bool(re.search(r"page\.html: No such", said))), (3, True), said)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
