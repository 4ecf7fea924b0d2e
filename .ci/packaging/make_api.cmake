# make_api: pages about the public headers by Doxygen. In a header that programs of others include, every
# type and function must be explained; what Doxygen cannot read is a mistake in any header.
# Members need no comment if their names state unit and meaning.
#   cmake -DSOURCE=... -DOUT=... -DVERSION=... -P make_api.cmake
cmake_policy(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/doors.cmake)
public_headers("${SOURCE}" headers)
list(TRANSFORM headers PREPEND "${SOURCE}/" OUTPUT_VARIABLE inputs)
list(JOIN inputs " " inputs)
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
file(WRITE ${OUT}/Doxyfile "
PROJECT_NAME = viscard
PROJECT_NUMBER = ${VERSION}
PROJECT_BRIEF = \"a soft polymer from a load cell to a validated simulation\"
OUTPUT_DIRECTORY = ${OUT}
INPUT = ${CMAKE_CURRENT_LIST_DIR}/api.md ${inputs}
USE_MDFILE_AS_MAINPAGE = ${CMAKE_CURRENT_LIST_DIR}/api.md
FILTER_PATTERNS = *.h=${CMAKE_CURRENT_LIST_DIR}/doxygen_filter
STRIP_FROM_PATH = ${SOURCE}
STRIP_FROM_INC_PATH = ${SOURCE}
FULL_PATH_NAMES = YES
JAVADOC_AUTOBRIEF = YES
BUILTIN_STL_SUPPORT = YES
SORT_MEMBER_DOCS = NO
GENERATE_LATEX = NO
VERBATIM_HEADERS = NO
HTML_TIMESTAMP = NO
HAVE_DOT = NO
QUIET = YES
WARN_LOGFILE = ${OUT}/warnings.txt
")
execute_process(COMMAND doxygen ${OUT}/Doxyfile COMMAND_ERROR_IS_FATAL ANY)

file(STRINGS ${OUT}/warnings.txt warnings)
set(mistakes "")
foreach(warning ${warnings})
  string(REPLACE "${SOURCE}/" "" warning "${warning}")
  if(NOT warning MATCHES "is not documented")
    string(APPEND mistakes "  ${warning}\n")
  elseif(NOT warning MATCHES "\\((variable|enumvalue)\\)" AND warning MATCHES "^([^:]+):")
    if(CMAKE_MATCH_1 IN_LIST VISCARD_DOORS)
      string(APPEND mistakes "  ${warning}\n")
    endif()
  endif()
endforeach()
if(mistakes)
  message(FATAL_ERROR "Explain these in a comment above them:\n${mistakes}")
endif()
file(REMOVE ${OUT}/Doxyfile ${OUT}/warnings.txt)
