#pragma once

#include "tests/support/scratch_folder.h"

#include <string>
#include <vector>

namespace viscard::test {

// What one `viscard WORDS...` printed and returned, run in this process.
struct CommandRun {
  int status = 0;
  std::string out;
  std::string err;
};
CommandRun run_words(const std::vector<std::string>& words);

// data/demo/NAME of the source tree.
std::string demo_file(const std::string& name);

}  // namespace viscard::test
