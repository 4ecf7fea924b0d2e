#pragma once

#include "io/cli/words/command_syntax.h"

#include <string>
#include <vector>

namespace viscard {

// What stands for the value of an option: "FILE", "arg"; empty: a switch.
std::string value_of(const Option& option);
// Its short form, "h" of --help; empty: none.
std::string letter_of(const Option& option);

// What --help prints, in lines of at most so many characters; 0: 96.
std::string help_text(const CommandSyntax& syntax, std::size_t columns, bool is_coloured);

// The same as keys: usage, description, example, options.
void show_keys(ResultVisitor& v, const CommandSyntax& syntax);

}  // namespace viscard
