#pragma once

#include "io/basics/program.h"

#include <string>

namespace viscard::test {

// Kept files name the version that wrote them; each commit writes its own beside it.
inline std::string without_commit(std::string text) {
  const std::string commit = program_version().substr(std::string(VISCARD_VERSION).size());
  for (std::size_t at = text.find(commit); at != std::string::npos; at = text.find(commit, at))
    text.erase(at, commit.size());
  return text;
}

}  // namespace viscard::test
