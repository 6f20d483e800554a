"""Tests of tools/compare on made-up results: one bit, one name and one status that differ are seen, and what is kept."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

TOOLS = pathlib.Path(os.environ["GFB_SOURCE"])/"tools"
sys.path.insert(0, str(TOOLS))

from gfb.compare import results as compare_results  # noqa: E402 (found only now)
from gfb.compare import runs as compare_runs  # noqa: E402

GAP = numpy.array([1.0, 2.0, 4.0])
SUMMARY = "converged = true\nforce_x = 3.0 [N]\nwall_time = 0.1 [s]\npeak_memory = 7.0 [B]\n"
# A program that answers with its own last line, counts its runs, and ends with a status.
PROGRAM = """#!/bin/sh
if [ "$1" = --version ]; then echo made up; exit 0; fi
echo run >>"$0.runs"
for case do :; done
echo "force_x = {force} [N]" >"${{case%.nml}}.summary"
exit {status}
"""


def results(folder, gap=GAP, summary=SUMMARY, date="today", **more):
    """The files of a run."""
    folder.mkdir()
    (folder/"case.summary").write_text(summary, encoding="utf-8")
    with h5py.File(folder/"case.h5", "w") as file:
        for name, values in {"history/gap": gap, "history/wall_time": numpy.random.rand(3), **more}.items():
            file[name] = values
        file["history/gap"].attrs["unit"] = "m"
        file["provenance/date"] = numpy.bytes_(date)
        file["summary/program"] = numpy.bytes_("gfb of " + date)
        file["provenance/ranks"] = 1.0


class Folder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)


class Results(Folder):
    """Two folders of results."""

    def found(self, **changes):
        """{where: difference} of two runs, of which the second is changed."""
        results(self.folder/"one")
        results(self.folder/"other", **changes)
        return self.differences()

    def differences(self):
        """The same of what is there."""
        found = compare_results.folder_differences(self.folder/"one", self.folder/"other")
        return {one.where: one for one in found}

    def test_equal(self):
        """Times, memory, dates and which program it was are left out."""
        self.assertEqual(self.found(date="tomorrow", summary=SUMMARY.replace("0.1", "0.2").replace("7.0", "8.0")), {})

    def test_one_bit(self):
        gap = GAP.copy()
        gap.view(numpy.uint64)[1] ^= numpy.uint64(1)
        found = self.found(gap=gap)
        self.assertEqual(list(found), ["case.h5:history/gap"])
        self.assertEqual(found["case.h5:history/gap"].words, "1 of 3 differ, by 1.1e-16")

    def test_sign_of_zero(self):
        words, relative = compare_results.value_difference(numpy.array([0.0]), numpy.array([-0.0]))
        self.assertEqual((words, relative), ("1 of 1 differ, by 0.0e+00", 0.0))

    def test_no_number(self):
        self.assertEqual(self.found(gap=numpy.array([1.0, numpy.nan, 4.0]))["case.h5:history/gap"].words,
                         "1 of 3 differ, by inf")
        self.assertEqual(compare_results.value_difference(numpy.array([numpy.nan]), numpy.array([numpy.nan]))[0], "")

    def test_type_and_shape(self):
        self.assertIn("type", self.found(gap=GAP.astype(numpy.float32))["case.h5:history/gap"].words)
        self.assertIn("shape", compare_results.value_difference(GAP, GAP[:2])[0])

    def test_names(self):
        results(self.folder/"one", lift=1.0)
        results(self.folder/"other", summary="force_x = 3.0 [N]\n")
        (self.folder/"other/case.used.nml").write_text("&scene\n/\n", encoding="utf-8")
        self.assertEqual({where: one.words for where, one in self.differences().items()},
                         {"case.h5:lift": "name only before", "case.summary:converged": "name only before",
                          "case.used.nml": "file only after"})

    def test_attribute(self):
        results(self.folder/"one")
        results(self.folder/"other")
        with h5py.File(self.folder/"other/case.h5", "r+") as file:
            file["history/gap"].attrs["unit"] = "mm"
        self.assertEqual(list(self.differences()), ["case.h5:history/gap@unit"])

    def test_summary(self):
        found = self.found(summary=SUMMARY.replace("3.0", "3.3").replace("true", "false"))
        self.assertEqual(found["case.summary:force_x"].words, "3.0 [N] before, 3.3 [N] after")
        self.assertAlmostEqual(found["case.summary:force_x"].relative, 0.3/3.3)
        self.assertIn("case.summary:converged", found)

    def test_keys_used(self):
        results(self.folder/"one")
        results(self.folder/"other")
        for name, value in (("one", "1"), ("other", "2")):
            (self.folder/name/"case.used.nml").write_text(f"&mesh\n  bumps = {value}\n/\n", encoding="utf-8")
        self.assertIn("'bumps = 1' before, 'bumps = 2' after", self.differences()["case.used.nml"].words)


class Tool(Folder):
    """The tool on programs that are made up."""

    def program(self, name, force=3.0, status=0):
        """A program that answers with a force."""
        path = self.folder/name
        path.write_text(PROGRAM.format(force=force, status=status), encoding="utf-8")
        path.chmod(0o755)
        return str(path)

    def compare(self, before, after, only="^rigid_slit$"):
        """Exit status and words of the tool."""
        done = subprocess.run([sys.executable, str(TOOLS/"compare"), before, after, "--small", "--only", only, "--store",
                               str(self.folder/"store")], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_equal_and_kept(self):
        before, after = self.program("before"), self.program("after")
        for _ in range(2):
            status, said = self.compare(before, after)
            self.assertEqual(status, 0, said)
            self.assertIn("1 scenes: 1 equal", said)
        self.assertEqual(pathlib.Path(before + ".runs").read_text().count("run"), 1)
        self.assertEqual(pathlib.Path(after + ".runs").read_text().count("run"), 2)

    def test_different(self):
        status, said = self.compare(self.program("before"), self.program("after", force=4.0, status=2))
        self.assertEqual(status, 1, said)
        self.assertIn("exit status 0 before, 2 after", said)
        self.assertIn("rigid_slit.summary:force_x: 3.0 [N] before, 4.0 [N] after", said)

    def test_refused(self):
        """Two programs that refuse a scene alike have shown nothing."""
        status, said = self.compare(self.program("before", status=1), self.program("after", status=1))
        self.assertEqual(status, 1, said)
        self.assertIn("refused by both", said)

    def test_failed(self):
        status, said = self.compare(self.program("before", status=3), self.program("after", status=3))
        self.assertEqual(status, 3, said)
        self.assertFalse(list((self.folder/"store").glob("*/*")))  # what failed is not kept

    def test_wrong_call(self):
        self.assertEqual(self.compare("no/such/revision", self.program("after"))[0], 1)
        self.assertEqual(self.compare(self.program("before"), self.program("after"), only="no such scene")[0], 1)


class Scenes(unittest.TestCase):
    """The list."""

    def test_names(self):
        names = [task.name for task in compare_runs.tasks(small=True)]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(names, [task.name for task in compare_runs.tasks(small=False)])

    def test_options(self):
        tasks = compare_runs.tasks(small=True)
        self.assertTrue(any("--branches" in task.options for task in tasks))
        self.assertTrue(any(task.restart for task in tasks))


if __name__ == "__main__":
    unittest.main()
