#!/usr/bin/env python3
"""tools/studio: values, texts and messages; its server, asked by Python's own HTTP client; its page in Chromium."""

import asyncio
import base64
import concurrent.futures
import contextlib
import http.client
import math
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import matplotlib
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]/"tools"))
from chromium import BROWSER, Browser  # noqa: E402
from gfb.case import Case  # noqa: E402
from gfb.namelist import namelist_value  # noqa: E402
from gfb.program import find_program  # noqa: E402
from gfb.report.main import PAGE, differences  # noqa: E402
from gfb.results import Unreadable  # noqa: E402
from gfb.studio import pictures  # noqa: E402
from gfb.studio.checking import check, read_messages, without_use  # noqa: E402
from gfb.studio.keys import read_keys  # noqa: E402
from gfb.studio.rows import cell, columns_of, shown_columns, with_cell, with_row, without_row  # noqa: E402
from gfb.studio.runs import Folder, Refused, Run, Runs  # noqa: E402
from gfb.studio.text import with_value, without_group  # noqa: E402
from gfb.tool import ROOT  # noqa: E402

LIBRARY = (ROOT/"build/studio_venv/installed.txt").exists()
WITHOUT = "the library NiceGUI is not installed: tools/studio --install puts it into build/studio_venv"
SECONDS = 300
LONG = (ROOT/"inputs/transient_unbalance.nml").read_text(encoding="utf-8")
HOSTILE = "<img src=x onerror=\"document.title='taken'\"><script>document.title='taken'</script>${document.title='taken'}`</script>"
SMALL = f"""! what a bearing is
&scene title = '{HOSTILE.replace("'", "''")}' /
&bearing
  radius = 0.02   ! of the shaft
  length = 0.04
  clearance = 20.0e-6
/
&gas viscosity = 2.0e-5 ambient_pressure = 1.0e5 /
&operation speed_rpm = 20000.0 load = -20.0, 0.0 /
&model foil = 'rigid' /
&mesh circumferential_elements = 48 axial_elements = 8 /
"""


def is_alive(number):
    """Whether a process runs."""
    try:
        state = pathlib.Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state != "Z"


