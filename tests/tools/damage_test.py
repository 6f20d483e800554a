"""Tests of every tool that reads what an earlier call has left: damaged, cut, foreign and older files end in one sentence.

Files are gfb's own, of a bearing on beams that is swept.
"""

import contextlib
import io
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(PROJECT/"tools"))

from gfb.compare.results import file_differences, folder_differences  # noqa: E402 (found only now)
from gfb.gallery import main as gallery_main  # noqa: E402
from gfb.gallery.runs import Result  # noqa: E402
from gfb.plot import main as plot_main  # noqa: E402
from gfb.results import SEAL_LENGTH, Unreadable, read_film, read_history, read_summary  # noqa: E402

FLIPS, CUTS = 200, 20
CASE = """&scene analysis = 'fixed_position' /
&bearing radius = 19.05e-3 length = 38.1e-3 clearance = 31.8e-6 /
&gas viscosity = 1.95e-5 ambient_pressure = 1.0135e5 /
&operation speed_rpm = 30000.0 eccentricity = 20.0e-6, 8.0e-6 /
&sweep parameter = 'speed_rpm' values = 20000.0, 30000.0 /
&top_foil thickness = 0.102e-3 youngs_modulus = 214.0e9 poissons_ratio = 0.29 /
&bump_foil thickness = 0.102e-3 youngs_modulus = 214.0e9 poissons_ratio = 0.29 half_length = 1.778e-3
  height = 0.508e-3 pitch = 4.572e-3 bumps = 26 /
&contact friction_top = 0.1 friction_sleeve = 0.1 /
&model foil = 'beam' /
&mesh circumferential_elements = 104 axial_elements = 4 arc_elements = 4 flat_elements = 1 /
"""
PLOTS = {"case.h5": ((), ("--list",), ("--show", "contact")), "case.film.vtkhdf": ((), ("--list",)),
         "case.top_foil.vtkhdf": ((), ("--list",)), "case.bump_foil.vtkhdf": ((), ("--list",))}


def plot(*words):
    """Status and words of tools/plot, in this process."""
    said = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said), \
            unittest.mock.patch("sys.argv", ["tools/plot", *map(str, words)]):
        try:
            status = plot_main.main()
        except SystemExit as end:
            status = end.code
    plot_main.pyplot.close("all")
    return status, said.getvalue()


