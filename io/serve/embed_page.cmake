# Writes a C++ file with the contents of FILES, a list of "PATH=FILE" separated by "|", as strings.
#   cmake -DFILES=... -DOUT=page_files.cpp -P embed_page.cmake
set(rows "")
string(REPLACE "|" ";" pairs "${FILES}")
foreach(pair IN LISTS pairs)
  string(REGEX MATCH "^([^=]+)=(.+)$" ignored "${pair}")
  set(path "${CMAKE_MATCH_1}")
  set(file "${CMAKE_MATCH_2}")
  if(path MATCHES "\\.js$")
    set(type "text/javascript")
  elseif(path MATCHES "\\.css$")
    set(type "text/css")
  elseif(path MATCHES "\\.svg$")
    set(type "image/svg+xml")
  else()
    set(type "text/html")
  endif()
  file(READ "${file}" text)
  string(FIND "${text}" ")page\"" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "${file} contains )page\", which ends the string that it is embedded in")
  endif()
  string(APPEND rows "      {\"${path}\", \"${type}; charset=utf-8\", R\"page(${text})page\"},\n")
endforeach()
file(WRITE "${OUT}" "// Written by embed_page.cmake.
#include \"io/serve/page_files.h\"

// C++ compilers need only accept 65536 characters; GCC and Clang accept any number.
#pragma GCC diagnostic ignored \"-Woverlength-strings\"

namespace viscard {

const std::vector<PageFile>& page_files() {
  static const std::vector<PageFile> kFiles{
${rows}  };
  return kFiles;
}

}  // namespace viscard
")
