#pragma once

#include "io/cli/words/command_syntax.h"
#include "io/cli/words/streams.h"
#include "models/quantities/plausible.h"

#include <initializer_list>
#include <string>

namespace viscard {

// Parses the words into the targets of the syntax. If --help is among them, prints the help and returns
// false. Adds --json, --color and --help to every command. Throws UsageError for an unknown option (with
// the nearest known one), a missing word or value and a value that is not allowed, and what
// check_output_paths() throws if an output would replace an input.
bool parse_words(CommandSyntax& syntax, const Words& words, Streams& streams);

// Whether an option or a positional word was given.
bool is_given(const CommandSyntax& syntax, const std::string& name);

// The values as typed of those options and positional words that were given, in this order.
Words given_words(const CommandSyntax& syntax, std::initializer_list<const char*> names);

// How --plausible wants numbers judged: `otherwise`, or kOff.
Plausible given_plausible(const CommandSyntax& syntax, Plausible otherwise = Plausible::kMeasured);

// "viscard" and the words without --json, quoted for a shell; output files record it.
std::string quoted_command_line(const std::string& command, const Words& words);

// Does the work; a mistake in the options becomes a UsageError.
template <typename Work>
auto with_usage_errors(const Work& work) {
  try {
    return work();
  } catch (const OptionError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace viscard
