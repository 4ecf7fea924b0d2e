# make_api: pages about the public headers by Doxygen. check_api states what must be explained in them; what
# is not, and what Doxygen cannot read, is an error.
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
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
VERBATIM_HEADERS = NO
HTML_TIMESTAMP = NO
HAVE_DOT = NO
QUIET = YES
WARN_LOGFILE = ${OUT}/warnings.txt
")
execute_process(COMMAND doxygen ${OUT}/Doxyfile COMMAND_ERROR_IS_FATAL ANY)

execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/check_api ${SOURCE} ${OUT} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "The documentation of the headers is not complete.")
endif()
file(REMOVE_RECURSE ${OUT}/Doxyfile ${OUT}/warnings.txt ${OUT}/xml)
