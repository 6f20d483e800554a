find_package(Git QUIET)
set(GFB_COMMIT unknown)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12
                  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit RESULT_VARIABLE status
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(status EQUAL 0)
    set(GFB_COMMIT ${commit})
  endif()
endif()
configure_file(${SOURCE}/include/gfb_version.h.in ${BINARY}/include/gfb_version.h @ONLY)
