#!/usr/bin/env python3
"""The recipes of packaging/, as far as they can be looked at without Podman, Spack and conda; one version everywhere."""

import ast
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
PACKAGING = PROJECT/"packaging"
VERSION = re.search(r"project\(gfb VERSION ([\d.]+)", (PROJECT/"CMakeLists.txt").read_text(encoding="utf-8"))[1]
HAS_YAML = all(importlib.util.find_spec(name) for name in ("yaml", "jinja2"))


def text_of(name):
    return (PROJECT/name).read_text(encoding="utf-8")


class Recipes(unittest.TestCase):
    def test_one_version(self):
        for name, pattern in (("CITATION.cff", r"^version: (.*)$"), ("tools/pyproject.toml", r'^version = "(.*)"$'),
                              ("tools/gfb/__init__.py", r'^__version__ = "(.*)"$'), ("packaging/conda/meta.yaml", r'set version = "(.*)"'),
                              ("share/man/man1/gfb.1", r'"gfb ([\d.]+)"')):
            self.assertEqual(re.findall(pattern, text_of(name), re.MULTILINE), [VERSION], name)
        self.assertEqual(set(re.findall(r"gfb[-_](\d+\.\d+\.\d+)", text_of("docs/manual/first_steps.md"))), {VERSION})

    def test_commit(self):
        """The program is named after its commit: of a checkout, of an archive that git has made; any other copy is a release, also inside of
        another project's checkout."""
        def commit_of(folder):
            subprocess.run(["cmake", "-D", f"SOURCE={folder}", "-D", f"BINARY={self.place/'built'}", "-D", "PROJECT_VERSION=1.2.3", "-P",
                            folder/"tools/cmake/write_version.cmake"], check=True, capture_output=True)
            return re.search(r'GFB_COMMIT "(.*)"', (self.place/"built/include/gfb_version.h").read_text(encoding="utf-8"))[1]

        def git(*words):
            return subprocess.run(["git", "-C", self.place/"checkout", "-c", "user.name=x", "-c", "user.email=x@x", *words], check=True,
                                  capture_output=True, env={**os.environ, "GIT_CONFIG_GLOBAL": os.devnull}).stdout
        with tempfile.TemporaryDirectory() as place:
            self.place = pathlib.Path(place)
            for name in ("tools/cmake/write_version.cmake", "tools/cmake/archived_commit.txt", "include/gfb_version.h.in", ".gitattributes"):
                (self.place/"checkout"/name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(PROJECT/name, self.place/"checkout"/name)
            # This copy may be of an archive itself, in which git has filled in its commit.
            blank = "$Format:%H$\n"
            (self.place/"checkout/tools/cmake/archived_commit.txt").write_text(blank, encoding="utf-8")
            self.assertEqual(commit_of(self.place/"checkout"), "release")
            git("init")
            git("add", ".")
            git("commit", "-m", "x")
            commit = git("rev-parse", "HEAD").decode()[:12]
            self.assertEqual(commit_of(self.place/"checkout"), commit)
            for name in ("archive", "checkout/archive"):
                (self.place/name).mkdir()
                subprocess.run(["tar", "-x", "-C", self.place/name], input=git("archive", "HEAD"), check=True)
                self.assertEqual(commit_of(self.place/name), commit)
                (self.place/name/"tools/cmake/archived_commit.txt").write_text(blank, encoding="utf-8")
                self.assertEqual(commit_of(self.place/name), "release")

    def test_hashes(self):
        """A package of Python alone has one hash, one for every CPython two, x86-64 and 64-bit ARM; others those of 3.11 to 3.14."""
        for name in ("tools/requirements.txt", "tools/requirements_studio.txt"):
            for pin, hashes in re.findall(r"^(\S+==\S+) \\\n((?:  --hash=.*\n)+)", text_of(name), re.MULTILINE):
                found = re.findall(r"sha256:[0-9a-f]{64}", hashes)
                self.assertEqual(len(set(found)), len(found), pin)
                self.assertIn(len(found), (8,) if pin.startswith("vtk==") else (1, 2, 8), f"{name}: {pin}")

    def test_python(self):
        """What a user needs of tools/gfb is in the package; what needs a checkout is not."""
        text = text_of("tools/pyproject.toml")
        packages = set(re.findall(r'"(gfb[\w.]*)"', re.search(r"^packages = (.*)$", text, re.MULTILINE)[1]))
        there = {f"gfb.{path.parent.name}" for path in (PROJECT/"tools/gfb").glob("*/__init__.py")}
        self.assertEqual(there - packages, {"gfb.bench", "gfb.compare", "gfb.gallery", "gfb.html"})
        for package in packages:  # none of them uses those that are left out
            for path in (PROJECT/"tools"/package.replace(".", "/")).glob("*.py"):
                used = set(re.findall(r"(?:from|import) (gfb\.(?:bench|compare|gallery|html))", path.read_text(encoding="utf-8")))
                self.assertEqual(used if path.name != "manual.py" else set(), set(), path)
        for module, name in re.findall(r'= "([\w.]+):(\w+)"$', text, re.MULTILINE):
            called, = re.findall(rf'^{name} = main_of\("([\w.]+)"\)$', text_of(f"tools/{module.replace('.', '/')}.py"), re.MULTILINE)
            self.assertRegex(text_of(f"tools/{called.replace('.', '/')}.py"), r"(?m)^def main\(\)")

    def test_debian(self):
        """It recommends what the commands need of Python; its scripts are such."""
        project = text_of("tools/pyproject.toml")
        needed = {f"python3-{name}" for line in re.findall(r"^(?:dependencies|report) = \[(.*)\]", project, re.MULTILINE)
                  for name in re.findall(r'"(\w+)"', line)}
        recommended = set(re.search(r"^report_packages=\((.*)\)", text_of("tools/setup.sh"), re.MULTILINE)[1].split())
        self.assertEqual(needed - recommended, {"python3-xarray"})
        self.assertEqual(recommended - needed, set())
        scripts = sorted((PACKAGING/"debian").iterdir())
        self.assertEqual([path.name for path in scripts], ["postinst", "prerm"])
        for path in scripts:
            self.assertTrue(os.access(path, os.X_OK), path)
            subprocess.run(["sh", "-n", path], check=True)
            self.assertIn(f"packaging/debian/{path.name}", text_of("tools/cmake/gfb_package.cmake"))

    def test_calls_of_the_tool(self):
        for words, told in (((), "which package"), (("rpm",), "rpm: a package is wheel or deb"), (("deb", "wheel"), "one package at a time"),
                            (("deb", "--output"), "--output needs a value"), (("deb", "--build", "nowhere"), "there is no gfb")):
            done = subprocess.run([PROJECT/"tools/package", *words], check=False, text=True, capture_output=True, cwd="/", stdin=subprocess.DEVNULL)
            self.assertEqual((done.returncode, told in done.stderr), (1, True), done.stderr)

    def test_containerfile(self):
        text = text_of("packaging/Containerfile")
        words = {line.split()[0] for line in text.replace("\\\n", " ").splitlines() if line.strip() and line[0] != "#"}
        self.assertEqual(words - {"FROM", "ARG", "COPY", "WORKDIR", "RUN", "ENV", "ENTRYPOINT"}, set())
        for tool in re.findall(r"tools/\w+", text):
            self.assertTrue(os.access(PROJECT/tool, os.X_OK), tool)

    def test_spack(self):
        """Options and libraries are those of CMakeLists.txt."""
        path = PACKAGING/"spack/packages/gfb/package.py"
        tree = ast.parse(path.read_text(encoding="utf-8"))
        recipe, = (part for part in tree.body if isinstance(part, ast.ClassDef))
        self.assertEqual((recipe.name, recipe.bases[0].id), ("Gfb", "CMakePackage"))
        cmake = text_of("CMakeLists.txt")
        defined = re.findall(r'define\("(\w+)"', path.read_text(encoding="utf-8"))
        self.assertEqual([name for name in defined if name not in cmake and name != "HDF5_ROOT"], [])
        needed = {call.args[0].value for call in ast.walk(recipe) if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "depends_on"}
        for name in ("mpi", "metis", "mumps", "petsc", "slepc", "suite-sparse", "hdf5", "lapack", "pkgconfig", "cmake"):
            self.assertTrue(any(re.match(rf"{name}\b", spec) for spec in needed), name)
        self.assertEqual(path.parents[4], PROJECT)

    @unittest.skipUnless(HAS_YAML, "PyYAML or Jinja2 is not installed (python3-yaml, python3-jinja2)")
    def test_conda(self):
        import jinja2
        import yaml
        made = jinja2.Environment(undefined=jinja2.Undefined, autoescape=False).from_string(text_of("packaging/conda/meta.yaml")).render(
            compiler="{}_compiler".format, stdlib="{}_stdlib".format, mpi=None)
        recipe = yaml.safe_load(made)
        self.assertEqual(recipe["package"], {"name": "gfb", "version": VERSION})
        self.assertEqual((PACKAGING/"conda"/recipe["source"]["path"]).resolve(), PROJECT.resolve())
        self.assertIn("fortran_compiler", recipe["requirements"]["build"])
        self.assertIn("hdf5 * mpi_openmpi_*", recipe["requirements"]["host"])
        for name in re.findall(r"share/gfb/(inputs/\S+\.nml)", made):
            self.assertTrue((PROJECT/name).exists(), name)


if __name__ == "__main__":
    unittest.main()
