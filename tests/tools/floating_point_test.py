"""Tests of tools/check_floating_point on made-up answers and reports: what differs is seen, and whose loss it is."""

import math
import os
import pathlib
import sys
import unittest
import xml.etree.ElementTree

SOURCE = pathlib.Path(os.environ["GFB_SOURCE"])
sys.path[:0] = [str(SOURCE/"tests"/name) for name in ("floating_point", "verification")]

import memory  # noqa: E402 (found only now)
import same_answer  # noqa: E402
import scenes  # noqa: E402
from gfb_run import Result  # noqa: E402

BEARING = "&bearing\n  radius = 0.02\n  length = 0.04\n  clearance = 2e-5\n/\n&gas\n  ambient_pressure = 1e5\n/\n"
SUMMARY = {"converged": "true", "force_x": 3.0, "friction_torque": 2.0, "newton_iterations": 7.0}


class Made(Result):
    """An answer without files."""

    def __init__(self, rows=None, **changes):
        super().__init__(0, "", "", pathlib.Path(), SUMMARY | changes, {})
        self.rows = rows or {}

    def history(self):
        return self.rows


def between(one, other, text=BEARING):
    """The difference of two answers."""
    return same_answer.difference(one, other, text)


class Differences(unittest.TestCase):
    """Numbers, words and columns of two answers."""

    def test_same(self):
        found = between(Made(), Made(newton_iterations=9.0))
        self.assertEqual(found.largest[0], 0.0)
        self.assertTrue(found.alike)

    def test_number(self):
        found = between(Made(), Made(friction_torque=2.5))
        self.assertEqual(found.largest, (0.2, "friction_torque"))

    def test_number_that_may_vanish(self):
        """A force is compared with p_a L D."""
        found = between(Made(), Made(force_x=3.0 + 160.0e-6))
        self.assertAlmostEqual(found.largest[0], 1.0e-6, delta=1.0e-12)

    def test_nan_equals_nothing(self):
        for one, other in ((SUMMARY["force_x"], math.nan), (math.nan, math.nan)):
            self.assertEqual(between(Made(force_x=one), Made(force_x=other)).largest[0], math.inf)

    def test_nan_of_rows(self):
        """A row without a number is one in both histories."""
        full, lacking = {"pressure": [1.0, 2.0]}, {"pressure": [1.0, math.nan]}
        self.assertEqual(between(Made(lacking), Made(lacking)).largest[0], 0.0)
        self.assertEqual(between(Made(full), Made(lacking)).largest[0], math.inf)

    def test_rows(self):
        self.assertEqual(between(Made({"gap": [1.0, 2.0]}), Made({"gap": [1.5, 2.0]})).largest, (0.25, "gap"))
        self.assertEqual(between(Made({"gap": [1.0, 2.0]}), Made({"gap": [1.0]})).largest[0], math.inf)
        self.assertFalse(between(Made({"gap": [1.0]}), Made({"lift": [1.0]})).alike)

    def test_words_and_names(self):
        self.assertFalse(between(Made(), Made(converged="false")).alike)
        self.assertEqual(between(Made(), Made(more=1.0)).largest[0], math.inf)


def error(kind, *frames):
    """One of valgrind's errors; frames: (object, function) from the inside out."""
    stack = "".join(f"<frame><obj>{obj}</obj><fn>{fn}</fn></frame>" for obj, fn in frames)
    return f"<error><kind>{kind}</kind><what>words</what><stack>{stack}</stack></error>"


def seen(*errors):
    """What is read from a report."""
    look = memory.Look(None)
    memory.read_report(look, xml.etree.ElementTree.fromstring(f"<valgrindoutput>{''.join(errors)}</valgrindoutput>"))
    return look


class Reports(unittest.TestCase):
    """Valgrind's reports."""

    MALLOC = ("/usr/libexec/valgrind/vgpreload_memcheck-amd64-linux.so", "malloc")

    def test_clean(self):
        self.assertEqual(seen().wrong, [])

    def test_own_loss(self):
        look = seen(error("Leak_DefinitelyLost", self.MALLOC, ("/build/gfb", "answer_quantities")))
        self.assertEqual((len(look.lost), len(look.errors), look.others), (1, 0, 0))

    def test_loss_of_a_library(self):
        look = seen(error("Leak_DefinitelyLost", self.MALLOC, ("/lib/libmpi.so", "init"), ("/build/gfb", "main")))
        self.assertEqual((look.wrong, look.others), ([], 1))

    def test_error_in_a_library(self):
        """gfb may have given it what is not set."""
        look = seen(error("UninitCondition", ("/lib/libdmumps.so", "dmumps_"), ("/build/gfb", "solve")))
        self.assertEqual(len(look.errors), 1)

    def test_one_place(self):
        wrong = error("InvalidRead", *(("/build/gfb", name) for name in "abcde"))
        again = error("InvalidRead", *(("/build/gfb", name) for name in "abcdf"))
        self.assertEqual(len(seen(wrong, again).errors), 1)


class Scenes(unittest.TestCase):
    """The list."""

    def test_names_of_files(self):
        names = [scene.name for scene in scenes.SCENES]
        self.assertEqual(len(set(names)), len(names))

    def test_suppressions_name_libraries(self):
        text = (SOURCE/"tests/floating_point/libraries.supp").read_text(encoding="utf-8")
        entries = [line.strip() for line in text.splitlines() if line.strip() and not line.startswith("#")]
        self.assertFalse([line for line in entries if "gfb" in line.split(":", 1)[-1] and line.startswith(("fun:", "obj:"))])


if __name__ == "__main__":
    unittest.main()
