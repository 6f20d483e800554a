"""Tests of what every tool must do: help without Python packages, and one sentence, no traceback, on files that are not right.

Files are gfb's own: a rotor on beams that is swept, a strip, and modes.
"""

import contextlib
import io
import json
import os
import pathlib
import random
import re
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

from damage_test import CASE  # noqa: E402 (found only now)
from gfb import coefficients, manual  # noqa: E402
from gfb.bench.runs import kept_rows  # noqa: E402
from gfb.gallery import strip as gallery_strip  # noqa: E402
from gfb.key_tables import key_tables  # noqa: E402
from gfb.plot import main as plot_main  # noqa: E402
from gfb.results import SEAL_LENGTH, Unreadable, read_json  # noqa: E402
from gfb.tool import run  # noqa: E402
from slow import slow  # noqa: E402

OF_PYTHON = ("bench", "coefficients", "compare", "design", "gallery", "manual", "models", "plot", "report")
OTHERS = ("check", "check_floating_point", "check_petsc", "check_systems", "mutants", "package", "run", "structure", "studio", "test")
VARIANTS = 8  # of each file, for each call
ROTOR = CASE.replace("'fixed_position'", "'linear_dynamics'") + """&dynamics frequency_ratios = 0.2, 0.4, 0.6, 0.8, 1.0 /
&rotor mass = 1.0 /
"""
STRIP = """&scene analysis = 'strip' /
&bump_foil thickness = 0.127e-3 youngs_modulus = 207.0e9 poissons_ratio = 0.3 half_length = 3.3e-3
  height = 0.9e-3 pitch = 7.0e-3 bumps = 2 width = 18.0e-3 /
&contact friction_top = 0.2 friction_sleeve = 0.2 /
&strip_load kind = 'plates' maximum_force = 50.0 steps_up = 2 steps_down = 2 /
&mesh arc_elements = 4 flat_elements = 1 axial_elements = 4 /
"""
MODES = """&scene analysis = 'modes' /
&bump_foil thickness = 0.127e-3 youngs_modulus = 207.0e9 poissons_ratio = 0.3 density = 8280.0 half_length = 3.3e-3
  height = 0.9e-3 pitch = 7.0e-3 bumps = 1 width = 18.0e-3 /
&mesh arc_elements = 4 flat_elements = 1 axial_elements = 4 /
"""
CASES = {"rotor": ROTOR, "strip": STRIP, "modes": MODES}
CALLS = (  # tool, file, further words
    (plot_main.main, "rotor.h5", ()), (plot_main.main, "rotor.h5", ("--list",)),
    (plot_main.main, "rotor.h5", ("minimum_gap", "--together")), (plot_main.main, "rotor.h5", ("--show", "dynamics")),
    (plot_main.main, "rotor.h5", ("--show", "campbell")), (plot_main.main, "rotor.h5", ("--show", "contact", "--step", "2")),
    (plot_main.main, "rotor.film.vtkhdf", ()), (plot_main.main, "rotor.film.vtkhdf", ("--show", "polar")),
    (plot_main.main, "rotor.top_foil.vtkhdf", ()),
    (plot_main.main, "rotor.film.steps.vtkhdf", ("--step", "1")),
    (plot_main.main, "rotor.bump_foil.vtkhdf", ()), (plot_main.main, "strip.h5", ("--show", "loop")),
    (plot_main.main, "strip.h5", ("--show", "bumps")), (plot_main.main, "strip.h5", ("--show", "contact")),
    (plot_main.main, "modes.bump_foil.vtkhdf", ("mode_1",)),
    (coefficients.main, "rotor.h5", ("--point", "2", "--ross", "a.toml", "--xltrc", "a.txt", "--state-space", "a.npz", "--accept-deviation")),
)


def call(main, *words):
    """Status and words of a tool, in this process; pictures are drawn but not made into files."""
    said = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said), \
            unittest.mock.patch("sys.argv", ["tool", *map(str, words)]), unittest.mock.patch("matplotlib.figure.Figure.savefig"):
        try:
            status = run(main)
        except SystemExit as end:
            status = end.code
    plot_main.pyplot.close("all")
    return status, said.getvalue()


def command(tool, *words, packages=True):
    """The same of a tool as a user calls it; without packages: of a Python that has none, and knows no other."""
    environment = dict(os.environ)
    python = [sys.executable]
    if not packages:
        python += ["-S"]
        environment["GFB_TOOLS_PYTHON"] = f"{PROJECT}/build/venv/bin/python:/usr/bin/python3"
    first = (PROJECT/"tools"/tool).read_text(encoding="utf-8").splitlines()[0]
    done = subprocess.run([*(python if "python" in first else []), PROJECT/"tools"/tool, *map(str, words)], check=False, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment)
    return done.returncode, done.stdout


