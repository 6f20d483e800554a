#!/usr/bin/env python3
"""Numbers of the tutorials are those of the program: their commands are run as they stand, then their tables and sentences compared, to the
last digit that is written."""

import csv
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
PROGRAM = pathlib.Path(os.environ["GFB"])
MANUAL = PROJECT/"docs/manual"
BLOCK = re.compile(r"(?<!-->\n)^```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# Every sweep leaves its table; pictures, pages, and what goes over time (half a minute) are left out.
BEGIN = """set -e
gfb() { case "$*" in --*) "$GFB" "$@";; *) "$GFB" --csv "$@";; esac; }
"""
MICRO = 1e6
PAGES = {"data_sheet": "", "first_sweep": "", "misaligned_shaft": "", "first_thrust_bearing": "", "three_pad_rotor": "transient"}
# page, first head of the table, its sweep, and column and factor of every row, or head, of it
TABLES = (
    ("first_sweep", "load [N]", "load30", {"load [N]": ("load", 1), "smallest film [um]": ("minimum_gap", MICRO)}),
    ("first_sweep", "clearance [um]", "clearance30", {"clearance [um]": ("key_value", MICRO), "smallest film [um]": ("minimum_gap", MICRO),
                                                     "friction torque [mN m]": ("friction_torque", 1e3)}),
    ("misaligned_shaft", "tilt about y [mrad]", "tilt30", {"tilt about y [mrad]": ("tilt_y", 1e3), "torque about y [mN m]": ("torque_y", 1e3),
                                                          "smallest film, at an end [um]": ("minimum_gap", MICRO)}),
    ("first_thrust_bearing", "ramp [um]", "ramps", {"ramp [um]": ("key_value", MICRO), "smallest film [um]": ("minimum_gap", MICRO),
                                                   "friction [N m]": ("friction_torque", 1)}),
    ("three_pad_rotor", "speed [rpm]", "onset30", {"speed [rpm]": ("speed_rpm", 1), "smallest film [um]": ("minimum_gap", MICRO), "critical mass [kg]": ("critical_mass", 1),
                                                  "growth [1/s]": ("growth_rate", 1), "damping ratio [%]": ("damping_ratio", 100)}),
)
# page, words with numbers in the place of #, and case, result and factor of each
SENTENCES = (
    ("data_sheet", "smallest film # um, # W", ("shaft30", "minimum_gap", MICRO), ("shaft30", "power_loss", 1)),
    ("data_sheet", "With shells (3 s) # um", ("shell30", "minimum_gap", MICRO)),
    ("data_sheet", "on an elastic foundation # um", ("springs30", "minimum_gap", MICRO)),
    ("data_sheet", "found in a second: # N", ("capacity30", "load_capacity", 1)),
    ("misaligned_shaft", "shaft floats under its load: # mrad", ("allowance30", "misalignment_allowance", 1e3)),
    ("first_thrust_bearing", "*power loss*, # W", ("pads", "power_loss", 1)),
    ("first_thrust_bearing", "It carries # N, 47 kPa at the speed of the tip; under 150 N it allows a tilt of # mrad", ("carries", "load_capacity", 1), ("tilts", "misalignment_allowance", 1e3)),
    ("three_pad_rotor", "**The onset is # rpm.**", ("onset30", "onset_speed_rpm", 1)),
)
CHANGES = ("onset30", "clearance30", "clearance20", "clearance16", "preload30", "between30", "beams30", "beams20")  # rows of a table


def number(words):
    """A written number, and half of its last digit."""
    return float(words.replace(",", "")), 0.5*10.0**-len(words.partition(".")[2])


def rows_of(page, head):
    """The cells of a table below its two first lines, and its heads."""
    text = (MANUAL/f"{page}.md").read_text(encoding="utf-8")
    lines = re.search(rf"^\| {re.escape(head)} \|.*\n(?:\|.*\n)+", text, re.MULTILINE)[0].splitlines()
    heads, _, *rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return heads, rows


class Tutorials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        for page, left_out in PAGES.items():
            (cls.folder/page).mkdir()
            for case in cls.folder.glob("data_sheet/shaft30.nml"):
                (cls.folder/page/case.name).write_text(case.read_text(encoding="utf-8"), encoding="utf-8")
            bodies = [body for body in BLOCK.findall((MANUAL/f"{page}.md").read_text(encoding="utf-8")) if not left_out or left_out not in body]
            lines = [line for line in "".join(bodies).replace("tools/run ", "gfb ").splitlines() if not line.startswith("tools/")]
            done = subprocess.run(["bash", "-c", BEGIN + "\n".join(lines)], cwd=cls.folder/page, env={**os.environ, "GFB": str(PROGRAM)},
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            if done.returncode != 0:
                raise AssertionError(f"{page}: {done.stdout[-3000:]}")

    def columns(self, page, case):
        """{name: values} of the table of a sweep."""
        with (self.folder/page/f"{case}.csv").open(encoding="utf-8", newline="") as file:
            heads, *rows = csv.reader(file)
        return {head.partition(" [")[0]: [row[n] for row in rows] for n, head in enumerate(heads)}

    def result(self, page, case, name):
        """A number of a summary."""
        return float(re.search(rf"^{name} = (\S+)", (self.folder/page/f"{case}.summary").read_text(encoding="utf-8"), re.MULTILINE)[1])

    def compare(self, words, value, where):
        """Whether a number is written as it is, rounded."""
        written, half = number(words)
        self.assertLessEqual(abs(written - float(value)), 1.001*half, f"{where}: {words} is written, {value} is computed")

    def test_tables(self):
        for page, first, case, meanings in TABLES:
            heads, rows = rows_of(page, first)
            written = {row[0]: row[1:] for row in [heads, *rows]} if set(meanings) - set(heads) else {head: [row[n] for row in rows] for n, head in enumerate(heads)}
            self.assertEqual(set(written), set(meanings), page)
            computed = self.columns(page, case)
            for label, (column, factor) in meanings.items():
                self.assertEqual(len(written[label]), len(computed[column]), f"{page}: {label}")
                for words, value in zip(written[label], computed[column]):
                    self.compare(words, factor*float(value), f"{page}: {label}")

    def test_sentences(self):
        for page, words, *meanings in SENTENCES:
            text = " ".join((MANUAL/f"{page}.md").read_text(encoding="utf-8").split())
            found = re.search(re.escape(words).replace(r"\#", r"([\d.,]*\d)"), text)
            self.assertIsNotNone(found, f"{page}: {words}")
            for written, (case, name, factor) in zip(found.groups(), meanings):
                self.compare(written, factor*self.result(page, case, name), f"{page}: {words}")

    def test_friction_and_thickness(self):
        """What both take off the film, from the first value of their sweeps to the last."""
        text = " ".join((MANUAL/"first_sweep.md").read_text(encoding="utf-8").split())
        found = re.search(r"Friction from 0 to 0\.3 takes ([\d.]+) um off the film of ([\d.]+) um, .* another ([\d.]+) um", text)
        friction, thickness = (list(map(float, self.columns("first_sweep", case)["minimum_gap"])) for case in ("friction30", "thickness30"))
        for written, value in zip(found.groups(), (friction[0] - friction[-1], friction[0], thickness[0] - thickness[-1])):
            self.compare(written, MICRO*value, "first_sweep")

    def test_changes_of_three_pads(self):
        _, rows = rows_of("three_pad_rotor", "change")
        self.assertEqual(len(rows), len(CHANGES))
        for (_, onset, film, friction), case in zip(rows, CHANGES):
            computed = self.columns("three_pad_rotor", case)
            at = list(map(float, computed["speed_rpm"])).index(20000.0)
            for words, value in ((onset, self.result("three_pad_rotor", case, "onset_speed_rpm")), (film, MICRO*float(computed["minimum_gap"][at])),
                                 (friction, 1e3*float(computed["friction_torque"][at]))):
                self.compare(words, value, f"three_pad_rotor: {case}")


if __name__ == "__main__":
    unittest.main()
