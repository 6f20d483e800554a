"""gfb by Spack, from the checkout in which this recipe lies (see packaging/README.md)."""

import pathlib

from spack.package import *

CHECKOUT = pathlib.Path(__file__).resolve().parents[4]


class Gfb(CMakePackage):
    """Bump-type gas foil bearings with the foils as structures: film, foils and shaft by one Newton method on PETSc."""

    homepage = "file://" + str(CHECKOUT/"README.md")
    git = "file://" + str(CHECKOUT)

    license("BSD-2-Clause")

    version("main", branch="main")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("git", type="build")

    depends_on("mpi")
    depends_on("blas")
    depends_on("lapack")
    depends_on("metis@5:")
    # PETSc's own MUMPS, with complex numbers as well; double precision, indices of 32 or 64 bits.
    depends_on("mumps+mpi+double+complex")
    depends_on("petsc@3.18:+mpi+mumps+fortran+double~complex")
    depends_on("slepc@3.18:")
    depends_on("suite-sparse")
    depends_on("hdf5+mpi+fortran")

    # The tests are Python programs, too.
    depends_on("python@3.9:", type=("build", "test"))
    depends_on("py-numpy", type="test")
    depends_on("py-h5py", type="test")
    depends_on("py-matplotlib", type="test")
    depends_on("py-jinja2", type="test")
    depends_on("py-xarray", type="test")
    depends_on("py-scipy", type="test")

    def cmake_args(self):
        spec = self.spec
        return [
            self.define("GFB_TESTS", self.run_tests),
            self.define("HDF5_ROOT", spec["hdf5"].prefix),
            self.define("METIS_INCLUDE_DIR", spec["metis"].prefix.include),
            self.define("MUMPS_INCLUDE_DIR", spec["mumps"].prefix.include),
        ]

    def check(self):
        """ctest without the tests of minutes."""
        with working_dir(self.build_directory):
            ctest = Executable(self.spec["cmake"].prefix.bin.ctest)
            ctest("--output-on-failure", "--label-exclude", "long|hard")
