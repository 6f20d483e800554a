# Tests: .pf files by pFUnit where it is found, else by the stand-in in tests/support, and tests of
# the program driven by Python. All get the same environment.

find_package(PFUNIT QUIET)
if(NOT GFB_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(GFB_PYTHON ${Python3_EXECUTABLE} CACHE FILEPATH "Python of the tests" FORCE)
endif()
# Cached, because functions see the variables of the folder that calls them.
set(gfb_test_support ${PROJECT_SOURCE_DIR}/tests/support CACHE INTERNAL "the stand-in for pFUnit")

# Open MPI: root in a container, more ranks than cores, ranks of two tests on different cores, no ssh.
# One thread a rank; ranks that wait give their core to others, as tests run side by side.
set(gfb_test_environment
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
  OMPI_MCA_plm_rsh_agent=sh OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1
  PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
  OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
  CACHE INTERNAL "environment of every test")

# The environment, the labels and the limits of a test; those that may take longest begin first. The limit ends what hangs: a test
# has ten times what it may take, as other work may run beside it.
function(gfb_test_settings name)
  cmake_parse_arguments(TEST "" "PROCESSORS;TIMEOUT" "LABELS;ENVIRONMENT" ${ARGN})
  if(NOT TEST_PROCESSORS)
    set(TEST_PROCESSORS 1)
  endif()
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 600)
  endif()
  math(EXPR limit "10 * ${TEST_TIMEOUT}")
  set_tests_properties(${name} PROPERTIES
    ENVIRONMENT "${gfb_test_environment};${TEST_ENVIRONMENT}" LABELS "${TEST_LABELS}"
    PROCESSORS ${TEST_PROCESSORS} TIMEOUT ${limit} COST ${TEST_TIMEOUT})
endfunction()

# The modules of the stand-in: gfb_funit without MPI, gfb_pfunit with it. Called once.
function(gfb_add_stand_in)
  set(modules ${PROJECT_BINARY_DIR}/modules/test_support)
  foreach(file test_failures test_values funit test_run)
    list(APPEND plain ${gfb_test_support}/${file}.f90)
  endforeach()
  add_library(gfb_funit STATIC ${plain})
  add_library(gfb_pfunit STATIC ${gfb_test_support}/pfunit.f90 ${gfb_test_support}/mpi_test_run.f90)
  target_link_libraries(gfb_pfunit PUBLIC gfb_funit MPI::MPI_Fortran)
  foreach(library gfb_funit gfb_pfunit)
    set_target_properties(${library} PROPERTIES Fortran_MODULE_DIRECTORY ${modules})
    target_include_directories(${library} PUBLIC ${modules})
    gfb_compile_options(${library})
  endforeach()
endfunction()

# One executable and one test, as add_pfunit_ctest makes them, from the stand-in.
function(gfb_stand_in_executable name)
  cmake_parse_arguments(TEST "" "MAX_PES;EXTRA_USE;EXTRA_INITIALIZE" "TEST_SOURCES;LINK_LIBRARIES" ${ARGN})
  if(NOT TARGET gfb_funit)
    gfb_add_stand_in()
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name}.generated)
  file(MAKE_DIRECTORY ${folder})
  set(script ${gfb_test_support}/pf_to_f90.py)
  foreach(source ${TEST_TEST_SOURCES})
    get_filename_component(path ${source} ABSOLUTE)
    get_filename_component(stem ${source} NAME_WE)
    list(APPEND paths ${path})
    list(APPEND generated ${folder}/${stem}.F90)
    add_custom_command(OUTPUT ${folder}/${stem}.F90
      COMMAND ${GFB_PYTHON} ${script} module ${path} --output ${folder}/${stem}.F90
      DEPENDS ${path} ${script} COMMENT "${stem}.pf" VERBATIM)
  endforeach()

  set(options --name ${name}_program)
  set(library gfb_funit)
  if(TEST_MAX_PES)
    list(APPEND options --ranks)
    set(library gfb_pfunit)
  endif()
  if(TEST_EXTRA_INITIALIZE)
    list(APPEND options --use ${TEST_EXTRA_USE} --initialize ${TEST_EXTRA_INITIALIZE})
  endif()
  # The driver follows this list, so that a file added or dropped is never missed.
  file(CONFIGURE OUTPUT ${folder}/driver.list CONTENT "${options};${paths}\n" @ONLY)
  add_custom_command(OUTPUT ${folder}/driver.f90
    COMMAND ${GFB_PYTHON} ${script} driver ${paths} ${options} --output ${folder}/driver.f90
    DEPENDS ${paths} ${script} ${folder}/driver.list COMMENT "driver of ${name}" VERBATIM)

  add_executable(${name} ${generated} ${folder}/driver.f90)
  set_target_properties(${name} PROPERTIES Fortran_MODULE_DIRECTORY ${folder}/modules)
  target_link_libraries(${name} PRIVATE ${TEST_LINK_LIBRARIES} ${library})
  gfb_compile_options(${name})
