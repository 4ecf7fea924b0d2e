#pragma once

#include "io/cli/words/streams.h"

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

namespace viscard {

// Why a command failed, for programs: with --json the commands at the rig print
// {"error": {"code", "message", "where", "hint"}}. The codes are stable and listed in README.md.
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

// The value of "error" as one line of JSON.
std::string json_from_error(const CommandError& error);

// Runs a command. If it throws and --json is among its words, prints the error as one object on
// stdout; the exception goes on in any case.
int with_json_errors(const Words& words, Streams& streams, const std::function<int()>& command);

}  // namespace viscard
