# cmake -DSOURCE=FOLDER -DOUT=FILE [-DCOMMIT=TEXT] -P commit.cmake: writes the commit of the source as a C++ literal,
# only if it is another than FILE holds.
cmake_policy(VERSION 3.25)
if(NOT COMMIT)
  set(COMMIT no.commit)
  find_program(GIT git)
  # A tarball unpacked inside another repository is not a commit of that one.
  if(GIT AND EXISTS ${SOURCE}/.git)
    execute_process(COMMAND ${GIT} rev-parse --short=10 HEAD WORKING_DIRECTORY ${SOURCE}
                    OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
    if(NOT failed)
      execute_process(COMMAND ${GIT} diff --quiet HEAD WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE differs ERROR_QUIET)
      set(COMMIT ${found})
      if(differs)
        string(APPEND COMMIT .modified)
      endif()
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "\"@COMMIT@\"\n" @ONLY)
