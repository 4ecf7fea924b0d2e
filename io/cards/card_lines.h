#pragma once

#include "models/maths/text_of_number.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Lines, cells and numbers of a card's text. All readers use them, and trimmed() of
// models/maths/text_of_number.h.
struct CardLine {
  int number = 0;  // 1-based
  std::string text;
};

// All lines except those that start with the comment sign, blanks before it ignored. Throws
// std::runtime_error for a line of more than 10000 characters.
std::vector<CardLine> card_lines(const std::string& text, const std::string& comment);

std::string upper(std::string_view text);
// Cells between separators, blanks trimmed; "a, b," gives {"a", "b", ""}.
std::vector<std::string> cells(std::string_view line, char separator);

// "line 7: text"
std::string at_line(const CardLine& line, const std::string& text);

// A number as solvers read it: "1.88", ".5", "1D-3", "1.2-5" (Fortran). Throws
// std::runtime_error "line 7: 'abc' is not a number (g_i expected)".
double card_number(const std::string& cell, const CardLine& line, const std::string& expected);
double cell_number(const std::vector<std::string>& row, std::size_t index, const CardLine& line,
                   const std::string& expected);
// A whole number from 0 to 1000000. Throws for another.
int cell_integer(const std::vector<std::string>& row, std::size_t index, const CardLine& line,
                 const std::string& expected);
// 0 where the cell is missing or blank.
double cell_number_or_zero(const std::vector<std::string>& row, std::size_t index,
                           const CardLine& line, const std::string& expected);

}  // namespace viscard
