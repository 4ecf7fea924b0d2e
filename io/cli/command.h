#pragma once

#include "io/cli/words/streams.h"

#include <functional>
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

// Calls work() and returns its exit status. Prints one line on stderr for any exception, with the name
// of the program in front, and with --json among the words its object.
int with_exit_status(const char* program, const Words& words, Streams& streams,
                     const std::function<int()>& work);

}  // namespace viscard
