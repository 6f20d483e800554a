#!/usr/bin/env python3
"""Commands called in a folder that somebody else has filled: nothing in it is imported, loaded or obeyed, and nothing outside of it is
touched. Whatever bears a name that Python, the loader or a library looks for leaves a mark where it counts."""

import ast
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
GFB = os.environ["GFB"]
sys.path.insert(0, str(PROJECT/"tools"))

from gfb.program import ENVIRONMENT, launcher  # noqa: E402 (found only now)
from slow import slow  # noqa: E402

SECONDS = 120
TOOLS = PROJECT/"tools"
CASE = """&bearing radius = 19.05e-3 length = 38.1e-3 clearance = 31.8e-6 /
&gas viscosity = 1.95e-5 ambient_pressure = 1.0135e5 /
&operation speed_rpm = 30000.0 load = -30.0, 0.0 /
&model foil = 'rigid' /
&mesh circumferential_elements = 48 axial_elements = 8 /
"""
OTHERS = ("gfb", "sitecustomize", "usercustomize", "pip", "venv", "ensurepip", "wheel", "setuptools", "sphinx", "ford")
OF_PYTHON = re.compile(r"\bpython3?\b\"? +(?:\S+ +)*?-[cm]\b|sys\.executable, \"-[cm]\"")


def imported():
    """Top names of all modules that the tools import, and of Python's own."""
    found = {*OTHERS, *getattr(sys, "stdlib_module_names", ())}
    for path in TOOLS.rglob("*.py"):
        for one in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(one, ast.Import):
                found |= {name.name.split(".")[0] for name in one.names}
            elif isinstance(one, ast.ImportFrom) and not one.level:
                found.add(one.module.split(".")[0])
    return sorted(name for name in found if name.isidentifier() and name != "__main__")


class InStrangersFolder(unittest.TestCase):
    """A folder of somebody else, a file of the user's own, and a run in a third place."""

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.place = pathlib.Path(place.name)
        cls.case = cls.place/"case.nml"
        cls.case.write_text(CASE, encoding="utf-8")
        cls.home = cls.place/"home"
        cls.home.mkdir()
        subprocess.run([GFB, "--quiet", "--output", cls.place, cls.case], check=True, stdout=subprocess.DEVNULL, cwd=cls.place)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=self.place))
        self.mark, self.own = self.place/"mark", self.place/"own"
        self.own.write_text("of the user\n", encoding="utf-8")
        self.mark.unlink(missing_ok=True)

    def call(self, *words, status=0, **settings):
        """What a command says, called in the folder; it must end with this status."""
        done = subprocess.run([str(word) for word in words], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", errors="replace", check=False, timeout=SECONDS,
                              env={**ENVIRONMENT, **os.environ, "HOME": str(self.home), "GFB_INSTALL": "no", **settings})
        where = f"{' '.join(map(str, words))}: {done.stdout}"
        self.assertFalse(self.mark.exists(), f"{self.mark.exists() and self.mark.read_text(encoding='utf-8')} counted: {where}")
        self.assertEqual(self.own.read_text(encoding="utf-8"), "of the user\n", where)
        self.assertEqual(done.returncode, status, where)
        return done.stdout

    def plant(self, **files):
        """Files of the folder."""
        for name, content in files.items():
            (self.folder/name).write_text(content, encoding="utf-8")


