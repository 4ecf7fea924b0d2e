# What `cmake --install` puts where, in components: runtime, development, documentation, from
# io/cli/mpi mpi, and from io/python python. ./run package makes a Debian package of each.
include(CMakePackageConfigHelpers)
set(packaging ${CMAKE_CURRENT_LIST_DIR})

# A program in the build folder finds its data as an installed one does, by its own place.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share)
file(CREATE_LINK ${CMAKE_SOURCE_DIR}/data ${CMAKE_BINARY_DIR}/share/viscard SYMBOLIC)

# --- runtime: the program, its data, man pages, completions ---------------------------------------
install(TARGETS viscard RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
# Texts with paths of the installed files in the place of those of the source tree.
set(folders_of_data "demo|designs|materials|protocols|requirements|scenes|seed|studies")
configure_file(${packaging}/installed_texts.cmake.in ${CMAKE_BINARY_DIR}/installed_texts.cmake @ONLY)
configure_file(${packaging}/install_documents.cmake.in ${CMAKE_BINARY_DIR}/install_documents.cmake @ONLY)
install(SCRIPT ${CMAKE_BINARY_DIR}/install_documents.cmake COMPONENT runtime)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(FILES ${packaging}/viscard.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT runtime)
install(FILES ${packaging}/viscard.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT runtime)
install(DIRECTORY data/pictures DESTINATION ${CMAKE_INSTALL_DOCDIR}/data COMPONENT runtime)
install(DIRECTORY ${CMAKE_BINARY_DIR}/schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/viscard COMPONENT runtime OPTIONAL
        FILES_MATCHING PATTERN "*.schema.json" PATTERN "keys.md")
# Pages link to files of these as they stand in the source tree: link_from_page(FOLDER OF_DATA NAME).
function(link_from_page folder of_data name)
  file(RELATIVE_PATH data /${CMAKE_INSTALL_DOCDIR}/${folder} /${CMAKE_INSTALL_DATADIR}/viscard/${of_data})
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/page_links)
  file(CREATE_LINK ${data}/${name} ${CMAKE_BINARY_DIR}/page_links/${name} SYMBOLIC)
  install(FILES ${CMAKE_BINARY_DIR}/page_links/${name} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT runtime)
endfunction()
link_from_page(data "" demo)
set(completions ${CMAKE_BINARY_DIR}/completions)
install(FILES ${completions}/viscard.bash RENAME viscard COMPONENT runtime OPTIONAL
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${completions}/_viscard COMPONENT runtime OPTIONAL
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${completions}/viscard.fish COMPONENT runtime OPTIONAL
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# --- mpi: a program of its own, since plain viscard needs no MPI -----------------------------------------
if(TARGET viscard_mpi)
  install(TARGETS viscard_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
  install(CODE "include(\"${CMAKE_BINARY_DIR}/installed_texts.cmake\")
    if(EXISTS \"${CMAKE_BINARY_DIR}/mpi/viscard-mpi.1\")
      install_text(\"${CMAKE_BINARY_DIR}/mpi/viscard-mpi.1\" \"${CMAKE_INSTALL_MANDIR}/man1\")
    endif()" COMPONENT mpi)
endif()

# --- development: one archive of all rooms, the headers, and how to find them -----------------------
get_property(rooms GLOBAL PROPERTY VISCARD_ROOMS)
list(FILTER rooms EXCLUDE REGEX "^viscard_io_(python|cli_mpi)")  # of a module of Python, and of viscard-mpi, alone
list(TRANSFORM rooms REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE room_objects)
add_library(viscard_library STATIC ${room_objects})
set_target_properties(viscard_library PROPERTIES OUTPUT_NAME viscard LINKER_LANGUAGE CXX)
install(TARGETS viscard_library ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)

set(headers_destination ${CMAKE_INSTALL_INCLUDEDIR}/viscard)
configure_file(${packaging}/install_headers.cmake.in ${CMAKE_BINARY_DIR}/install_headers.cmake @ONLY)
install(SCRIPT ${CMAKE_BINARY_DIR}/install_headers.cmake COMPONENT development)
install(DIRECTORY data/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/viscard COMPONENT development
        FILES_MATCHING PATTERN "*.cpp" PATTERN "CMakeLists.txt")
if(TARGET viscard_python)
  install(DIRECTORY data/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/viscard COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.ipynb")
endif()

file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
configure_file(${packaging}/viscard.pc.in ${CMAKE_BINARY_DIR}/viscard.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/viscard.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)
configure_package_config_file(${packaging}/viscardConfig.cmake.in ${CMAKE_BINARY_DIR}/viscardConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/viscard PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/viscardConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/viscardConfig.cmake ${CMAKE_BINARY_DIR}/viscardConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/viscard COMPONENT development)

# --- documentation: the pages about the headers ---------------------------------------------------------
find_program(DOXYGEN doxygen)
if(DOXYGEN)
  add_custom_target(viscard_api
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DOUT=${CMAKE_BINARY_DIR}/api -DVERSION=${PROJECT_VERSION}
            -P ${packaging}/make_api.cmake
    COMMENT "Documentation of the library's headers" VERBATIM)
endif()
install(DIRECTORY ${CMAKE_BINARY_DIR}/api/html/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/api COMPONENT documentation
        OPTIONAL PATTERN "*.html" EXCLUDE)
install(CODE "include(\"${CMAKE_BINARY_DIR}/installed_texts.cmake\")
  file(GLOB pages \"${CMAKE_BINARY_DIR}/api/html/*.html\")
  foreach(page \${pages})
    install_text(\"\${page}\" \"${CMAKE_INSTALL_DOCDIR}/api\")
  endforeach()" COMPONENT documentation)

# --- away again ---------------------------------------------------------------------------------------
add_custom_target(uninstall
  COMMAND ${CMAKE_COMMAND} -DMANIFEST=${CMAKE_BINARY_DIR}/install_manifest.txt -P ${packaging}/uninstall.cmake
  USES_TERMINAL VERBATIM)

include(${packaging}/debian.cmake)