class Help(unittest.TestCase):
    """What a tool says of itself, wherever it is."""

    def test_every_tool_is_tested(self):
        there = {path.name for path in (PROJECT/"tools").iterdir() if path.is_file() and not path.suffix and os.access(path, os.X_OK)}
        self.assertEqual(there - set(OF_PYTHON) - set(OTHERS), set())

    def test_help_without_packages(self):
        for tool in OF_PYTHON:
            status, said = command(tool, "--help", packages=False)
            self.assertEqual((status, f"usage: tools/{tool}" in said), (0, True), said)
            self.assertEqual(said, command(tool, "--help")[1])
        for name in ("accuracy", "work-precision", "scaling"):
            status, said = command("bench", name, "-h", packages=False)
            self.assertEqual((status, f"usage: tools/bench {name}" in said), (0, True), said)

    def test_anything_else_names_the_packages_of_debian(self):
        for tool in OF_PYTHON:
            status, said = command(tool, "a", packages=False)
            self.assertEqual((status, said.count("\n")), (1, 2), said)
            self.assertIn("apt-get install python3-numpy python3-h5py python3-matplotlib", said)

    def test_other_tools(self):
        for tool in OTHERS:
            status, said = command(tool, "--help", packages=False)
            self.assertEqual((status, f"tools/{tool}" in said or f"usage: {tool}" in said), (0, True), said)


