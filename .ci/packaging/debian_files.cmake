# CPack runs this when the files of all packages are in place, each package below its component's name.
# It makes of them what Debian expects: compressed pages, changes and licence of each package, a library
# without debugging symbols, and nothing that differs from one build to the next.
cmake_policy(VERSION 3.25)
set(here ${CMAKE_CURRENT_LIST_DIR})
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  message(FATAL_ERROR "SOURCE_DATE_EPOCH is not set: packages carry the time of the last commit. "
                      "`./run package` sets it.")
endif()

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Time stamps in the form that Debian's changelogs have; always English, in UTC.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  set(doc ${root}/usr/share/doc/${name})
  file(MAKE_DIRECTORY ${doc})

  file(COPY_FILE ${here}/copyright ${doc}/copyright)
  file(REMOVE ${root}/usr/share/doc/viscard/LICENSE)  # its text is in copyright
  file(WRITE ${doc}/changelog.Debian
       "viscard (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) bookworm; urgency=medium\n\n"
       "  * Version ${CPACK_PACKAGE_VERSION}; changelog.gz of the package viscard lists the changes.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  if(EXISTS ${root}/usr/share/doc/viscard/CHANGELOG.md)
    file(RENAME ${root}/usr/share/doc/viscard/CHANGELOG.md ${doc}/changelog)
    run(sed -i "s#(CHANGELOG.md)#(changelog.gz)#" ${doc}/README.md)
  endif()

  # zsh of Debian looks for the completions of packages elsewhere than for those of the administrator.
  if(EXISTS ${root}/usr/share/zsh/site-functions)
    file(RENAME ${root}/usr/share/zsh/site-functions ${root}/usr/share/zsh/vendor-completions)
  endif()

  # Texts name files where they are installed, here still below ${root}.
  execute_process(COMMAND grep -rlIF ${root} ${root} OUTPUT_VARIABLE texts)
  string(REGEX MATCHALL "[^\n]+" texts "${texts}")
  foreach(text ${texts})
    run(sed -i "s#${root}##g" ${text})
  endforeach()
  file(GLOB pages ${root}/usr/share/man/man*/*.[1-9] ${doc}/changelog ${doc}/changelog.Debian)
  foreach(page ${pages})
    run(gzip -9n ${page})
  endforeach()
  file(GLOB_RECURSE archives ${root}/usr/lib/*.a)
  foreach(archive ${archives})
    run(strip --strip-debug --remove-section=.comment --enable-deterministic-archives ${archive})
  endforeach()

  run(find ${root} -type d -empty -delete)  # of files that this build did not make
  run(find ${root} -type d -exec chmod 755 {} +)
  run(find ${root} -type f -not -path "*/bin/*" -exec chmod 644 {} +)
  run(find ${root} -exec touch --no-dereference --date=@$ENV{SOURCE_DATE_EPOCH} {} +)
endforeach()