def wait(condition, seconds=SECONDS):
    """Waits until something is so; its value."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.05)
    raise AssertionError("it never came")


class InFolder(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(place.cleanup)
        self.outside = pathlib.Path(place.name)
        (self.outside/"secret.nml").write_text("&scene title = 'secret words' /\n", encoding="utf-8")
        self.folder = self.outside/"cases"
        self.folder.mkdir()
        (self.folder/"small.nml").write_text(SMALL, encoding="utf-8")


class Values(unittest.TestCase):
    """What is typed into a field, and what stands in it."""

    @classmethod
    def setUpClass(cls):
        cls.keys = read_keys(find_program())

    def test_units(self):
        bearing, top_foil = self.keys["bearing"], self.keys["top_foil"]
        for key, words, value in ((bearing["clearance"], "31.8 um", 31.8e-6), (bearing["clearance"], "31.8e-6", 31.8e-6),
                                  (bearing["radius"], "19.05mm", 19.05e-3), (bearing["radius"], "0.02 m", 0.02),
                                  (top_foil["youngs_modulus"], "214 GPa", 214.0e9), (self.keys["operation"]["load"], "-100, 0", (-100.0, 0.0)),
                                  (self.keys["bump_foil"]["bumps"], "26", 26), (self.keys["bump_foil"]["strip_height"], "2*0.5e-3", (0.5e-3, 0.5e-3)),
                                  (bearing["kind"], "thrust", "thrust"), (self.keys["scene"]["title"], "2", "2"),
                                  (self.keys["sweep"]["friction_memory"], "true", True), (bearing["radius"], "", None)):
            self.assertEqual((key.typed(words), type(key.typed(words))), (value, type(value)), words)
        self.assertAlmostEqual(bearing["leading_edge_angle"].typed("45 deg"), math.pi/4.0, delta=1.0e-15)
        self.assertEqual(bearing["radius"].shown(19.05e-3), "19.05 mm")
        self.assertEqual(bearing["clearance"].shown(31.8e-6), "31.8 um")
        self.assertEqual(bearing["leading_edge_angle"].shown(math.pi/4.0), "45 deg")
        self.assertEqual(self.keys["gas"]["ambient_pressure"].shown(101350.0), "101.35 kPa")

    def test_other_units_are_known_or_named(self):
        """mil and inch are exact and never shown; of a unit that is none of the key those that are stand in the message."""
        radius, clearance, load = self.keys["bearing"]["radius"], self.keys["bearing"]["clearance"], self.keys["operation"]["load"]
        self.assertEqual((clearance.typed("1.25 mil"), radius.typed("0.75 inch"), radius.typed("0.75in"), self.keys["gas"]["ambient_pressure"].typed("1.5 bar")),
                         (31.75e-6, 19.05e-3, 19.05e-3, 150000.0))
        self.assertEqual((clearance.shown(1.25*25.4e-6), radius.shown(0.75*25.4e-3)), ("31.75 um", "19.05 mm"))
        for key, words, said in ((radius, "30 mils", "30 mils: 'mils' is no unit of this key; it knows mm, um, m, mil, inch and in"),
                                 (load, "-100, 2 kgf", "2 kgf: 'kgf' is no unit of this key; it knows N"), (self.keys["pads"]["preload"], "3 mm", "3 mm: this key is a number without a unit"),
                                 (radius, "abc", ""), (radius, "30 mil", ""), (self.keys["scene"]["title"], "30 mils", ""), (self.keys["model"]["foil"], "30 mils", "")):
            self.assertEqual(key.unknown_unit(key.typed(words)), said, words)

    def test_what_is_no_value_is_the_programs_to_refuse(self):
        radius = self.keys["bearing"]["radius"]
        for words in ("1 furlong", "abc", "1.0 / &gas", "1.0 um um", "'x'", "1,,2"):
            text = with_value(SMALL, "bearing", "radius", namelist_value(radius.typed(words)))
            found = asyncio.run(check(find_program(), text))
            self.assertFalse(found.is_right, words)
            self.assertIn(("bearing", "radius"), [(one.group, one.key) for one in found.messages], words)
            self.assertEqual(list(Case.parse(text).groups), list(Case.parse(SMALL).groups), words)

    def test_every_key_of_every_input_is_known_and_comes_back(self):
        seen = 0
        for path in sorted((ROOT/"inputs").glob("*.nml")):
            for group, values in Case.read(path).groups.items():
                for name, value in values.items():
                    key, seen = self.keys[group][name], seen + 1
                    back = key.typed(key.shown(value))
                    if isinstance(value, (float, tuple)) and not isinstance(back, str) and not isinstance(value[0] if isinstance(value, tuple) else 0.0, str):
                        for one, other in zip(value if isinstance(value, tuple) else (value,), back if isinstance(back, tuple) else (back,), strict=True):
                            self.assertAlmostEqual(one, other, delta=1.0e-11*abs(one), msg=f"{path.name} {group}%{name}")
                    else:
                        self.assertEqual(back, value, f"{path.name} {group}%{name}")
        self.assertGreater(seen, 1000)

    def test_the_table_is_that_of_the_program(self):
        listed = subprocess.run([find_program(), "--keys"], capture_output=True, text=True, check=True).stdout.count("\n| `&")
        self.assertEqual(sum(map(len, self.keys.values())), listed)
        self.assertIn("shell", self.keys["model"]["foil"].choices)


class Rows(unittest.TestCase):
    """The lists of a machine as tables."""

    @classmethod
    def setUpClass(cls):
        cls.keys = read_keys(find_program())

    def test_columns(self):
        columns = columns_of("shaft", self.keys["shaft"])
        self.assertEqual((columns[:3], "elements" in columns), (["lengths", "outer_diameters", "inner_diameters"], False))
        shown = shown_columns("shaft", self.keys["shaft"], {"lengths": (0.1, 0.2), "poissons_ratio": 0.3})
        self.assertEqual(shown, ["lengths", "outer_diameters", "youngs_modulus", "poissons_ratio", "density"])
        self.assertEqual([shown_columns(group, self.keys[group], {}) for group in ("shaft", "bearing")], [[], []])
        self.assertEqual(columns_of("bearings", self.keys["bearings"])[:2], ["files", "positions"])

    def test_cells(self):
        values = {"lengths": (0.1, 0.2, 0.3), "outer_diameters": 0.03}
        self.assertEqual([cell(values, "shaft", name, 1) for name in ("lengths", "outer_diameters", "density")], [(0.2, False), (0.03, True), (None, False)])
        for name, row, value, after in (("lengths", 1, 0.4, (0.1, 0.4, 0.3)), ("outer_diameters", 0, 0.04, 0.04), ("outer_diameters", 2, 0.04, (0.03, 0.03, 0.04)),
                                        ("density", 1, 7800.0, 7800.0), ("outer_diameters", 0, None, None), ("lengths", 0, None, (0.1, 0.2, 0.3))):
            self.assertEqual(with_cell(values, "shaft", name, row, value), after, (name, row, value))
        self.assertEqual(with_cell({"files": "a.nml"}, "bearings", "files", 0, "b.nml"), "b.nml")

    def test_rows_come_and_go(self):
        keys, values = columns_of("shaft", self.keys["shaft"]), {"lengths": (0.1, 0.2), "outer_diameters": (0.03, 0.02), "density": 7850.0}
        more = with_row(values, "shaft", keys)
        self.assertEqual(more, {"lengths": (0.1, 0.2, 0.2), "outer_diameters": (0.03, 0.02, 0.02)})
        self.assertEqual(without_row(values | more, "shaft", keys, 0), {"lengths": (0.2, 0.2), "outer_diameters": (0.02, 0.02)})
        self.assertEqual(without_row(values, "shaft", keys, 1), {"lengths": 0.1, "outer_diameters": 0.03})
        self.assertEqual(with_row({"lengths": 0.1, "density": 7850.0}, "shaft", keys), {"lengths": (0.1, 0.1)})
        self.assertEqual(without_row({"lengths": 0.1}, "shaft", keys, 0), {})


class Texts(unittest.TestCase):
    """One value changes, all else stays."""

    def test_a_value_is_replaced(self):
        self.assertEqual(with_value(SMALL, "bearing", "radius", "0.03"), SMALL.replace("radius = 0.02 ", "radius = 0.03 "))
        self.assertEqual(with_value(SMALL, "operation", "load", "1.0, 2.0"), SMALL.replace("-20.0, 0.0", "1.0, 2.0"))
        self.assertEqual(with_value("&a b = '/ & b = 1' c = 2 /", "a", "c", "3"), "&a b = '/ & b = 1' c = 3 /")

    def test_a_value_comes_and_goes(self):
        text = with_value(SMALL, "bearing", "leading_edge_angle", "0.1")
        self.assertIn("  clearance = 20.0e-6\n  leading_edge_angle = 0.1\n/\n", text)
        self.assertEqual(with_value(text, "bearing", "leading_edge_angle", None), SMALL)
        text = with_value(SMALL, "rotor", "mass", "1.0")
        self.assertTrue(text.endswith("\n&rotor\n  mass = 1.0\n/\n"))
        self.assertEqual(without_group(text, "rotor").rstrip(), SMALL.rstrip())
        self.assertEqual(with_value(SMALL, "rotor", "mass", None), SMALL)

    def test_every_input(self):
        for path in sorted((ROOT/"inputs").glob("*.nml")):
            text, case = path.read_text(encoding="utf-8"), Case.read(path)
            for name in case:
                group, key = name.split("%")
                other = case.copy()
                del other[name]
                left = with_value(text, group, key, None)
                self.assertEqual(Case.parse(left).groups, other.groups, f"{path.name} {name}")
                again = with_value(left, group, key, namelist_value(case[name]))
                self.assertEqual(Case.parse(again).groups, case.groups, f"{path.name} {name}")
                self.assertEqual(left.count("!"), text.count("!") - sum("!" in line for line in text.splitlines() if line not in left.splitlines()))


class Messages(unittest.TestCase):
    def test_each_has_its_place(self):
        text = SMALL.replace("radius = 0.02 ", "radius = -1.0 ").replace("length = 0.04", "lenght = 0.04").replace("foil = 'rigid'", "foil = 'rigidd'")
        found = asyncio.run(check(find_program(), text))
        self.assertEqual({(one.line, one.group, one.key) for one in found.messages if not one.is_warning},
                         {(4, "bearing", "radius"), (5, "bearing", "lenght"), (10, "model", "foil")})
        without = asyncio.run(check(find_program(), SMALL.replace("length = 0.04", "")))
        self.assertEqual([(one.group, one.key) for one in without.messages], [("bearing", "length")])
        self.assertIn("did you mean 'length'", " ".join(map(str, found.messages)))
        self.assertTrue(asyncio.run(check(find_program(), SMALL)).is_right)
        self.assertIn("film mesh: 48 x 8", asyncio.run(check(find_program(), SMALL)).needs)

    def test_every_message_of_the_program_has_a_line_or_a_group(self):
        seen = 0
        for path in sorted((ROOT/"tests/bad_input").glob("*.nml"))[::10]:
            text = path.read_bytes().decode("utf-8", "replace")
            done = subprocess.run([find_program(), "--check", "-"], input=text.encode(), capture_output=True, check=False)
            for one in read_messages(done.stderr.decode("utf-8", "replace")):
                self.assertNotIn("stdin", one.words, path.name)
                seen += bool(one.line or one.group)
        self.assertGreater(seen, 40)


class Checked(InFolder):
    def test_what_has_no_use_is_the_programs_to_say(self):
        found = asyncio.run(without_use(find_program(), SMALL))
        self.assertEqual(found["bearing", "outer_radius"], "needs kind = 'thrust' in &bearing")
        self.assertEqual(found["transient", "turns"], "has no use with analysis = 'equilibrium'")
        self.assertNotIn(("bearing", "radius"), found)
        ring = asyncio.run(without_use(find_program(), SMALL.replace("&bearing", "&bearing kind = 'thrust'")))  # which has mistakes
        self.assertEqual([("bearing", one) in ring for one in ("radius", "outer_radius")], [True, False])
        self.assertEqual(asyncio.run(without_use("/bin/true", SMALL)), {})

    def test_what_a_library_says_beside_it_is_no_mistake(self):
        path = self.folder/"talking"
        path.write_text(f"#!/bin/sh\necho 'no /sys here' >&2\nexec {find_program()} \"$@\"\n", encoding="utf-8")
        path.chmod(0o755)
        self.assertEqual(asyncio.run(check(path, SMALL)).messages, ())
        self.assertFalse(asyncio.run(check(path, SMALL.replace("radius", "radios"))).is_right)


class Places(InFolder):
    """The chosen folder and what is outside."""

    def test_outside_is_refused(self):
        (self.folder/"link.nml").symlink_to(self.outside/"secret.nml")
        (self.folder/"below").symlink_to(self.outside)
        place = Folder(self.folder)
        for name in ("../secret.nml", str(self.outside/"secret.nml"), "link.nml", "below/secret.nml", "a/../../secret.nml", "\0.nml", "a"*5000):
            with self.assertRaises(Refused, msg=name):
                place.read(name)
        self.assertEqual(place.cases(), ["small.nml"])
        for name in ("../new", "", ".hidden", "a/b", "link", None, "\0"):
            with self.assertRaises(Refused, msg=name):
                place.write(name, "text", None)
        self.assertEqual((self.outside/"secret.nml").read_text(encoding="utf-8"), "&scene title = 'secret words' /\n")

    def test_what_somebody_else_wrote_stays(self):
        place = Folder(self.folder)
        with self.assertRaises(Refused):
            place.write("small", "mine", None)
        place.write("small", "mine", SMALL)
        with self.assertRaises(Refused):
            place.write("small", "older", SMALL)
        self.assertEqual((self.folder/"small.nml").read_text(encoding="utf-8"), "mine")

    def test_a_run_never_gets_the_folder_of_another(self):
        place = Folder(self.folder)
        made = [place.new_run("small", SMALL) for _ in range(3)]
        self.assertEqual([path.name for path in made], ["small.run1", "small.run2", "small.run3"])
        shutil.rmtree(made[1])
        self.assertEqual(place.new_run("small", SMALL).name, "small.run2")
        (self.folder/"small.run4").symlink_to(self.outside)
        self.assertEqual(place.new_run("small", SMALL).name, "small.run5")
        self.assertEqual([path.name for path in self.outside.iterdir() if path.is_file()], ["secret.nml"])

    def test_a_machine_takes_its_bearings_along(self):
        """Those of the folder alone: into the folder of its run, and for the check by their whole names."""
        place = Folder(self.folder)
        text = "&bearings files = 'small.nml', 'small.nml' positions = 0.1, 0.2 /\n"
        path = place.new_run("mine", text)
        self.assertEqual(sorted(one.name for one in path.iterdir()), ["mine.bearing_1.nml", "mine.nml"])
        self.assertEqual((path/"mine.bearing_1.nml").read_text(encoding="utf-8"), SMALL)
        self.assertEqual((path/"mine.nml").read_text(encoding="utf-8"), text.replace("small", "mine.bearing_1"))
        self.assertEqual(place.whole(text), text.replace("small.nml", str(place.path/"small.nml")))
        (self.folder/"link.nml").symlink_to(self.outside/"secret.nml")
        for name in ("../secret.nml", str(self.outside/"secret.nml"), "link.nml", "none.nml"):
            for way in (place.whole, lambda words: place.new_run("other", words)):
                with self.assertRaises(Refused, msg=name):
                    way(text.replace("small.nml", name))
        self.assertFalse((self.folder/"other.run1").exists())

    def test_only_files_are_opened_and_written(self):
        """A pipe is not waited for, what is too large is not read, and no link is followed: neither to read nor to write."""
        place, secret = Folder(self.folder), self.outside/"secret.nml"
        os.mkfifo(self.folder/"pipe.nml")
        (self.folder/"folder.nml").mkdir()
        (self.folder/"gone.nml").symlink_to(self.outside/"new.nml")
        (self.folder/"link.nml").symlink_to(secret)
        with open(self.folder/"large.nml", "wb") as large:
            large.truncate(3*2**30)
        begin = time.monotonic()
        for name in ("pipe", "folder", "gone", "link", "large"):
            for known in (None, "", SMALL, secret.read_text(encoding="utf-8")):
                with self.assertRaises(Refused, msg=name):
                    place.write(name, "mine", known)
            with self.assertRaises(Refused, msg=name):
                place.read(f"{name}.nml")
        self.assertLess(time.monotonic() - begin, 20.0)
        self.assertEqual(secret.read_text(encoding="utf-8"), "&scene title = 'secret words' /\n")
        self.assertFalse((self.outside/"new.nml").exists())
        self.assertEqual((self.folder/"large.nml").stat().st_size, 3*2**30)
        self.assertEqual(place.cases(), ["large.nml", "small.nml"])

    def test_nobody_foresees_the_name_under_which_a_file_is_written(self):
        place = Folder(self.folder)
        for number in (os.getpid(), 0):
            (self.folder/f".small.nml.{number}").symlink_to(self.outside/"secret.nml")
        place.write("small", "mine", SMALL)
        place.write("new", "mine", None)
        self.assertEqual([(self.folder/f"{name}.nml").read_text(encoding="utf-8") for name in ("small", "new")], ["mine", "mine"])
        self.assertEqual((self.outside/"secret.nml").read_text(encoding="utf-8"), "&scene title = 'secret words' /\n")
        self.assertEqual(len([path for path in self.folder.iterdir() if not path.is_symlink()]), 2)

    def test_of_two_tabs_that_save_at_a_time_one_does(self):
        place = Folder(self.folder)

        def save(text):
            with contextlib.suppress(Refused):
                place.write("small", text, SMALL)
                return text
            return None
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            done = [text for text in pool.map(save, map(str, range(40))) if text]
        self.assertEqual([(self.folder/"small.nml").read_text(encoding="utf-8")], done)

    def test_pictures_look_as_those_of_the_report(self):
        """Colours of curves and the font are those of tools/plot; pages have the font, and the colours of verdicts, from one place."""
        layout = pictures.curves([("one", {"a": numpy.arange(3.0), "b": numpy.arange(3.0)}, {"a": "m", "b": "Pa"})], "a", "b")["layout"]
        colours, font = [one["color"] for one in matplotlib.rcParams["axes.prop_cycle"]], matplotlib.rcParams["font.sans-serif"][0]
        self.assertEqual((list(layout["colorway"]), layout["font"]["family"].split(", ")[0]), (colours, font))
        self.assertEqual((layout["xaxis"]["title"]["text"], layout["yaxis"]["title"]["text"]), ("a [um]", "b [kPa]"))
        self.assertIn(f"body {{ font-family: {font}, ", PAGE.get_template("look.css").render())
        for page in ("report/page.html", "studio/page.css", "studio/page.py"):
            text = (ROOT/"tools/gfb"/page).read_text(encoding="utf-8")
            self.assertEqual(re.findall(r"Verdana|#a00|#17652b|\.sign\.|2b4a6f|2b6cb0|b2502f", text), [], page)

    def test_films_go_from_0_to_360_degrees_with_the_scale_of_the_report(self):
        """A pad over 360 degrees is in two, with its value there; the gap has a logarithmic scale, one for all that stand side by side."""
        theta = numpy.radians(numpy.linspace(300.0, 420.0, 7))
        values = numpy.degrees(theta)[:, None]*numpy.ones(3)
        parts = pictures.within_a_turn(theta, values)
        self.assertEqual([(round(float(numpy.degrees(place[0])), 9), round(float(numpy.degrees(place[-1])), 9)) for place, _ in parts], [(300.0, 360.0), (0.0, 60.0)])
        numpy.testing.assert_allclose([*parts[0][1][-1], *parts[1][1][0], *parts[1][1][-1]], [360.0]*6 + [420.0]*3)
        [(place, _)] = pictures.within_a_turn(numpy.radians(numpy.linspace(-90.0, -10.0, 5)), values[:5])
        numpy.testing.assert_allclose(numpy.degrees(place[[0, -1]]), [270.0, 350.0])
        [(place, _)] = pictures.within_a_turn(numpy.radians(numpy.linspace(0.0, 360.0, 5)), values[:5])
        numpy.testing.assert_allclose(numpy.degrees(place[[0, -1]]), [0.0, 360.0])
        runs = [self.folder/f"run{number}" for number in range(2)]
        for run, clearance in zip(runs, ("20.0e-6", "40.0e-6")):
            run.mkdir()
            (run/"small.nml").write_text(SMALL.replace("20.0e-6", clearance) + "&pads count = 3 arc = 1.9 first_leading_edge = 2.0 /\n", encoding="utf-8")
            subprocess.run([find_program(), "--quiet", "--output", run, run/"small.nml"], check=True, stdout=subprocess.DEVNULL)
        figures = [pictures.draw(run/"small", "film: gap") for run in runs]
        pictures.same_colours(figures)
        x = numpy.concatenate([one["x"].ravel() for one in figures[0]["data"]])
        self.assertTrue(0.0 <= x.min() < 10.0 and 350.0 < x.max() <= 360.0)
        heights = [float(pick(one["z"])) for figure in figures for one in figure["data"] for pick in (numpy.min, numpy.max)]
        low, high = min(heights), max(heights)
        for figure in figures:
            self.assertEqual(figure["layout"]["scene"]["zaxis"]["type"], "log")
            numpy.testing.assert_allclose(figure["layout"]["scene"]["zaxis"]["range"], numpy.log10([low, high]))
            for one in figure["data"]:
                numpy.testing.assert_allclose(one["surfacecolor"], numpy.log(one["z"]/low)/math.log(high/low), atol=1.0e-5)
                numpy.testing.assert_allclose(one["colorbar"]["tickvals"], [math.log(float(tick)/low)/math.log(high/low) for tick in one["colorbar"]["ticktext"]], atol=1.0e-5)
        pressure = [pictures.draw(run/"small", "film: pressure") for run in runs]
        pictures.same_colours(pressure)
        self.assertNotIn("type", pressure[0]["layout"]["scene"]["zaxis"])

    def test_differences_of_two_answers(self):
        """In the units that people read; what is rounding is none."""
        def answer(**values):
            return {"summary": {name: {"value": value, "unit": unit, "meaning": name} for name, (value, unit) in values.items()}}
        rows = differences(answer(gap=(4.0e-6, "m"), force=(20.0, "N"), other=(1.0e-15, "N"), words=("a", ""), gone=(1.0, "1"), none=(math.nan, "1"), power=(0.0, "W")),
                                   answer(gap=(5.0e-6, "m"), force=(20.0 + 1.0e-12, "N"), other=(2.0e-15, "N"), words=("b", ""), none=(1.0, "1"), power=(3.0, "W")))
        self.assertEqual([(row["name"], row["first"], row["second"], row["more"], row["percent"]) for row in rows],
                         [("gap [um]", 4.0, 5.0, 1.0, 25.0), ("power [W]", 0.0, 3.0, 3.0, "")])

    def test_what_stands_beside_a_result_is_no_link(self):
        """Neither the result nor a companion of it is taken from elsewhere, or waited for."""
        place, elsewhere = Folder(self.folder), self.outside/"elsewhere"
        run = self.folder/"small.run1"
        for folder in (run, elsewhere):
            subprocess.run([find_program(), "--quiet", "--output", folder, self.folder/"small.nml"], check=True, stdout=subprocess.DEVNULL)
        (self.folder/"link.run1").symlink_to(elsewhere)
        self.assertEqual(place.results(), ["small.run1/small"])
        whole = pictures.read_result(place, "small.run1/small")
        self.assertIn("film: pressure", whole["pictures"])
        self.assertTrue(pictures.draw_result(place, whole["stem"], "film: pressure")["data"])
        for name in ("link.run1/small", "../elsewhere/small", "none/small"):
            with self.assertRaises((Refused, OSError), msg=name):
                pictures.read_result(place, name)
        for ending in (".h5", ".summary", ".film.vtkhdf", ".top_foil.vtkhdf"):
            path = run/f"small{ending}"
            kept = path.read_bytes() if path.exists() else None
            for make in (lambda path, ending: path.symlink_to(elsewhere/f"small{ending if ending != '.top_foil.vtkhdf' else '.film.vtkhdf'}"),
                         lambda path, ending: os.mkfifo(path), lambda path, ending: path.mkdir()):
                path.unlink(missing_ok=True)
                make(path, ending)
                with self.assertRaises(Unreadable) as told:
                    pictures.read_result(place, "small.run1/small")
                self.assertIn(path.name, str(told.exception))
                if ending == ".film.vtkhdf":
                    with self.assertRaises(Unreadable):
                        pictures.draw_result(place, whole["stem"], "film: pressure")
                (path.rmdir if path.is_dir() and not path.is_symlink() else path.unlink)()
            if kept is not None:
                path.write_bytes(kept)
        self.assertTrue(pictures.read_result(place, "small.run1/small")["glance"])


class Processes(InFolder):
    """Runs begin, say how far they are, and end."""

    def runs(self, script=None):
        """Runs of gfb, or of a script in its place."""
        if script is None:
            return Runs(Folder(self.folder), find_program())
        path = self.outside/"gfb"
        path.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        path.chmod(0o755)
        return Runs(Folder(self.folder), str(path))

    async def ended(self, run):
        while run.status is None:
            await asyncio.sleep(0.02)

    def test_a_run_leaves_results(self):
        (self.folder/".petscrc").write_text("-version\n", encoding="utf-8")  # with which PETSc says its version and stops

        async def work():
            runs = self.runs()
            run = await runs.start("small", SMALL)
            await self.ended(run)
            return run
        run = asyncio.run(work())
        self.assertEqual((run.status, run.words), (0, "has an answer"))
        self.assertEqual(run.stem.resolve(), (self.folder/"small.run1/small").resolve())
        self.assertIn("minimum gap", "\n".join(run.lines))
        self.assertEqual(Folder(self.folder).results(), ["small.run1/small"])

    def test_progress_is_that_of_the_points(self):
        class Process:
            returncode = None
        run = Run("a", self.folder, Process())
        self.assertIsNone(run.part)
        run.lines = ["film 4 x 4", "point 4 of 9: load = 3 N, about 2 s left", "a line of 3 words"]
        self.assertEqual(run.part, 3/9)

    def test_a_run_is_stopped(self):
        async def work():
            runs = self.runs()
            run = await runs.start("long", LONG)
            await asyncio.sleep(1.0)
            self.assertIsNone(run.status)
            runs.end(run)
            await asyncio.wait_for(self.ended(run), SECONDS)
            return run
        run = asyncio.run(work())
        self.assertEqual(run.words, "was stopped")
        self.assertFalse(is_alive(run.process.pid))

    def test_what_does_not_listen_is_killed_with_its_children(self):
        async def work():
            runs = self.runs("trap '' TERM; sleep 600 & echo $!; while :; do sleep 1; done")
            run = await runs.start("deaf", SMALL)
            while not run.lines:
                await asyncio.sleep(0.02)
            runs.end(run)
            await asyncio.wait_for(self.ended(run), SECONDS)
            return run
        run = asyncio.run(work())
        self.assertFalse(is_alive(run.process.pid) or is_alive(int(run.lines[0])))

    def test_a_killed_server_leaves_no_run(self):
        script = ("import asyncio, sys\nfrom gfb.studio.runs import Folder, Runs\n"
                  "async def work():\n    run = await Runs(Folder(sys.argv[1]), sys.argv[2]).start('long', sys.stdin.read())\n"
                  "    print(run.process.pid, flush=True)\n    await asyncio.sleep(600)\nasyncio.run(work())\n")
        with subprocess.Popen([sys.executable, "-c", script, self.folder, find_program()], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                              env={**os.environ, "PYTHONPATH": str(ROOT/"tools")}) as server:
            server.stdin.write(LONG)
            server.stdin.close()
            number = int(server.stdout.readline())
            wait(lambda: pathlib.Path(f"/proc/{number}/comm").read_text(encoding="utf-8").strip() == "gfb")
            self.assertTrue(is_alive(number))
            server.kill()
            wait(lambda: not is_alive(number), 10)

    def test_no_more_runs_than_cores(self):
        async def work():
            runs = self.runs("sleep 600")
            for _ in range(runs.most):
                await runs.start("many", SMALL)
            with self.assertRaises(Refused):
                await runs.start("many", SMALL)
            for run in runs.all:
                runs.end(run)
            for run in runs.all:
                await self.ended(run)
        asyncio.run(work())


class Served(InFolder):
    """A server of its own for each test."""

    def setUp(self):
        super().setUp()
        (self.folder/"link.nml").symlink_to(self.outside/"secret.nml")
        self.server = subprocess.Popen([ROOT/"tools/studio", self.folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                       stdin=subprocess.DEVNULL, env={**os.environ, "GFB": find_program(), "GFB_INSTALL": "no"})
        self.addCleanup(self.end)
        line = self.server.stdout.readline()
        if not line:
            self.fail(self.server.stderr.read())
        self.address = re.search(r"http://127\.0\.0\.1:(\d+)(/[\w-]{20,}/)", line)
        self.port, self.root = int(self.address[1]), self.address[2]
        wait(self.answers)

    def answers(self):
        with contextlib.suppress(OSError):
            return self.ask(self.root)[0] == 200

    def end(self):
        self.server.terminate()
        try:
            _, self.complaint = self.server.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            self.server.kill()
            self.server.communicate()
            raise

    def ask(self, path, method="GET", body=None, **headers):
        """Status, headers and text of what the server answers."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=SECONDS)
        with contextlib.closing(connection):
            connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read().decode("utf-8", "replace")

    def socket_status(self, path, origin, host=None):
        """The first line of the answer to a websocket that a page of that origin opens."""
        key = base64.b64encode(os.urandom(16)).decode()
        words = [f"GET {path} HTTP/1.1", f"Host: {host or f'127.0.0.1:{self.port}'}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13", *([f"Origin: {origin}"] if origin else []), "", ""]
        with socket.create_connection(("127.0.0.1", self.port), timeout=SECONDS) as wire:
            wire.sendall("\r\n".join(words).encode())
            return int(wire.recv(4096).split()[1])


