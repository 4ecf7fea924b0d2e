#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {

class ResultVisitor;

// Why something failed, for programs and for the page at the rig: the object
// {"code", "message", "where", "hint"}. The codes are stable: usage (options or keywords that are not allowed), input
// (the contents of a file, or a value), exists (an output that is there already), file (a file or folder that cannot be
// used), preflight (a test that this rig cannot do), calibration (expired), port, device, device-lost,
// device-restarted, stage-alarm, readings-old, computer-late, force-limit, pressing, interrupted, records-lost (ends of
// a capture), unfit (a rig that failed its check), damaged (a capture), forbidden (a request to viscard
// serve that another page sent), failed (anything else).
struct CommandError {
  std::string code;
  std::string message;  // what happened, with the value and its limit
  std::string where;    // file with its line, option, port or phase of the run; may be empty
  std::string hint;     // what to do next; may be empty
};

// A failure whose code cannot be derived from its exception type.
class CodedError : public std::runtime_error {
 public:
  CodedError(std::string code, const std::string& text)
      : std::runtime_error(text), code_(std::move(code)) {}
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

// Divides a message for people, which states what happened and then what to do, into its parts.
// where: the place of the failure; if it is empty, the place that the text names.
CommandError command_error(const std::string& code, const std::string& text,
                           const std::string& where = "");
// The code follows from the type of the exception.
CommandError command_error(const std::exception& error);

void show_keys(ResultVisitor& v, const CommandError& error);

}  // namespace viscard
