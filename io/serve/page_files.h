#pragma once

#include <string_view>
#include <vector>

namespace viscard {

// A file of the page, built into the program.
struct PageFile {
  const char* path;  // "/run.js"
  const char* type;  // "text/javascript; charset=utf-8"
  std::string_view text;
};

// The files of page/ and the chart library. embed_page.cmake writes this function.
const std::vector<PageFile>& page_files();

}  // namespace viscard