@unittest.skipUnless(LIBRARY, WITHOUT)
class ServerTest(Served):
    def test_who_gets_nothing(self):
        """All in one server: each request differs from one that is answered by one thing."""
        own = f"http://127.0.0.1:{self.port}"
        polling, wire = f"{self.root}_nicegui_ws/socket.io/?EIO=4&transport=polling", f"{self.root}_nicegui_ws/socket.io/?EIO=4&transport=websocket"
        status, headers, text = self.ask(self.root)
        self.assertEqual(status, 200)
        self.assertIn("frame-ancestors 'none'", headers["content-security-policy"])
        self.assertEqual(headers["referrer-policy"], "no-referrer")
        self.assertNotIn("access-control-allow-origin", {name.lower() for name in headers})
        self.assertEqual((self.ask(self.root, Origin=own)[0], self.ask(polling, Origin=own)[0]), (200, 200))
        self.assertEqual(self.socket_status(wire, own), 101)
        with self.subTest("another site's page"):
            for origin in ("https://example.org", "null", "http://127.0.0.1", f"http://localhost:{self.port + 1}", f"http://127.0.0.1:{self.port}.example.org"):
                for path, method in ((self.root, "GET"), (self.root, "POST"), (polling, "GET"), (polling, "POST")):
                    self.assertEqual(self.ask(path, method, Origin=origin)[0], 403, (origin, path))
                self.assertEqual(self.socket_status(wire, origin), 403, origin)
        with self.subTest("another name for this machine"):
            for host in ("example.org", f"example.org:{self.port}", f"127.0.0.1:{self.port + 1}", "127.0.0.1"):
                self.assertEqual(self.ask(self.root, Host=host)[0], 403, host)
                self.assertEqual(self.ask(self.root, Host=host, Origin=f"http://{host}")[0], 403, host)
                self.assertEqual(self.socket_status(wire, f"http://{host}", host), 403, host)
        with self.subTest("no token, or another"):
            wrong = "/" + self.root[2:-1] + ("A" if self.root[1] != "A" else "B") + "/"
            for first in ("/", wrong, self.root[:-2] + "/", "/../", f"/.{self.root}"):
                for rest in ("", "_nicegui_ws/socket.io/?EIO=4&transport=polling", "favicon.ico", "docs", "openapi.json"):
                    answer = self.ask(first + rest)
                    self.assertEqual(answer[0], 404, first + rest)
                    self.assertNotIn("gfb", answer[2])
                self.assertIn(self.socket_status(f"{first}_nicegui_ws/socket.io/?EIO=4&transport=websocket", own), (403, 404), first)
        with self.subTest("files"):
            for name in ("../secret.nml", "small.nml", "..%2f..%2fsecret.nml", "_nicegui/../../../../../../../../etc/passwd", "%2e%2e/secret.nml",
                         "/etc/passwd"):
                status, _, text = self.ask(self.root + name)
                self.assertFalse("secret words" in text or "root:" in text or "what a bearing is" in text, name)
        with self.subTest("another machine"):
            listening = [line.split()[1] for table in ("tcp", "tcp6") for line in
                         pathlib.Path(f"/proc/{self.server.pid}/net/{table}").read_text(encoding="utf-8").splitlines()[1:]
                         if line.split()[3] == "0A" and line.split()[1].endswith(f":{self.port:04X}")]
            self.assertEqual(listening, [f"0100007F:{self.port:04X}"])

    def test_what_is_no_page_of_its_own_is_a_line_each(self):
        """A page that is fetched and not opened, and frames that are junk."""
        key = base64.b64encode(os.urandom(16)).decode()
        head = (f"GET {self.root}_nicegui_ws/socket.io/?EIO=4&transport=websocket HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\nUpgrade: websocket\r\n"
                f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode()
        junk = (b"", b"junk", b"9", b"4junk", b"42{", b'42["handshake"]', b'42["handshake",{"x":1}]', b'42["event",1]', b"4" + b"2"*100,
                b'451-["a",{"_placeholder":true,"num":9}]', b"\xff\xfe")
        for payload in junk:
            with socket.create_connection(("127.0.0.1", self.port), timeout=20) as wire:
                wire.sendall(head)
                wire.recv(4096)
                for words in (b"40", payload):
                    wire.sendall(bytes([0x81, 0x80 | len(words), 0, 0, 0, 0]) + words)
                    time.sleep(0.1)
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as wire:
            wire.sendall(b"junk\r\n\r\n")
            wire.recv(4096)
        self.assertEqual(self.ask(self.root)[0], 200)
        self.end()
        lines = self.complaint.splitlines()
        self.assertEqual([line for line in lines if not line.startswith("gfb studio: ")], [])
        self.assertLessEqual(len(lines), 2*len(junk))
        self.assertGreater(len(lines), 2)

    def test_it_ends_by_a_signal_and_says_nothing_more(self):
        self.end()
        self.assertEqual((self.server.returncode in (0, -signal.SIGTERM, 128 + signal.SIGTERM), self.complaint), (True, ""))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["link.nml", "small.nml"])


