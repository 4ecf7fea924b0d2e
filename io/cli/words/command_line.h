#pragma once

#include "io/cli/words/streams.h"

#include <boost/program_options.hpp>

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What one command understands, for parsing and for --help.
struct CommandSyntax {
  const char* usage;        // "viscard fit FILE... [OPTIONS]"
  const char* description;  // one or two sentences
  const char* example;      // a command line that works as printed
  boost::program_options::options_description options{"Options", 96};
  // Names of positional words in order; the last takes all that are left when it is repeatable.
  std::vector<std::string> positional;
  bool last_is_repeatable = false;
};

// Parses; prints the help and returns nothing when --help is among the words. Throws UsageError on
// an unknown option (with the nearest known one), a missing value or a value that cannot be read,
// and what check_output_paths throws: no output may replace an input.
// --help and --json are added to every command.
std::optional<boost::program_options::variables_map> parse_words(
    CommandSyntax& syntax, const std::vector<std::string>& words, Streams& streams);

// "viscard" and the words, quoted as a shell wants them: what every output file records.
std::string quoted_command_line(const std::string& command, const std::vector<std::string>& words);

}  // namespace viscard
