#!/usr/bin/env python3
"""The packages of tools/package, made of the program that is tested: what is in them, and that it is of use where it is.

    package_test.py DebTest | WheelTest
"""

import email
import os
import pathlib
import platform
import re
import shutil
import subprocess
import tempfile
import unittest
import zipfile

PROGRAM = pathlib.Path(os.environ["GFB"])
SOURCE = pathlib.Path(os.environ["GFB_SOURCE"])
PYTHON = "/usr/bin/python3"
TOOLS = ("setuptools", "pip", "wheel")  # of Debian's Python, in an order in which they can be imported
LIBRARIES = ("libc6", "libgfortran5", "libhdf5-openmpi", "libklu", "libmetis5", "libmumps", "libopenmpi", "libpetsc-real", "libslepc-real")
SYSTEM = " ".join(platform.freedesktop_os_release().get(name, "") for name in ("ID", "VERSION_ID"))
COMMANDS = set(re.findall(r"^(gfb-\w+) = ", (SOURCE/"tools/pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE))


def said(*words, **more):
    """What a command prints."""
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, **more).stdout


def missing(*programs):
    """Whether something is not installed that makes packages."""
    has_python = subprocess.run([PYTHON, "-c", "import " + ", ".join(TOOLS)], check=False, capture_output=True).returncode == 0
    return not has_python or not all(map(shutil.which, programs))


def make(kind, folder):
    """The package."""
    return pathlib.Path(said(SOURCE/"tools/package", kind, "--build", PROGRAM.parent, "--output", folder).splitlines()[-1])


class PackageTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="gfb package ")  # a blank in the name of the folder
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)


@unittest.skipIf(missing("cpack", "dpkg-deb", "dpkg-shlibdeps", "file", "gzip"), "no cpack, dpkg-dev, and pip, setuptools and wheel of Debian here")
class DebTest(PackageTest):
    def test_package(self):
        package = make("deb", self.folder)
        depends = said("dpkg-deb", "--field", package, "Depends")
        self.assertEqual([name for name in (*LIBRARIES, "python3") if name not in depends], [], depends)
        self.assertNotIn("-dev", depends)
        recommends = said("dpkg-deb", "--field", package, "Recommends")
        for name in ("openmpi-bin", "python3-numpy", "python3-h5py", "python3-matplotlib", "python3-jinja2"):
            self.assertIn(name, recommends)
        self.assertEqual(said("dpkg-deb", "--field", package, "Version").partition("-")[0], said(PROGRAM, "--version").split()[1])

        listed = set(re.findall(r" \./usr/(.*)$", said("dpkg-deb", "--contents", package), re.MULTILINE))
        wanted = {"bin/gfb", *(f"bin/{name}" for name in COMMANDS), "share/man/man1/gfb.1.gz", "share/doc/gfb/copyright",
                  *(f"share/{path.relative_to(SOURCE/'share')}" for path in (SOURCE/"share").glob("[!m]*/**/*") if path.is_file()),
                  *(f"share/gfb/inputs/{path.name}" for path in (SOURCE/"inputs").glob("*.nml")),
                  *(f"share/doc/gfb/{path.relative_to(SOURCE)}" for path in (SOURCE/"docs").rglob("*.md")),
                  *(f"lib/python3/dist-packages/gfb/{name}" for name in ("py.typed", "report/look.css", "report/page.html", "report/sketch.html", "studio/page.css")),
                  *(f"lib/python3/dist-packages/gfb/{path.name}" for path in (SOURCE/"tools/gfb").glob("*.py")),
                  *(f"share/doc/gfb/{name}" for name in ("README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md"))}
        self.assertEqual(wanted - listed, set())
        self.assertEqual([path for path in listed if re.match(r"include|lib/(?!$|python3/($|dist-packages/($|gfb)))", path)], [], "parts of the build")
        self.assertEqual([path for path in listed if re.search("__pycache__|dist-packages/gfb/bench", path)], [])

        said("dpkg-deb", "--extract", package, self.folder/"root")
        usr = self.folder/"root/usr"
        self.assertIn("is in order", said(usr/"bin/gfb", "--check", usr/"share/gfb/inputs/gu2020_bearing.nml"))
        about = said(PYTHON, usr/"bin/gfb-plot", "--help", env={**os.environ, "PYTHONPATH": str(usr/"lib/python3/dist-packages")})
        self.assertIn("usage: ", about)


