#!/usr/bin/env python3
"""CMake refuses libraries that do not fit gfb or each other, each by a sentence; warnings are errors only where they are asked to be."""

import os
import pathlib
import subprocess
import tempfile
import unittest

PROJECT = pathlib.Path(os.environ["GFB_SOURCE"])
PETSC = ("PETSC_USE_REAL_DOUBLE 1", "PETSC_HAVE_MUMPS 1")
METIS, MUMPS = ("IDXTYPEWIDTH 32",), ("MUMPS_INTSIZE32",)
MPI, OTHER_MPI = "libmpi.so.40", "libmpich.so.12"
WRONG = (  # what is changed, what is said of it
    ({"petsc": (*PETSC, "PETSC_USE_COMPLEX 1")}, "This PETSc is of complex numbers"),
    ({"petsc": ("PETSC_USE_REAL_SINGLE 1", "PETSC_HAVE_MUMPS 1")}, "This PETSc is not of double precision"),
    ({"petsc": ("PETSC_USE_REAL___FLOAT128 1", "PETSC_HAVE_MUMPS 1")}, "This PETSc is not of double precision"),
    ({"petsc": (*PETSC, "PETSC_HAVE_MPIUNI 1")}, "This PETSc was configured without MPI"),
    ({"petsc": ("PETSC_USE_REAL_DOUBLE 1",)}, "This PETSc was configured without MUMPS"),
    ({"petsc": ()}, "petscconf.h is in none of its folders"),
    ({"metis": ("IDXTYPEWIDTH 64",)}, "This METIS has integers of 64 bits"),
    ({"mumps": ("MUMPS_INTSIZE64",)}, "This MUMPS has integers of 64 bits"),
    ({"slepc": (MPI, "libpetsc64_real.so.3.22")}, "This SLEPc is of another PETSc (libpetsc64_real.so.3.22)"),
    ({"slepc": (OTHER_MPI, "libpetsc_real.so.3.22")}, f"This SLEPc is of another MPI ({OTHER_MPI})"),
    ({"of_petsc": (OTHER_MPI,)}, f"This PETSc is of another MPI ({OTHER_MPI}) than the one that was found ({MPI})"),
    ({"hdf5": (OTHER_MPI,)}, f"This HDF5 is of another MPI ({OTHER_MPI})"),
    ({"hdf5": (OTHER_MPI,), "mpi": None}, f"This HDF5 is of another MPI ({OTHER_MPI}) than the one that was found ({MPI})"),
    ({"zmumps": (OTHER_MPI,)}, f"This MUMPS is of another MPI ({OTHER_MPI})"),
    ({"parallel": "FALSE"}, "This HDF5 is not for MPI"),
)


def header(path, definitions):
    if definitions:
        path.write_text("".join(f"#define {words}\n" for words in definitions), encoding="utf-8")


class Libraries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)

    def library(self, name, given, needed=()):
        """A shared library that calls itself `given` and needs others."""
        path = self.folder/"_".join((given, *needed))/name
        if not path.exists():
            path.parent.mkdir(exist_ok=True)
            others = [self.library(other, other) for other in needed]
            subprocess.run(["gcc", "-shared", "-nostdlib", "-x", "c", "/dev/null", "-x", "none", "-o", path, f"-Wl,-soname,{given}",
                            "-Wl,--no-as-needed", *others], check=True)
        return path

    def judged(self, petsc=PETSC, metis=METIS, mumps=MUMPS, of_petsc=(MPI,), slepc=(MPI, "libpetsc_real.so.3.22"), hdf5=(MPI,),
               zmumps=(MPI,), mpi=MPI, parallel="TRUE"):
        """Status and words of CMake about such libraries; one of each is right where nothing else is said."""
        for path in self.folder.glob("*.h"):
            path.unlink()
        petsc_library = self.library("libpetsc_real.so", "libpetsc_real.so.3.22", of_petsc)
        header(self.folder/"petscconf.h", petsc)
        header(self.folder/"metis.h", metis)
        header(self.folder/"mumps_int_def.h", mumps)
        values = {
            "PETSC_INCLUDE_DIRS": self.folder, "METIS_INCLUDE_DIR": self.folder, "MUMPS_INCLUDE_DIR": self.folder,
            "PETSC_LINK_LIBRARIES": petsc_library,
            "SLEPC_LINK_LIBRARIES": f"{self.library('libslepc_real.so', 'libslepc_real.so.3.22', slepc)};{petsc_library}",
            "HDF5_C_LIBRARIES": self.library("libhdf5.so", "libhdf5.so.103", hdf5), "HDF5_IS_PARALLEL": parallel,
            "ZMUMPS_LIBRARY": self.library("libzmumps.so", "libzmumps.so.5", zmumps),
            "MPI_C_LIBRARIES": self.library("libmpi.so", mpi) if mpi else ""}
        script = self.folder/"check.cmake"
        script.write_text("cmake_policy(VERSION 3.20)\n" + "".join(f'set({name} "{value}")\n' for name, value in values.items())
                          + f"include({PROJECT}/tools/cmake/gfb_libraries.cmake)\ngfb_check_libraries()\n", encoding="utf-8")
        done = subprocess.run(["cmake", "-P", script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        return done.returncode, " ".join(done.stdout.split())

    def test_what_fits_is_taken(self):
        self.assertEqual(self.judged(), (0, ""))
        self.assertEqual(self.judged(petsc=(*PETSC, "PETSC_USE_64BIT_INDICES 1")), (0, ""))
        self.assertEqual(self.judged(mpi=None), (0, ""))  # the compiler is MPI's
        fortran = self.judged(of_petsc=("libmpi_mpifh.so.40", MPI), hdf5=(MPI, "libmpi_usempif08.so.40"))
        self.assertEqual(fortran, (0, ""))

    def test_what_does_not_fit_is_told(self):
        for change, sentence in WRONG:
            status, said = self.judged(**change)
            self.assertEqual((status, sentence in said, said.count("This ") + said.count("none of")), (1, True, 1), f"{change}: {said}")

    def test_all_at_once(self):
        status, said = self.judged(petsc=(*PETSC, "PETSC_USE_COMPLEX 1"), parallel="FALSE")
        self.assertEqual((status, "complex" in said, "not for MPI" in said), (1, True, True), said)


class Configuration(unittest.TestCase):
    def test_the_build_asks(self):
        """Warnings are errors where they are asked to be, and what does not fit ends CMake."""
        with tempfile.TemporaryDirectory() as folder:
            base = ["cmake", "-S", PROJECT, "-B", folder, "-G", "Ninja", "-D", "GFB_TESTS=OFF"]
            rules = pathlib.Path(folder)/"build.ninja"
            for options, are_errors in (((), False), (("-D", "GFB_WARNINGS_ARE_ERRORS=ON"), True)):
                subprocess.run([*base, *options], check=True, stdout=subprocess.DEVNULL)
                text = rules.read_text(encoding="utf-8")
                self.assertEqual(("-Wall" in text, "-Werror" in text), (True, are_errors))
            header(pathlib.Path(folder)/"metis.h", ("IDXTYPEWIDTH 64",))
            done = subprocess.run([*base, "-D", f"METIS_INCLUDE_DIR={folder}"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, "This METIS has integers of 64 bits" in done.stderr), (1, True), done.stderr)


if __name__ == "__main__":
    unittest.main()
