# include/gfb_version.h in the build folder: version, commit, compiler. The commit is read at every
# build, so an old build folder does not name an old commit.

add_custom_target(gfb_version_header
  COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D BINARY=${PROJECT_BINARY_DIR}
          -D PROJECT_VERSION=${PROJECT_VERSION} -D CMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}
          -D CMAKE_Fortran_COMPILER_ID=${CMAKE_Fortran_COMPILER_ID}
          -D CMAKE_Fortran_COMPILER_VERSION=${CMAKE_Fortran_COMPILER_VERSION}
          -P ${PROJECT_SOURCE_DIR}/tools/cmake/write_version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/include/gfb_version.h
  COMMENT "version header")
