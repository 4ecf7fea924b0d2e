#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

struct Command {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& words, Streams& streams);
};

// In the order of the flow.
const std::vector<Command>& commands();

// Runs `viscard WORDS...` and returns the exit status; prints one clear line on any error.
int run_viscard(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