class Imports(InStrangersFolder):
    def setUp(self):
        super().setUp()
        names = imported()
        self.assertGreater(len(names), 100)
        for name in names:
            (self.folder/f"{name}.py").write_text(f"open({str(self.mark)!r}, 'a').write(__name__ + ' ')\nraise SystemExit(77)\n", encoding="utf-8")

    @slow
    def test_slow_every_command_of_the_checkout(self):
        there = [path for path in sorted(TOOLS.iterdir()) if path.is_file() and os.access(path, os.X_OK)]
        self.assertGreater(len(there), 15)
        for path in there:
            self.assertIn("tools/", self.call(path, "--help"))

    def test_what_they_do(self):
        film, script = self.place/"case.film.vtkhdf", self.place/"draws.py"
        self.call(TOOLS/"plot", film, "-o", self.place/"picture.png")
        # Each picture of a page is drawn by a Python of its own.
        script.write_text("import pathlib, sys\nfrom gfb.report.main import drawn\n"
                          "sys.exit(0 if drawn(sys.argv[1:2], pathlib.Path(sys.argv[2])) else 1)\n", encoding="utf-8")
        self.call(sys.executable, script, film, self.place/"other.png", PYTHONPATH=str(TOOLS))
        installed = (TOOLS.parent/"build/studio_venv/installed.txt").exists()
        self.call(TOOLS/"studio", self.place/"none", status=1 if installed else 3)

    def test_every_command_of_the_wheel(self):
        """Scripts as pip writes them, in another folder."""
        named = re.findall(r'^(gfb-\w+) = "(gfb\.\w+):(\w+)"$', (TOOLS/"pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertGreater(len(named), 5)
        for name, module, function in named:
            script = self.place/name
            script.write_text(f"import sys\nfrom {module} import {function}\nif __name__ == '__main__':\n    sys.exit({function}())\n", encoding="utf-8")
            self.assertIn(f"usage: {name}", self.call(sys.executable, script, "--help", PYTHONPATH=str(TOOLS)))

    def test_no_python_is_started_where_it_imports_from_the_folder(self):
        """-c and -m put the current folder before all others, unless Python is isolated."""
        seen = 0
        for path in [*TOOLS.iterdir(), *TOOLS.rglob("*.py"), *(TOOLS/"cmake").iterdir(), *(PROJECT/"packaging").rglob("*")]:
            if path.is_file():
                for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
                    if OF_PYTHON.search(line):
                        seen += 1
                        self.assertTrue(re.search(r" -I -[cm]\b|\"-I\", \"-[cm]\"", line) or "html" in path.parts, f"{path}:{number}: {line}")
        self.assertGreater(seen, 4)
        for path in (PROJECT/"docs").rglob("*.md"):
            self.assertNotIn("python3 -m gfb", path.read_text(encoding="utf-8"), path)


class Settings(InStrangersFolder):
    def test_options_of_petsc(self):
        """Of files that nobody has named that of the home alone."""
        self.plant(**{".petscrc": f"-log_view :{self.own}\n-bearing_ksp_type gmres\n", "petscrc": f"-log_trace {self.own}\n-malloc_view {self.own}\n"})
        self.assertNotIn("given to PETSc", self.call(GFB, "--output", "out", self.case))
        for words in (("--version",), ("--check", self.case), ("--help",)):
            self.call(GFB, *words)
        self.call(launcher(GFB), "-n", "2", GFB, "--output", "out", self.case)
        (self.home/".petscrc").write_text("-bearing_snes_max_it 31\n", encoding="utf-8")
        self.addCleanup((self.home/".petscrc").unlink)
        named = self.place/"named"
        named.write_text("-bearing_snes_max_it 33\n", encoding="utf-8")
        for options, environment, number in (((), "", 31), ((), "32", 32), ((f"--petsc-options-file={named}",), "32", 33),
                                             (("--petsc-options-file", named, "--petsc", "-bearing_snes_max_it", "34"), "32", 34)):
            said = self.call(GFB, self.case, "--output", "out", *options, **({"PETSC_OPTIONS": f"-bearing_snes_max_it {environment}"} if environment else {}))
            self.assertIn(f"options given to PETSc: -bearing_snes_max_it {number}\n", said)
        self.assertNotIn("given to PETSc", self.call(GFB, self.case, "--output", "out", "--petsc", "-skip_petscrc"))
        self.assertIn("needs a file", self.call(GFB, self.case, "--petsc-options-file", status=1))
        self.assertIn("none there", self.call(GFB, self.case, "--petsc-options-file", "none there", status=3))

    def test_settings_of_mpi(self):
        """Open MPI's own files, and UCX's where Open MPI loads it: a log of its own goes to a file of the user's."""
        self.plant(**{"ucx.conf": f"UCX_LOG_FILE={self.own}\nUCX_LOG_LEVEL=trace\n", "mca-params.conf": "pml = nonsense\n",
                      "openmpi-mca-params.conf": "pml = nonsense\n", "hostfile": "nowhere slots=2\n", "openmpi-default-hostfile": "nowhere slots=2\n"})
        (self.folder/".openmpi").mkdir()
        shutil.copy(self.folder/"mca-params.conf", self.folder/".openmpi")
        for all_of_it in ({}, {"OMPI_MCA_osc": ""}, {"OMPI_MCA_osc": "", "OMPI_MCA_pml": ""}):
            self.call(GFB, "--output", "out", self.case, **all_of_it)
            self.call(launcher(GFB), "-n", "2", GFB, "--output", "out", self.case, **all_of_it)
        self.assertEqual(sorted(path.name for path in (self.folder/"out").iterdir()),
                         ["case.film.vtkhdf", "case.h5", "case.summary", "case.used.nml"])

    def test_a_relative_folder_for_temporary_files(self):
        """MPI starts in another folder: what the user has named from here is meant from here."""
        (self.folder/"short").mkdir()
        self.call(GFB, "--output", "out", self.case, TMPDIR="short")
        self.assertEqual(list((self.folder/"short").iterdir()), [])

    def test_libraries_begin_in_another_folder(self):
        """What a library reads as it is loaded, before the program begins, it does not read in the current folder."""
        source, library = self.place/"where.c", self.place/"where.so"
        source.write_text('#include <stdio.h>\n#include <unistd.h>\n__attribute__((constructor)) static void begin(void)\n'
                          '{ char here[4096]; fprintf(stderr, "loaded in %s\\n", getcwd(here, sizeof here)); }\n', encoding="utf-8")
        subprocess.run(["gcc", "-shared", "-fPIC", "-o", library, source], check=True)
        said = self.call(GFB, "--output", "out", self.case, LD_PRELOAD=str(library))
        self.assertIn("loaded in /\n", said)
        self.assertNotIn(f"loaded in {self.folder}", said)
        self.assertTrue((self.folder/"out/case.summary").exists(), "the program is back in its folder")

    def test_libraries_of_the_folder(self):
        """The loader's list of folders has no empty place, which it would take for this one."""
        needed = re.findall(r"^\s*(lib\S+) =>", self.call("ldd", GFB), re.MULTILINE)
        self.assertGreater(len(needed), 20)
        for name in needed:
            (self.folder/name).write_bytes(b"no library")
        self.assertTrue(self.call(GFB, "--version").startswith("gfb "))

    def test_settings_of_matplotlib(self):
        film, picture = self.place/"case.film.vtkhdf", self.place/"picture.png"
        self.call(TOOLS/"plot", film, "-o", picture)
        plain = picture.read_bytes()
        picture.unlink()
        self.plant(**{"matplotlibrc": "backend: module://evil\ntext.usetex: True\nfigure.facecolor: red\n",
                      "evil.py": f"open({str(self.mark)!r}, 'w').write('evil')\n"})
        shutil.copytree(self.folder, self.home/".config/matplotlib", dirs_exist_ok=True)
        for _ in range(2):
            self.call(TOOLS/"plot", film, "-o", picture)
            self.assertEqual(picture.read_bytes(), plain)
            picture.unlink()
            (self.folder/"matplotlibrc").unlink()
            os.mkfifo(self.folder/"matplotlibrc")  # nobody ever writes into it

    def test_links_in_the_place_of_pictures(self):
        """What is written beside a result that somebody else has made replaces a link there, and does not follow it."""
        for path in self.place.glob("case.*"):
            shutil.copy(path, self.folder)
        script = self.place/"writes.py"
        script.write_text("import pathlib, sys\nfrom gfb.report.main import read_run, write_page\n"
                          "write_page([read_run(pathlib.Path('case'), None, pictures=False)], pathlib.Path('case.html'))\n", encoding="utf-8")
        for name, words in (("case.film.vtkhdf.png", (TOOLS/"plot", "case.film.vtkhdf")), ("case.3d.vtkhdf", (TOOLS/"plot", "--3d", "case.h5", "-o", "a.png")),
                            ("case.html", (sys.executable, script))):
            (self.folder/name).symlink_to(self.own)
            self.call(*words, PYTHONPATH=str(TOOLS))
            self.assertFalse((self.folder/name).is_symlink(), name)
            self.assertGreater((self.folder/name).stat().st_size, 1000, name)
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name.startswith(".")], [])

    def test_a_repository_around_an_unpacked_archive(self):
        """Its settings name a program that git would call to ask what has changed."""
        self.plant(tool=f"#!/bin/sh\necho git > {self.mark}\n")
        (self.folder/"tool").chmod(0o755)
        source = self.folder/"gfb"
        (source/"include").mkdir(parents=True)
        shutil.copy(PROJECT/"include/gfb_version.h.in", source/"include")
        git = ["git", "-c", "user.name=a", "-c", "user.email=a@example.org"]
        for words in (["init", "--quiet"], ["add", "gfb"], ["commit", "--quiet", "--message", "a"], ["config", "core.fsmonitor", str(self.folder/"tool")]):
            self.call(*git, *words)
        self.call("cmake", f"-DSOURCE={source}", f"-DBINARY={self.folder}/built", "-P", TOOLS/"cmake/write_version.cmake")
        self.assertTrue((self.folder/"built/include/gfb_version.h").exists())
        script = f"source {TOOLS}/setup.sh; cd {source}; GIT_CEILING_DIRECTORIES={source.parent} git status; [[ $GIT_CEILING_DIRECTORIES == {PROJECT.parent} ]]"
        self.call("bash", "-c", script)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
