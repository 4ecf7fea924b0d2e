#pragma once

#include "io/cli/words/command_syntax.h"
#include "io/cli/words/streams.h"
#include "models/quantities/plausible.h"

#include <boost/program_options.hpp>

#include <optional>
#include <string>

namespace viscard {

// Parses the words. If --help is among them, prints the help and returns nothing. Adds --json, --color
// and --help to every command. Throws UsageError for an unknown option (with the nearest known one), a
// missing value or a value that cannot be read, and what check_output_paths() throws if an output
// would replace an input.
std::optional<boost::program_options::variables_map> parse_words(CommandSyntax& syntax,
                                                                 const Words& words,
                                                                 Streams& streams);

// The value of an option that sets `target` if it is given.
template <typename Value>
auto* into(std::optional<Value>& target) {
  return boost::program_options::value<Value>()->notifier(
      [&target](const Value& value) { target = value; });
}

// A value that was given or has a default.
template <typename Value = std::string>
std::optional<Value> given(const boost::program_options::variables_map& values, const char* name) {
  return values.count(name) > 0 ? std::optional(values[name].as<Value>()) : std::nullopt;
}

// How --plausible wants numbers judged: `otherwise`, or kOff.
Plausible given_plausible(const boost::program_options::variables_map& values,
                          Plausible otherwise = Plausible::kMeasured);

// The same in SI of a number or a text with its unit. Throws UsageError naming the option if it is no
// such quantity or, unless --plausible is off, no plausible one.
std::optional<double> given_quantity(const boost::program_options::variables_map& values,
                                     const char* name, const QuantityOrUnit& quantity);

// A positional word. Throws UsageError "no scene given; usage: ..." if it is missing.
template <typename Value = std::string>
Value required(const boost::program_options::variables_map& values, const char* name,
               const CommandSyntax& syntax) {
  if (const auto value = given<Value>(values, name)) return *value;
  throw UsageError(std::string("no ") + name + " given; usage: " + syntax.usage);
}

// "viscard" and the words, quoted for a shell; output files record it.
std::string quoted_command_line(const std::string& command, const Words& words);

}  // namespace viscard
