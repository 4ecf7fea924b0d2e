#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

struct Command {
  const char* name;
  const char* summary;
  int (*run)(const Words& words, Streams& streams);
};

// All commands, in the order in which a user needs them.
const std::vector<Command>& commands();

// Runs `viscard WORDS...` and returns the exit status. Prints one line on stderr for any error.
int run_viscard(const Words& words, Streams& streams);

}  // namespace viscard