class Files(unittest.TestCase):
    """Runs of three cases, whose files each test spoils in a folder of its own."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        for name, text in CASES.items():
            case = pathlib.Path(folder.name)/f"{name}.nml"
            case.write_text(text, encoding="utf-8")
            subprocess.run([os.environ["GFB"], "--quiet", "--output", folder.name, case], check=True, stdout=subprocess.DEVNULL)
        cls.files = {path.name: path.read_bytes() for path in pathlib.Path(folder.name).iterdir()}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.enterContext(contextlib.chdir(folder.name))

    def assert_told(self, main, path, words, where):
        """One sentence that names the file, and status 1."""
        status, said = call(main, path, *words)
        self.assertEqual((status, said.count("\n"), str(path) in said), (1, 1, True), f"{path} {words} {where}: {said}")

    def test_whole_files(self):
        for main, name, words in CALLS:
            path = self.folder/name
            path.write_bytes(self.files[name])
            status, said = call(main, path, *words)
            self.assertEqual(status, 0, f"{name} {words}: {said}")

    def test_missing_damaged_cut_and_foreign_files(self):
        with h5py.File(self.folder/"foreign.h5", "w") as file:
            file["of/another"] = [1.0]
        foreign = (self.folder/"foreign.h5").read_bytes()
        for main, name, words in CALLS:
            path, whole = self.folder/name, self.files[name]
            path.unlink(missing_ok=True)
            self.assert_told(main, path, words, "missing")
            flipped = bytearray(whole)
            flipped[len(whole)//2] ^= 1
            for where, content in (("damaged", flipped), ("cut", whole[:len(whole)//2]), ("empty", b""), ("text", b"no HDF5\n"),
                                   ("of another program", foreign)):
                path.write_bytes(content)
                self.assert_told(main, path, words, where)

    @slow
    def test_slow_older_and_newer_files(self):
        """Without checksum, and each with one thing that is missing, or of another shape or kind."""
        chance, answered, told = random.Random(1), 0, 0
        for main, name, words in CALLS:
            path, whole = self.folder/name, self.files[name][:-SEAL_LENGTH]
            path.write_bytes(whole)
            with h5py.File(path, "r") as file:
                names = []
                file.visit(names.append)
            for index in range(VARIANTS):
                spoiled, way = chance.choice(names), index % 4
                path.write_bytes(whole)
                with h5py.File(path, "r+") as file:
                    is_group = isinstance(file[spoiled], h5py.Group)
                    about = dict(file[spoiled].attrs)
                    del file[spoiled]
                    if way == 1:
                        file[spoiled] = 1.0
                    elif way == 2:
                        file[spoiled] = numpy.arange(7.0)
                    elif way == 3 and not is_group:
                        file.create_group(spoiled)
                    if way and spoiled in file:
                        file[spoiled].attrs.update(about)
                status, said = call(main, path, *words)
                self.assertIn(status, (0, 1), f"{name} {words} {spoiled} {way}: {said}")
                if status:
                    self.assertEqual((said.count("\n"), name in said), (1, True), f"{name} {words} {spoiled} {way}: {said}")
                answered, told = answered + (status == 0), told + (status == 1)
        self.assertGreater(told, 20)
        self.assertGreater(answered, 40)  # what a picture does not need may change

    def test_what_tools_have_kept(self):
        path = self.folder/"kept.json"
        for content in ("", "{", "[1]", "{}", "\xff"):
            path.write_text(content, encoding="latin-1")
            with self.assertRaises(Unreadable):
                kept_rows(path, "program")
            with self.assertRaises(Unreadable):
                read_json(path, "scenes")
        path.write_text(json.dumps({"program": "a", "rows": {"b": 1}}), encoding="utf-8")
        self.assertEqual(kept_rows(path, "a"), {"b": 1})
        path.rename(self.folder/"section41_times.json").write_text("{", encoding="utf-8")
        with self.assertRaises(Unreadable):
            gallery_strip.timed(unittest.mock.Mock(folder=self.folder, reuse=True))

    def test_every_group_of_a_result_file_stands_in_the_manual(self):
        page = (PROJECT/"docs/manual/results.md").read_text(encoding="utf-8")
        there = set()
        for name in CASES:
            with h5py.File(io.BytesIO(self.files[f"{name}.h5"]), "r") as file:
                there.update(file)
        self.assertLessEqual({"scene", "summary", "dynamics", "contact"}, there)
        self.assertEqual([name for name in sorted(there) if f"| `/{name}` |" not in page], [])

    def test_keys_as_a_table_a_group(self):
        """Every key is there once, with all that the program says of it; a group of no purpose is noticed."""
        printed = subprocess.run([os.environ["GFB"], "--keys"], capture_output=True, text=True, check=True).stdout
        made = key_tables(printed)
        for name, part in re.findall(r"^## &(\w+)\n(.*?)(?=^## |\Z)", made, re.MULTILINE | re.DOTALL):
            rows = re.findall(rf"^\| `&{name}` \| (`\w+`) \| (.*?) \| (.*?) \| (.*?) \| (.*) \|$", printed, re.MULTILINE)
            self.assertEqual([row[0] for row in rows], re.findall(r"^\| (`\w+`) \|", part, re.MULTILINE))
            for (key, kind, unit, default, meaning), line in zip(rows, re.findall(r"^\| `.*$", part, re.MULTILINE)):
                said = [unit if unit not in ("", "1") else "", meaning, default.partition(" ")[2] or default, re.sub(r"^[^`']*", "", kind)]
                self.assertEqual([words for words in said if words not in line], [], key)
        self.assertEqual(len(re.findall(r"^\| `&", printed, re.MULTILINE)), len(re.findall(r"^\| `", made, re.MULTILINE)))
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
            key_tables(printed.strip() + "\n| `&novel` | `a` | real | m | none | b |\n")

    def test_pages_programs_and_sources(self):
        page = self.folder/"keys.md"
        for gfb, text, status, words in ((os.environ["GFB"], None, 3, "No such file"), (os.environ["GFB"], "no place", 1, "no lines"),
                                         ("/bin/true", "a", 1, "is it gfb?"), ("/none", "a", 1, "no such program")):
            page.unlink(missing_ok=True)
            if text is not None:
                page.write_text(text, encoding="utf-8")
            found, said = call(manual.main, "--folder", self.folder, "--gfb", gfb)
            self.assertEqual((found, said.count("\n"), words in said), (status, 1, True), said)
        (self.folder/"a.f90").write_bytes(b"module a \xff\n")
        for folder, words in (("none", "no Fortran files"), (".", "cannot be read")):
            status, said = command("structure", "--sources", folder)
            self.assertEqual((status, said.count("\n"), words in said), (1, 1, True), said)
        (self.folder/"text").write_text("no program\n", encoding="utf-8")
        (self.folder/"text").chmod(0o755)
        for words in (("compare", "none", os.environ["GFB"]), ("compare", "text", os.environ["GFB"], "--only", "rigid_slit"),
                      ("bench", "film", "--gfb", "none"), ("gallery", "--gfb", "none"), ("gallery", "--only", "none", "--gfb", "x")):
            status, said = command(*words)
            self.assertTrue(status, said)
            self.assertIsNone(re.search(r"Traceback", said), said)


if __name__ == "__main__":
    unittest.main()
