# Compiler options of every target, and the outside libraries as targets of our own.

add_library(gfb_petsc INTERFACE)
add_library(gfb::petsc ALIAS gfb_petsc)
target_link_libraries(gfb_petsc INTERFACE PkgConfig::SLEPC PkgConfig::PETSC MPI::MPI_Fortran MPI::MPI_C
                                          LAPACK::LAPACK)
target_include_directories(gfb_petsc INTERFACE ${PROJECT_SOURCE_DIR}/include)

add_library(gfb_mumps INTERFACE)
add_library(gfb::mumps ALIAS gfb_mumps)
target_link_libraries(gfb_mumps INTERFACE ${ZMUMPS_LIBRARY} ${MUMPS_COMMON_LIBRARY})
target_include_directories(gfb_mumps INTERFACE ${MUMPS_INCLUDE_DIR})

add_library(gfb_klu INTERFACE)
add_library(gfb::klu ALIAS gfb_klu)
if(KLU_INCLUDE_DIR AND KLU_LIBRARY)
  target_link_libraries(gfb_klu INTERFACE ${KLU_LIBRARY})
  target_include_directories(gfb_klu INTERFACE ${KLU_INCLUDE_DIR})
  target_compile_definitions(gfb_klu INTERFACE GFB_KLU)
else()
  message(STATUS "KLU (Debian: libsuitesparse-dev) not found: MUMPS factors all matrices")
endif()

add_library(gfb_hdf5 INTERFACE)
add_library(gfb::hdf5 ALIAS gfb_hdf5)
target_link_libraries(gfb_hdf5 INTERFACE ${HDF5_Fortran_LIBRARIES} MPI::MPI_Fortran)
target_include_directories(gfb_hdf5 INTERFACE ${HDF5_Fortran_INCLUDE_DIRS})

# Off, each for its reason; what they found was looked at one by one:
set(gfb_warnings -Wall -Wextra
  -Wno-unused-dummy-argument # overridden procedures, PETSc's callbacks and tests take arguments that some do not need
  -Wno-uninitialized         # gfortran 12 means descriptors of allocatables that an assignment or a call allocates
  -Wno-maybe-uninitialized   # the same, and loops that run at least once; the debug build's signalling NaN finds real ones
  -Wno-c-binding-type)       # the kind of PetscInt and MPI_Fint, which the C shim takes, is known as a number only
if(GFB_WARNINGS_ARE_ERRORS)
  set(gfb_werror -Werror)
endif()
set(gfb_debug_checks -O0 -g -fcheck=all -finit-real=snan -finit-integer=-99999999 -finit-derived
                     -ffpe-trap=invalid,zero,overflow -fbacktrace)

# Arrays that the compiler makes for itself say so where they get no memory (-fcheck=mem).
set(gfb_release -O2 -g1 -fcheck=mem)
# Stacks may be small: what is large, such as a scene, a bearing or its solver, is allocated [bytes]. Tests are no concern.
# From its release 13 on gfortran keeps the first values of each type that a procedure allocates there, too.
set(gfb_frame -Wframe-larger-than=20000)
if(CMAKE_Fortran_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  set(gfb_frame -Wframe-larger-than=40000)
endif()

# What the sanitizers find ends the program. Pointers that are followed are checked by the address sanitizer alone; products of
# integers not at all, as gfortran multiplies bounds of descriptors that are not set yet and drops the product. So, and without
# the optimiser, the program compiles in a quarter of the time.
set(gfb_sanitizers -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,pointer-overflow,signed-integer-overflow -fno-sanitize-recover=all)
add_link_options("$<$<CONFIG:Sanitize>:${gfb_sanitizers}>")

function(gfb_compile_options target)
  if(NOT CMAKE_Fortran_COMPILER_ID STREQUAL GNU)
    return()
  endif()
  set(frame)
  if(CMAKE_CURRENT_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
    set(frame ${gfb_frame})
  endif()
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANGUAGE:Fortran>:${gfb_warnings} -ffree-line-length-none>
    $<$<COMPILE_LANGUAGE:C>:-Wall -Wextra>
    ${gfb_werror}
    $<$<AND:$<COMPILE_LANGUAGE:Fortran>,$<CONFIG:Debug>>:${gfb_debug_checks}>
    "$<$<AND:$<COMPILE_LANGUAGE:Fortran>,$<CONFIG:Release>>:${gfb_release};${frame}>"
    "$<$<CONFIG:Sanitize>:${gfb_sanitizers};-O0;-g1;-fno-omit-frame-pointer>")
  # Sources that need no preprocessor are standard Fortran; PETSc's headers are not.
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.f90$")
  if(sources)
    set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS "-std=f2018;-Wimplicit-interface")
  endif()
endfunction()

# gfb_optimise(LEVEL TARGET ...): another level than -O2. What hardly computes is compiled in a half (-O1) or a fifth (-O0) of the time,
# most of which went into copies of large types. Numbers may move by 1e-15.
function(gfb_optimise level)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<AND:$<COMPILE_LANG_AND_ID:Fortran,GNU>,$<CONFIG:Release>>:${level}>)
  endforeach()
endfunction()
