#pragma once

#include "io/options/option.h"
#include "io/results/result_schema.h"

#include <map>
#include <string>
#include <vector>

namespace viscard {

// The syntax of one command, for parsing and for --help.
struct CommandSyntax {
  const char* usage;        // "viscard fit FILE... [OPTIONS]"
  const char* description;  // one or two sentences; --help breaks them into lines
  const char* example;      // a command line that works as printed
  OptionList options;
  // The words without a name, in order. A list takes all that remain and, like a text, must be given; an
  // optional text need not be. "what" is a subcommand.
  OptionList positional;
  bool reads_quantities = true;  // has --plausible
  // The outputs that may exist already: folders, and files that are continued. All others are new files.
  std::vector<std::string> may_exist;
  // What --json prints, for schemas and tables of keys.
  std::vector<DescribedResult> results{};

  // Filled in by parse_words(): the values as typed of all that was given, and whether --json was.
  std::map<std::string, std::vector<std::string>> given{};
  bool as_json = false;
};

}  // namespace viscard
