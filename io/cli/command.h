#pragma once

#include "io/basics/nearest_word.h"

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {

// Where a command prints: results on out, progress and messages on err.
struct Streams {
  std::ostream& out;
  std::ostream& err;
  bool err_is_terminal = false;
};

// Exit status of every command.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kBadWords = 2;

// Bad words on the command line: exit status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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
