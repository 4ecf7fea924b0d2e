#pragma once

#include "io/cli/words/streams.h"

#include <boost/program_options.hpp>

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The syntax of one command, for parsing and for --help.
struct CommandSyntax {
  const char* usage;        // "viscard fit FILE... [OPTIONS]"
  const char* description;  // one or two sentences, in lines of at most 96 characters
  const char* example;      // a command line that works as printed
  boost::program_options::options_description options{"Options", 96};
  // Names of positional words in order; a repeatable last one takes all remaining words.
  std::vector<std::string> positional;
  bool last_is_repeatable = false;
};

// Parses the words. If --help is among them, prints the help and returns nothing. Adds --help and
// --json to every command. Throws UsageError for an unknown option (with the nearest known one), a
// missing value or a value that cannot be read, and what check_output_paths() throws if an output
// would replace an input.
std::optional<boost::program_options::variables_map> parse_words(
    CommandSyntax& syntax, const std::vector<std::string>& words, Streams& streams);

// "viscard" and the words, quoted for a shell; output files record it.
std::string quoted_command_line(const std::string& command, const std::vector<std::string>& words);

}  // namespace viscard
