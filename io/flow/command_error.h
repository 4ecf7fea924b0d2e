#pragma once

#include <nlohmann/json_fwd.hpp>

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {

// Why something failed, for programs and for the page at the rig: the object
// {"code", "message", "where", "hint"}. The codes are stable; io/cli/rig/README.md lists them.
struct CommandError {
  std::string code;
  std::string message;  // what happened, with the value and its limit
  std::string where;    // file with its line, option, port or phase of the run; may be empty
  std::string hint;     // what to do next; may be empty
};

// A failure whose code no other type of exception shows.
class CodedError : public std::runtime_error {
 public:
  CodedError(std::string code, const std::string& text)
      : std::runtime_error(text), code_(std::move(code)) {}
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

// Divides a message for people, which states what happened and then what to do, into its parts.
// where: if it is empty, the place that the text names.
CommandError command_error(const std::string& code, const std::string& text,
                           const std::string& where = "");
// The code follows from the type of the exception.
CommandError command_error(const std::exception& error);

nlohmann::ordered_json json_from_error(const CommandError& error);

}  // namespace viscard
