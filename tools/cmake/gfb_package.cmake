# `cpack -G DEB` in a build folder, or `tools/package deb`, makes a package for Debian of what `cmake --install` installs and of gfb
# for Python with its commands.

# What the commands need of Python. xarray, for gfb.read and gfb.study, brings another GB along on Debian: only suggested.
file(STRINGS ${PROJECT_SOURCE_DIR}/tools/setup.sh python REGEX "^report_packages=")
string(REGEX MATCHALL "python3-[a-z0-9]+" python "${python}")
list(JOIN python ", " python)
# Packages of one version for several systems are distinguished, and that of the later release of a system is the newer one.
set(release 1)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release system REGEX "^(ID|VERSION_ID)=")
  list(SORT system) # ID, VERSION_ID
  list(TRANSFORM system REPLACE "^[A-Z_]+=|\"" "")
  list(JOIN system "" system)
  set(release 1~${system})
endif()

configure_file(${PROJECT_SOURCE_DIR}/tools/cmake/complete_package.cmake.in ${PROJECT_BINARY_DIR}/complete_package.cmake @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_BINARY_DIR}/complete_package.cmake)
set(CPACK_PACKAGE_NAME gfb)
set(CPACK_PACKAGE_VENDOR "The gfb developers")
set(CPACK_PACKAGE_CONTACT "The gfb developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION "Where the shaft floats under a load, how thin the gas film is, friction,
stiffness and damping, onset of whirl; top foil and bumps as shells or beams
in contact with friction, or an elastic foundation.")
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${release})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS python3)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin, libopenblas0-serial, ${python}")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-xarray, paraview")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/postinst ${PROJECT_SOURCE_DIR}/packaging/debian/prerm)
include(CPack)
