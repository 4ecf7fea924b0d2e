#pragma once

#include "io/cards/card_lines.h"
#include "io/cards/card_numbers.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace viscard {

struct ReadCard;

// Named values in program-like texts: MFront, MOOSE, FEBio. Readers throw std::runtime_error.

// The line of a place in the text, for messages.
CardLine line_of(const std::string& text, std::size_t at);
std::string without_line_comments(const std::string& text, const std::string& comment);

// A second match of the pattern is a mistake, "second-element": the solver takes one of them, or both.
void check_single_element(const std::string& text, const std::string& pattern, const char* name,
                          ReadCard& card);

// Numbers of a list in a program, with brackets of any kind: "[[0.4, 2]]", "{1, 2}", "'1 2'", "0.4".
std::vector<double> numbers_of_list(const std::string& list, const CardLine& line);

using NamedNumbers = std::map<std::string, std::vector<double>>;

// All matches of the regular expression: its first group is the name, its second the numbers.
NamedNumbers named_lists(const std::string& text, const std::string& pattern);
// Throws unless there is exactly one number of that name.
double one_of(const NamedNumbers& named, const std::string& name);
// Empty if there is no such name. Throws unless it has the expected length.
const std::vector<double>& list_of(const NamedNumbers& named, const std::string& name,
                                   std::size_t expected);

// The numbers of all branches, between the separators.
std::string joined(const std::vector<CardBranch>& branches, double CardBranch::*member,
                   const char* separator);

}  // namespace viscard
