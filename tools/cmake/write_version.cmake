find_package(Git QUIET)
set(GFB_COMMIT unknown)
if(GIT_FOUND)
  # Only a repository of gfb's own counts, not one around an unpacked archive, whose settings may name a program to call.
  get_filename_component(around ${SOURCE} DIRECTORY)
  set(ENV{GIT_CEILING_DIRECTORIES} ${around})
  execute_process(COMMAND ${GIT_EXECUTABLE} -c core.fsmonitor=false describe --always --dirty --abbrev=12
                  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit RESULT_VARIABLE status
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(status EQUAL 0)
    set(GFB_COMMIT ${commit})
  endif()
endif()
configure_file(${SOURCE}/include/gfb_version.h.in ${BINARY}/include/gfb_version.h @ONLY)