class DamageTest(unittest.TestCase):
    """One run, whose files each test spoils in a folder of its own."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        case = pathlib.Path(folder.name)/"case.nml"
        case.write_text(CASE, encoding="utf-8")
        subprocess.run([os.environ["GFB"], "--output", folder.name, case], check=True, stdout=subprocess.DEVNULL)
        cls.files = {path.name: path.read_bytes() for path in pathlib.Path(folder.name).iterdir()}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.put(self.folder)

    def put(self, folder):
        folder.mkdir(exist_ok=True)
        for name, content in self.files.items():
            (folder/name).write_bytes(content)
        return folder

    def assert_told(self, path, words=(), where=""):
        """tools/plot refuses a file in one sentence that names it."""
        status, said = plot(path, *words, "--output", self.folder/"p.png")
        self.assertEqual((status, said.count("\n"), str(path) in said), (1, 1, True), f"{path.name} {words} {where}: {said}")

    def test_files_are_read_before_they_are_spoiled(self):
        for name, calls in PLOTS.items():
            for words in calls:
                if (name, words) != ("case.film.vtkhdf", ("--list",)):
                    self.assertEqual(plot(self.folder/name, *words, "--output", self.folder/"p.png"), (0, ""), f"{name} {words}")

    def test_each_flipped_bit_is_seen(self):
        chance = random.Random(1)
        for name in PLOTS:
            whole, path = self.files[name], self.folder/name
            bits = [chance.randrange(8*len(whole)) for _ in range(FLIPS)]
            bits += range(8*(len(whole) - SEAL_LENGTH), 8*len(whole))
            for bit in bits:
                spoiled = bytearray(whole)
                spoiled[bit//8] ^= 1 << bit % 8
                path.write_bytes(spoiled)
                self.assert_told(path, where=f"bit {bit}")

    def test_cut_files(self):
        for name, calls in PLOTS.items():
            whole, path = self.files[name], self.folder/name
            body = len(whole) - SEAL_LENGTH
            # Less of the checksum than its first word is as good as none: then all contents are there.
            for length in [*range(0, body, body//CUTS), *range(body + 10, len(whole))]:
                path.write_bytes(whole[:length])
                for words in calls:
                    self.assert_told(path, words, f"cut at {length}")

    def test_foreign_files(self):
        path = self.folder/"case.h5"
        for content in (b"", b"no HDF5 at all\n", b"\x89PNG\r\n\x1a\n" + bytes(1000), self.files["case.summary"]):
            path.write_bytes(content)
            for words in PLOTS["case.h5"]:
                self.assert_told(path, words)
        with h5py.File(path, "w") as file:
            file["of/another"] = [1.0, 2.0]
        for words in (*PLOTS["case.h5"], ("minimum_gap",), ("--step", "1")):
            self.assert_told(path, words)
        for kind in ("film", "top_foil", "bump_foil"):
            foreign = self.folder/f"case.{kind}.vtkhdf"
            with h5py.File(foreign, "w") as file:
                file["VTKHDF/Points"] = [[0.0, 0.0, 0.0]]
            self.assert_told(foreign)
        self.assert_told(self.folder)

    def test_older_files(self):
        path = self.folder/"case.h5"
        path.write_bytes(self.files["case.h5"][:-SEAL_LENGTH])
        self.assertEqual(plot(path, "--output", self.folder/"p.png"), (0, ""))  # one without checksum
        for missing in ("history", "history/minimum_gap", "scene/used"):
            path.write_bytes(self.files["case.h5"][:-SEAL_LENGTH])
            with h5py.File(path, "r+") as file:
                del file[missing]
            self.assert_told(path, ("minimum_gap",), missing)
        path.write_bytes(self.files["case.h5"][:-SEAL_LENGTH])
        with h5py.File(path, "r+") as file:
            for data in file["history"].values():
                del data.attrs["unit"]
        for words in ((), ("--list",)):
            self.assert_told(path, words, "without units")

    def spoil_all(self, folder):
        """Every file of a run, each in another way."""
        for index, path in enumerate(sorted(folder.glob("case.*"))):
            content = bytearray(path.read_bytes())
            content[len(content)//2] = 0xff
            path.write_bytes((content, content[:len(content)//3])[index % 2 if path.suffix in (".h5", ".vtkhdf") else 0])

    def test_comparison(self):
        other = self.put(self.folder/"other")
        self.assertEqual(folder_differences(self.put(self.folder/"one"), other), [])
        self.spoil_all(other)
        found = {one.where: one.words for one in folder_differences(self.folder/"one", other)}
        self.assertEqual(len(found), len(self.files), found)
        for name in PLOTS:
            self.assertIn("cannot be read", found[name])
        self.assertIn("cannot be read", found["case.summary"])
        (other/"case.summary").write_text("no equals sign\n", encoding="utf-8")
        self.assertTrue(file_differences(self.folder/"case.summary", other/"case.summary", "case.summary"))

    def test_readers_of_the_tools(self):
        kept = Result("case", {}, self.folder/"case", 0, "")
        self.assertEqual(len(kept.history["minimum_gap"]), 2)
        self.spoil_all(self.folder)
        kept = Result("case", {}, self.folder/"case", 0, "")
        for read in (lambda: kept.summary, lambda: kept.history, lambda: kept.film, lambda: kept.used, lambda: kept.provenance,
                     kept.open, kept.draw_film, lambda: read_summary(self.folder/"case.summary"),
                     lambda: read_history(self.folder/"case.h5"), lambda: read_film(self.folder/"case.film.vtkhdf")):
            with self.assertRaises(Unreadable) as told:
                read()
            self.assertNotIn("\n", str(told.exception))

    def test_gallery_of_spoiled_runs(self):
        def page(runs, folder):
            text = (PROJECT/"inputs/rigid_slit.nml").read_text(encoding="utf-8")
            place = runs.folder/"rigid_slit"
            place.mkdir(parents=True, exist_ok=True)
            for name, content in self.files.items():
                (place/name.replace("case", "rigid_slit")).write_bytes(content[:len(content)//2])
            (place/"rigid_slit.nml").write_text(text, encoding="utf-8")
            (place/"run.json").write_text(json.dumps({"status": 0, "said": "", "program": runs.program}), encoding="utf-8")
            return runs.run("rigid_slit").history

        said = io.StringIO()
        words = ["tools/gallery", "--reuse", "--only", "fig9", "--gfb", os.environ["GFB"], "--runs", self.folder/"runs",
                 "--output", self.folder/"pages"]
        with unittest.mock.patch.dict(gallery_main.PAGES, fig9=page), unittest.mock.patch("sys.argv", list(map(str, words))), \
                contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()), self.assertRaises(SystemExit) as end:
            gallery_main.main()
        self.assertEqual((end.exception.code, said.getvalue().count("\n")), (1, 1), said.getvalue())


if __name__ == "__main__":
    unittest.main()
