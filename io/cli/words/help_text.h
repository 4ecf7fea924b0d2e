#pragma once

#include "io/cli/words/command_syntax.h"

#include <string>
#include <vector>

namespace viscard {

// One option as help, manual pages and completion show it.
struct ShownOption {
  std::string name;                  // "out"
  std::string letter;                // "h"; empty: none
  std::string value;                 // "FILE", "arg"; empty: the option takes no value
  std::string initial;               // its default as text; empty: none
  std::string what;                  // the description
  std::vector<std::string> choices;  // the values that are allowed; empty: any
};
std::vector<ShownOption> shown_options(const CommandSyntax& syntax);

// What --help prints, in lines of at most so many characters; 0: 96.
std::string help_text(const CommandSyntax& syntax, std::size_t columns, bool is_coloured);

// The same as keys: usage, description, example, options.
void show_keys(ResultVisitor& v, const CommandSyntax& syntax);

}  // namespace viscard
