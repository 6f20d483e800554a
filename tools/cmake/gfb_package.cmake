# `cpack -G DEB` in a build folder makes a package for Debian of what `cmake --install` installs.

set(CPACK_PACKAGE_NAME gfb)
set(CPACK_PACKAGE_VENDOR "The gfb developers")
set(CPACK_PACKAGE_CONTACT "The gfb developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION "Where the shaft floats under a load, how thin the gas film is, friction, stiffness and damping, onset
 of whirl; top foil and bumps as shells or beams in contact with friction, or an elastic foundation.")
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin, libopenblas0-serial")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-h5py, python3-matplotlib, paraview")
include(CPack)
