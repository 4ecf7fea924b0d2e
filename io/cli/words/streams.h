#pragma once

#include <iosfwd>
#include <stdexcept>

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

}  // namespace viscard
