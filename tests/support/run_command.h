#pragma once

#include "io/cli/command.h"

#include <sstream>
#include <string>
#include <vector>

namespace viscard::test {

// The output and the exit status of a command.
struct CommandOutcome {
  int status = 0;
  std::string out, err;
};

// Runs `viscard WORDS...` inside the test.
inline CommandOutcome run_command(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  Streams streams{out, err, false};
  const int status = run_viscard(words, streams);
  return {status, out.str(), err.str()};
}

}  // namespace viscard::test
