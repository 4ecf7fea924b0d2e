#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {

// The words of a command line after the name of the command.
using Words = std::vector<std::string>;

struct CommandSyntax;

// Output of a command: results go to out, progress and messages to err.
struct Streams {
  std::ostream& out;
  std::ostream& err;
  bool err_is_terminal = false;
  bool has_printed_json = false;  // --json prints one object; an error after it is only a message
  bool accepts_implausible = false;  // --plausible off, or so says a scene; --json states it
  std::size_t columns = 0;           // width of the terminal that out is; 0: not known
  bool is_out_coloured = false, is_err_coloured = false;
  // Receives the syntax of a command in the place of its --help, for manual pages and completion.
  std::function<void(const CommandSyntax&)> on_help = nullptr;
};

// Exit status of every command.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kBadWords = 2;

// The command line is wrong; the exit status is 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace viscard