@unittest.skipUnless(LIBRARY, WITHOUT)
class StartTest(InFolder):
    def test_what_is_wrong_is_one_sentence(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            for words, status, said in ((["none"], 1, "no such folder"), (["--gfb", "none", "--port", "0", "none"], 1, "no such folder"),
                                        (["--port", str(taken.getsockname()[1])], 3, "--port"), (["--port", "99999999"], 3, "--port")):
                done = subprocess.run([ROOT/"tools/studio", *words], capture_output=True, text=True, check=False, cwd=self.folder,
                                      env={**os.environ, "GFB": find_program(), "GFB_INSTALL": "no"}, timeout=SECONDS)
                self.assertEqual((done.returncode, done.stderr.count("\n"), said in done.stderr), (status, 1, True), done.stderr)


@unittest.skipUnless(LIBRARY, WITHOUT)
@unittest.skipUnless(BROWSER, "Chromium is not installed")
class BrowserTest(Served):
    def setUp(self):
        super().setUp()
        profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(profile.cleanup)
        self.browser = Browser(profile.name)
        self.addCleanup(self.browser.close)

    def open(self, case="", **size):
        """A tab, once its case is checked."""
        page = self.browser.page(self.address[0] + (f"?case={case}" if case else ""), **size)
        page.wait("/in order|mistake/.test(document.querySelector('.verdict')?.innerText)")
        return page

    def text(self, page):
        """What stands in the editor; of a long text what is seen of it."""
        return page.run("document.querySelector('.cm-content').innerText")

    def assert_quiet(self, *pages):
        """No complaint of the page, nothing asked for elsewhere, nothing taken over."""
        for page in pages:
            self.assertEqual(page.complaints(), [])
            asked = page.asked()
            self.assertGreater(len(asked), 10)
            self.assertEqual({one.split(":")[0] for one in asked} | {"http", "data", "blob"}, {"http", "data", "blob"})
            self.assertEqual([one for one in asked if one.startswith("http") and not one.startswith(self.address[0])], [])
            self.assertEqual(page.run("document.title"), "gfb studio")

    def test_a_case_is_built_checked_run_and_compared(self):
        page = self.open()
        for group, key, words in (("bearing", "radius", "20 mm"), ("bearing", "length", "40 mm"), ("bearing", "clearance", "-20 um")):
            page.type(f"[data-key='{group}%{key}']", words)
            page.wait("/=/.test(document.querySelector('.cm-content').innerText)")
        page.wait("document.querySelector('.verdict').innerText.includes('1 mistake')")
        page.wait("document.querySelector('.cm-content').innerText.includes('clearance = -2e-05')")
        field = "document.querySelector(\"[data-key='bearing%clearance']\").closest('.q-field').innerText"
        page.wait(f"{field}.includes('must be positive')")
        self.assertIn("line 8: &bearing: clearance", page.run("document.querySelector('.said').innerText"))
        page.wait("document.querySelectorAll('.cm-line.wrong').length === 1")
        page.press("run", "button")
        page.wait("document.body.innerText.includes('the case has mistakes')")
        self.assertEqual([path.name for path in self.folder.iterdir() if path.is_dir()], [])
        page.type("[data-key='bearing%clearance']", "20 um")
        page.wait("document.querySelector('.verdict').innerText.includes('in order')")
        # The text, and what the form makes of it.
        page.type(".cm-content", SMALL)
        page.wait("document.querySelector(\"[data-key='mesh%axial_elements']\")?.value === '8'")
        page.wait("document.querySelector(\"[data-key='bearing%radius']\").value === '20 mm'")
        page.wait("document.querySelector('.verdict').innerText.includes('in order')")
        page.type("[data-key='bearing%clearance']", "24 um")
        page.wait("document.querySelector('.cm-content').innerText.includes('clearance = 2.4e-05')")
        self.assertIn("! of the shaft", self.text(page))
        for number in (1, 2):
            if number == 2:
                page.press("case", "[role=tab]")
                page.type("[data-key='bearing%clearance']", "20 um")
                page.wait("document.querySelector('.cm-content').innerText.includes('clearance = 2e-05')")
            page.press("run", "button")
            page.wait(f"Array.from(document.querySelectorAll('.state')).filter((one) => one.innerText.includes('has an answer')).length === {number}")
            page.press("show results", "button")
            page.wait(f"document.querySelectorAll('.result .js-plotly-plot canvas').length >= {number} && document.querySelectorAll('.answers').length === {number}")
        ran = [self.folder/f"equilibrium.run{number}" for number in (1, 2)]
        gaps = [float(re.search(r"minimum_gap = (\S+)", (one/"equilibrium.summary").read_text(encoding="utf-8"))[1]) for one in ran]
        self.assertNotEqual(*gaps)
        shown = page.run("document.body.innerText")
        for gap in gaps:
            self.assertIn(f"{1.0e6*gap:.4g} um", shown)
        self.assertIn("bearing%clearance", shown)
        page.press("film: pressure", ".q-field")
        page.press("film: gap", ".q-item")
        page.wait("Array.from(document.querySelectorAll('.result .js-plotly-plot')).filter((one) => one.data?.[0].colorbar.title.text"
                  " === 'gap [um]').length === 2")
        self.assertLessEqual(page.run("document.documentElement.scrollWidth"), 1300)
        page.resize(420, 900)
        page.wait("document.documentElement.scrollWidth <= 420")
        page.press("case", "[role=tab]")
        page.wait("document.documentElement.scrollWidth <= 420")
        self.assert_quiet(page)

    def clipped(self, page):
        """What reaches over the right edge of the window, without what scrolls in the editor."""
        return page.run("Array.from(document.querySelectorAll('body *')).filter((one) => one.offsetParent && !one.closest('.cm-editor, svg')"
                        " && one.getBoundingClientRect().right > innerWidth + 1).map((one) => one.tagName + ' ' + one.className + ' ' + one.getBoundingClientRect().right)")

    def test_a_sketch_follows_and_keys_without_use_are_folded(self):
        page = self.open("small.nml")
        pad = "document.querySelector('.beside-form .pad')?.getAttribute('d')"
        shown = "document.querySelector('.beside-form').textContent"
        page.wait(f"{shown}.includes('clearance 20 um, drawn x 100')")
        before = page.run(pad)
        page.type("[data-key='bearing%clearance']", "1.25 mil")
        page.wait(f"{shown}.includes('clearance 31.75 um, drawn x 100')")
        after = page.run(pad)
        self.assertNotEqual(after, before)
        page.type("[data-key='bearing%clearance']", "30 mils")
        page.wait("document.querySelector('.said').innerText.includes(\"30 mils: 'mils' is no unit of this key; it knows mm, um, m, mil, inch and in\")")
        self.assertEqual(page.run(pad), after, "half a number leaves the last sketch")
        page.type("[data-key='bearing%clearance']", "20 um")
        page.wait("document.querySelector('.verdict').innerText.includes('in order')")
        # The group in which the cursor stands is marked.
        marked = "Array.from(document.querySelectorAll('.beside-form path')).filter((one) => getComputedStyle(one).strokeWidth === '2.2px').map((one) => one.classList[0]).join(' ')"
        page.type("[data-key='gas%viscosity']", "2.1e-5")
        page.wait(f"{marked} === 'gas'")
        page.type("[data-key='operation%speed_rpm']", "21000")
        page.wait(f"{marked}.includes('load')")
        # What a journal cannot use is folded away, and found.
        seen = "!!document.querySelector(\"[data-key='bearing%outer_radius']\")?.offsetParent"
        page.wait("/show the \\d+ keys that have no use/.test(document.body.innerText)")
        self.assertFalse(page.run(seen))
        self.assertFalse(page.run("!!document.querySelector(\"[data-group='transient']\")?.offsetParent"))
        page.press("show the", ".q-toggle")
        page.wait(seen)
        page.wait("document.body.innerText.includes(\"No use here: needs kind = 'thrust' in &bearing. outer radius\")")
        page.press("show the", ".q-toggle")
        page.wait(f"!({seen})")
        page.type("[aria-label='find a key']", "outer_radius")
        page.wait(seen)
        page.resize(400, 900)
        page.wait("document.documentElement.scrollWidth <= 400")
        self.assertEqual(self.clipped(page), [])
        page.resize(1300, 900)
        # Templates are pictures.
        page.press("new", "button")
        page.wait("document.querySelectorAll('.template svg').length >= 11")
        page.press("thrust", ".template")
        page.press("replace it", "button")
        page.wait("document.querySelector('.cm-content').innerText.includes(\"kind = 'thrust'\")")
        page.wait("document.querySelectorAll('.beside-form .ramp').length === 7")
        self.assert_quiet(page)

    def test_a_machine_has_its_segments_in_a_table(self):
        for path in (ROOT/"inputs/machines").glob("rotor*.nml"):
            text = path.read_text(encoding="utf-8")
            (self.folder/path.name).write_text(text.replace("= 120", "= 32").replace("axial_elements = 16", "axial_elements = 4"), encoding="utf-8")
        page = self.open("rotor.nml")
        cells = "Array.from(document.querySelectorAll(\".rows [data-key='shaft%lengths']\")).map((one) => one.value).join(' ')"
        page.wait(f"{cells} === '40 mm 320 mm 40 mm'")
        widths = "Array.from(document.querySelectorAll('.beside-form .of-shaft')).map((one) => one.getBBox().width.toFixed(0)).join(' ')"
        before = page.wait(widths)
        page.type("[data-key='shaft%lengths']", "60 mm")
        page.wait("document.querySelector('.cm-content').innerText.includes('lengths = 0.06, 0.32, 0.04')")
        page.wait(f"{widths} !== '{before}'")
        page.press("add a row", "[data-group='shaft'] button")
        page.wait("document.querySelector('.cm-content').innerText.includes('lengths = 0.06, 0.32, 0.04, 0.04')")
        page.wait(f"{cells} === '60 mm 320 mm 40 mm 40 mm'")
        page.press("close", "[data-group='shaft'] .rows button")
        page.wait(f"{cells} === '320 mm 40 mm 40 mm'")
        page.wait("document.querySelector('.verdict').innerText.includes('in order')")
        page.wait("document.querySelector('.beside-form svg').getBoundingClientRect().top > 0")  # it stays beside the form
        page.picture(self.outside/"machine.png")
        page.type("[data-key='shaft%lengths']", "-1 m")
        page.wait("document.querySelector('.verdict').innerText.includes('mistake')")
        page.wait("document.querySelector(\"[data-group='shaft'] .said\").innerText.includes('must be positive')")
        page.type("[data-key='shaft%lengths']", "0.33 m")
        page.wait("document.querySelector('.verdict').innerText.includes('in order')")
        page.press("run", "button")
        page.wait("document.querySelector('.state')?.innerText.includes('has an answer')")
        self.assertTrue((self.folder/"rotor.run1/rotor.bearing_2.nml").exists())
        page.press("show results", "button")
        page.wait("document.querySelector('.answers')?.innerText.includes('power loss of all bearings')")
        page.press("case", "[role=tab]")
        # A new one brings its bearings.
        page.press("new", "button")
        page.press("machine", ".template")
        page.press("replace it", "button")
        page.wait("document.querySelector('.cm-content').innerText.includes(\"'bearing.nml', 'bearing.nml'\")")
        page.wait("document.querySelector('.verdict').innerText.includes('in order')")
        self.assertIn("clearance = ", (self.folder/"bearing.nml").read_text(encoding="utf-8"))
        self.assert_quiet(page)

    def test_results_open_on_the_last_run_and_two_are_compared(self):
        page = self.open("small.nml")
        for number in (1, 2):
            if number == 2:
                page.press("case", "[role=tab]")
                page.type("[data-key='bearing%clearance']", "25 um")
                page.wait("document.querySelector('.cm-content').innerText.includes('2.5e-05')")
            page.press("run", "button")
            page.wait(f"Array.from(document.querySelectorAll('.state')).filter((one) => one.innerText.includes('has an answer')).length === {number}")
            page.press("results", "[role=tab]")
            page.wait(f"document.querySelectorAll('.answers').length === {number}")
        rows = "Array.from(document.querySelectorAll('.differences tbody tr')).map((one) => Array.from(one.cells).map((cell) => cell.innerText))"
        page.wait(f"{rows}.length > 5")
        [row] = [row for row in page.run(rows) if row[0] == "minimum_gap [um]"]
        gaps = [1.0e6*float(re.search(r"minimum_gap = (\S+)", (self.folder/f"small.run{number}/small.summary").read_text(encoding="utf-8"))[1]) for number in (1, 2)]
        for shown, value in zip(row[1:5], (*gaps, gaps[1] - gaps[0], 100.0*(gaps[1]/gaps[0] - 1.0))):
            self.assertAlmostEqual(float(shown), value, delta=1.0e-3*abs(value))
        page.wait("document.querySelectorAll('.js-plotly-plot canvas').length >= 2")
        page.resize(400, 900)
        page.wait("document.documentElement.scrollWidth <= 400")
        with contextlib.suppress(AssertionError):
            wait(lambda: not self.clipped(page), 30)  # pictures take their new size
        self.assertEqual(self.clipped(page), [])
        self.assert_quiet(page)

    def test_a_run_is_stopped_and_goes_with_a_killed_server(self):
        (self.folder/"long.nml").write_text(LONG, encoding="utf-8")
        page = self.open("long.nml")
        page.press("run", "button")
        page.wait("document.querySelector('.state')?.innerText.includes('runs')")
        page.press("stop", "button")
        page.wait("document.querySelector('.state').innerText.includes('was stopped')")
        self.assert_quiet(page)
        page.press("case", "[role=tab]")
        page.press("run", "button")
        children = pathlib.Path(f"/proc/{self.server.pid}/task/{self.server.pid}/children")
        number = wait(lambda: [int(one) for one in children.read_text(encoding="utf-8").split()
                               if pathlib.Path(f"/proc/{one}/comm").read_text(encoding="utf-8").strip() == "gfb"])[0]
        self.server.kill()
        wait(lambda: not is_alive(number), 10)

    def test_a_hostile_title_is_a_title(self):
        page = self.open("small.nml")
        page.wait(f"document.querySelector(\"[data-key='scene%title']\").value.startsWith({HOSTILE[:20]!r})")
        page.press("run", "button")
        page.press("show results", "button")
        page.wait("document.querySelectorAll('.answers').length === 1")
        self.assertIn(HOSTILE, page.run("document.body.innerText"))
        # Messages, too, have the words of the file.
        page.press("case", "[role=tab]")
        page.type(".cm-content", SMALL.replace("&model foil = 'rigid'", "&model foil = '<img src=x onerror=alert(1)>'"))
        page.wait("document.querySelector('.said').innerText.includes('<img src=x')")
        self.assertEqual(page.run("document.querySelectorAll('img[src=x]').length"), 0)
        self.assert_quiet(page)

    def test_what_is_outside_is_not_opened(self):
        for name in ("../secret.nml", "link.nml", str(self.outside/"secret.nml")):
            page = self.open(name.replace("/", "%2F"))
            page.wait("/outside the chosen folder|a link, which is not followed/.test(document.body.innerText)")
            self.assertNotIn("secret words", page.run("document.documentElement.outerHTML"))

    def test_two_tabs(self):
        first, second = self.open("small.nml"), self.open("small.nml")
        first.type("[data-key='bearing%clearance']", "25 um")
        first.wait("document.querySelector('.cm-content').innerText.includes('2.5e-05')")
        self.assertNotIn("2.5e-05", self.text(second))
        self.assertEqual(second.run("document.querySelector(\"[data-key='bearing%clearance']\").value"), "20 um")
        first.press("save", "button")
        first.wait("document.body.innerText.includes('is written')")
        second.type("[data-key='bearing%clearance']", "30 um")
        second.wait("document.querySelector('.cm-content').innerText.includes('3e-05')")
        second.press("save", "button")
        second.wait("document.body.innerText.includes('with other contents')")
        self.assertIn("2.5e-05", (self.folder/"small.nml").read_text(encoding="utf-8"))
        for page in (first, second):
            page.press("run", "button")
        for page in (first, second):
            page.wait("Array.from(document.querySelectorAll('.state')).filter((one) => one.innerText.includes('has an answer')).length === 2")
        kept = sorted(re.search(r"clearance = (\S+)", path.read_text(encoding="utf-8"))[1] for path in self.folder.glob("small.run*/small.nml"))
        self.assertEqual(kept, ["2.5e-05", "3e-05"])
        # What was typed and not saved is there after the tab is loaded again.
        second.call("Page.navigate", url=self.address[0])
        second.wait("document.querySelector('.cm-content')?.innerText.includes('3e-05')")
        self.assert_quiet(first, second)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
