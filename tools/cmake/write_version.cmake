# Writes include/gfb_version.h. The commit is that of the sources' own checkout, whoever owns it; of an archive that git has made,
# the one that stands in archived_commit.txt; of any other copy they are called a release.
set(GFB_COMMIT release)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/archived_commit.txt archived LIMIT_COUNT 1)
if(archived MATCHES "^[0-9a-f]+$")
  string(SUBSTRING ${archived} 0 12 GFB_COMMIT)
endif()
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${SOURCE}/.git) # not a checkout in which the sources lie as a copy
  # Settings of a repository around that one, or of it, may name a program to call.
  get_filename_component(around ${SOURCE} DIRECTORY)
  set(ENV{GIT_CEILING_DIRECTORIES} ${around})
  execute_process(COMMAND ${GIT_EXECUTABLE} -c core.fsmonitor=false -c safe.directory=${SOURCE} describe --always --dirty --abbrev=12
                  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit RESULT_VARIABLE status
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(status EQUAL 0)
    set(GFB_COMMIT ${commit})
  endif()
endif()
configure_file(${SOURCE}/include/gfb_version.h.in ${BINARY}/include/gfb_version.h @ONLY)
