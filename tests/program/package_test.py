#!/usr/bin/env python3
"""The Debian package: what cpack puts in, what it depends on, and that its program and files are of use where they are."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["GFB"])
SOURCE = pathlib.Path(os.environ["GFB_SOURCE"])
TOOLS = ("cpack", "dpkg-deb", "dpkg-shlibdeps")
LIBRARIES = ("libc6", "libgfortran5", "libhdf5-openmpi", "libklu1", "libmetis5", "libmumps", "libopenmpi", "libpetsc-real", "libslepc-real")


def said(*words):
    """What a command prints."""
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout


@unittest.skipUnless(all(shutil.which(tool) for tool in TOOLS), "no cpack and dpkg-dev here")
class PackageTest(unittest.TestCase):
    def test_package(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            subprocess.run(["cpack", "--config", str(PROGRAM.parent/"CPackConfig.cmake"), "-G", "DEB", "-B", str(folder)], check=True,
                           capture_output=True, cwd=PROGRAM.parent)
            package, = folder.glob("gfb_*.deb")
            depends = said("dpkg-deb", "--field", package, "Depends")
            self.assertEqual([name for name in LIBRARIES if name not in depends], [], depends)
            self.assertEqual(said("dpkg-deb", "--field", package, "Version").strip(), said(PROGRAM, "--version").split()[1])

            listed = {line.split()[5].removeprefix("./usr/") for line in said("dpkg-deb", "--contents", package).splitlines()}
            wanted = {"bin/gfb", *(f"share/{path.relative_to(SOURCE/'share')}" for path in (SOURCE/"share").rglob("*") if path.is_file()),
                      *(f"share/gfb/inputs/{path.name}" for path in (SOURCE/"inputs").glob("*.nml")),
                      *(f"share/doc/gfb/{path.relative_to(SOURCE)}" for path in (SOURCE/"docs").rglob("*.md")),
                      *(f"share/doc/gfb/{name}" for name in ("README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md"))}
            self.assertEqual(wanted - listed, set())
            self.assertEqual({path for path in listed if path.startswith(("lib", "include"))}, set(), "parts of the build")

            subprocess.run(["dpkg-deb", "--extract", str(package), str(folder/"root")], check=True)
            usr = folder/"root/usr"
            self.assertIn("is in order", said(usr/"bin/gfb", "--check", usr/"share/gfb/inputs/gu2020_bearing.nml"))


if __name__ == "__main__":
    unittest.main()