@unittest.skipIf(missing("patchelf") or SYSTEM != "debian 12", "no Debian 12 with patchelf, and pip, setuptools and wheel of its Python")
class WheelTest(PackageTest):
    """In a virtual environment whose folder is not on the path: a page of Jupyter or an editor has no other."""

    def setUp(self):
        super().setUp()
        self.wheel = make("wheel", self.folder)
        self.home = self.folder/"home"
        said(PYTHON, "-m", "venv", "--system-site-packages", self.home)
        said(self.home/"bin/python", "-m", "pip", "install", "--no-deps", "--no-index", self.wheel)

    def call(self, command, *words, **more):
        """What a command of the wheel says to a user who has nothing else, and knows neither the checkout nor another program."""
        return said(self.home/"bin"/command, *words, cwd=self.folder, env={"PATH": "/usr/bin:/bin", **more})

    def test_wheel(self):
        with zipfile.ZipFile(self.wheel) as file:
            names = file.namelist()
            about = email.message_from_bytes(file.read(next(name for name in names if name.endswith(".dist-info/WHEEL"))))
        self.assertRegex(about["Tag"], r"^py3-none-manylinux_2_36_\w+$")
        licences = {name.partition("/licenses/")[2] for name in names}
        self.assertEqual({"gfb", "README", "libpetsc-real3.18", "libopenmpi3", "libopenblas0-serial", "libc6"} - licences, {"libc6"})

        case = self.home/"share/gfb/inputs/gu2020_foundation.nml"
        self.assertEqual(self.call("gfb", "--version").partition(", BLAS")[0], said(PROGRAM, "--version").partition(", BLAS")[0])
        self.assertIn("Haswell kernel", self.call("gfb", "--version", OPENBLAS_CORETYPE="Haswell"))
        loader = {"LD_DEBUG": "libs", "LD_DEBUG_OUTPUT": self.folder/"loaded"}
        self.call("gfb", "--quiet", "--output", "one", case, **loader)
        self.call("gfb-mpiexec", "-n", "2", "gfb", "--quiet", "--output", "two", case, **loader)
        said(PROGRAM, "--quiet", "--output", self.folder/"tested", case)
        script = f"import gfb; found = gfb.run({str(case)!r}, 'three', ranks=2); print(found['minimum_gap'], found.log)"
        gap, log = self.call("python", "-c", script).split(" ", 1)
        for folder in ("one", "two", "three"):
            self.assertAlmostEqual(self.gap_of(folder)/self.gap_of("tested"), 1.0, delta=1e-9)
        self.assertEqual(float(gap), self.gap_of("three"))
        self.assertIn("2 rank(s)", log)
        self.assert_own_libraries()

    def gap_of(self, folder):
        text = (self.folder/folder/"gu2020_foundation.summary").read_text(encoding="utf-8")
        return float(re.search(r"^minimum_gap = (\S+)", text, re.MULTILINE)[1])

    def assert_own_libraries(self):
        """Programs of the wheel have taken every library and plug-in from it, but the C library."""
        of_libc = {pathlib.Path(name).name for name in said("dpkg", "-L", "libc6").split()}
        programs = 0
        for path in self.folder.glob("loaded.*"):  # a shell before the program, in the same process
            text = path.read_text(encoding="utf-8", errors="replace")
            *_, before, program, after = re.split("initialize program: (.*)", text)
            if program == "gfb" or program.startswith(str(self.home)):
                taken = {pathlib.Path(name) for name in re.findall("calling init: (.*)", before + after)}
                foreign = [path for path in taken if path.name not in of_libc and not path.resolve().is_relative_to(self.home.resolve())]
                self.assertEqual(foreign, [])
                self.assertTrue(any(path.name.startswith("mca_") for path in taken), "no plug-in of Open MPI")
                programs += 1
        self.assertEqual(programs, 4)  # one alone, mpiexec, two ranks


if __name__ == "__main__":
    unittest.main()