endfunction()

# Tests from .pf files, one executable and one test:
#   gfb_pf_test(name TEST_SOURCES a_test.pf ... LINK_LIBRARIES ... [MAX_PES n] [LABELS ...] [TIMEOUT s] [PETSC])
# MAX_PES: start on n ranks (the files then `use pfunit`, else `use funit`); PETSC: start PETSc first. They count as so
# many processors: ranks that wait give their core away, and beside another test on two cores a test takes ten times as long.
function(gfb_pf_test name)
  cmake_parse_arguments(TEST "PETSC" "MAX_PES;TIMEOUT" "TEST_SOURCES;LINK_LIBRARIES;LABELS" ${ARGN})
  set(libraries ${TEST_LINK_LIBRARIES})
  set(settings)
  if(TEST_PETSC)
    if(NOT TEST_MAX_PES)
      set(TEST_MAX_PES 1)
    endif()
    if(NOT TARGET gfb_petsc_start)
      gfb_add_petsc_start()
    endif()
    list(APPEND libraries gfb_petsc_start gfb::petsc)
    list(APPEND settings EXTRA_USE gfb_petsc_start EXTRA_INITIALIZE start_petsc)
  endif()
  list(APPEND settings LINK_LIBRARIES ${libraries})
  set(command ${name})
  if(TEST_MAX_PES)
    list(APPEND settings MAX_PES ${TEST_MAX_PES})
    set(command ${MPIEXEC_EXECUTABLE} ${MPIEXEC_PREFLAGS} ${MPIEXEC_NUMPROC_FLAG} ${TEST_MAX_PES}
                $<TARGET_FILE:${name}>)
  endif()
  if(PFUNIT_FOUND)
    # From an absolute name pFUnit would write its Fortran beside the .pf file.
    foreach(source ${TEST_TEST_SOURCES})
      get_filename_component(path ${source} ABSOLUTE)
      file(RELATIVE_PATH path ${CMAKE_CURRENT_SOURCE_DIR} ${path})
      list(APPEND relative ${path})
    endforeach()
    add_pfunit_ctest(${name} TEST_SOURCES ${relative} ${settings})
    target_compile_options(${name} PRIVATE $<$<Fortran_COMPILER_ID:GNU>:-ffree-line-length-none>)
  else()
    gfb_stand_in_executable(${name} TEST_SOURCES ${TEST_TEST_SOURCES} ${settings})
    add_test(NAME ${name} COMMAND ${command} --verbose)
  endif()
  if(NOT name MATCHES "^unit_formulas_") # those compute by themselves
    gfb_optimise(-O0 ${name})
  endif()
  gfb_test_settings(${name} LABELS ${TEST_LABELS} PROCESSORS ${TEST_MAX_PES} TIMEOUT ${TEST_TIMEOUT})
endfunction()

# The module that starts PETSc and SLEPc before the tests of a program.
function(gfb_add_petsc_start)
  set(modules ${PROJECT_BINARY_DIR}/modules/petsc_start)
  add_library(gfb_petsc_start STATIC ${gfb_test_support}/petsc_start.F90)
  set_target_properties(gfb_petsc_start PROPERTIES Fortran_MODULE_DIRECTORY ${modules})
  target_include_directories(gfb_petsc_start PUBLIC ${modules})
  target_link_libraries(gfb_petsc_start PRIVATE gfb::petsc)
  gfb_compile_options(gfb_petsc_start)
endfunction()

# A test of the program as a whole:
#   gfb_program_test(name COMMAND script.py arguments ... LABELS ... [TIMEOUT s] [PROCESSORS n])
# A .py file runs under GFB_PYTHON. Its environment holds GFB (the program), GFB_PYTHON, GFB_MPIEXEC
# and GFB_SOURCE (the project's folder).
function(gfb_program_test name)
  cmake_parse_arguments(TEST "" "TIMEOUT;PROCESSORS" "COMMAND;LABELS" ${ARGN})
  list(GET TEST_COMMAND 0 first)
  if(first MATCHES "\\.py$")
    list(PREPEND TEST_COMMAND ${GFB_PYTHON})
  endif()
  add_test(NAME ${name} COMMAND ${TEST_COMMAND} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  gfb_test_settings(${name} LABELS ${TEST_LABELS} PROCESSORS ${TEST_PROCESSORS} TIMEOUT ${TEST_TIMEOUT}
    ENVIRONMENT GFB=$<TARGET_FILE:gfb> GFB_PYTHON=${GFB_PYTHON} GFB_MPIEXEC=${MPIEXEC_EXECUTABLE}
                GFB_SOURCE=${PROJECT_SOURCE_DIR} PYTHONDONTWRITEBYTECODE=1)
endfunction()
