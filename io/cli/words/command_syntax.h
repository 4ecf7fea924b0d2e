#pragma once

#include <boost/program_options.hpp>

#include <map>
#include <string>
#include <vector>

namespace viscard {

// The syntax of one command, for parsing and for --help.
struct CommandSyntax {
  const char* usage;        // "viscard fit FILE... [OPTIONS]"
  const char* description;  // one or two sentences; --help breaks them into lines
  const char* example;      // a command line that works as printed
  boost::program_options::options_description options{"Options", 96};
  // Names of positional words in order; a repeatable last one takes all remaining words.
  std::vector<std::string> positional;
  bool last_is_repeatable = false;
  bool reads_quantities = true;  // has --plausible
  // The values that an option or a positional word may have, for help and completion.
  std::map<std::string, std::vector<std::string>> choices;
  // The outputs that may exist already: folders, and files that are continued. All others are new files.
  std::vector<std::string> may_exist;
};

}  // namespace viscard
