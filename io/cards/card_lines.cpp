#include "io/cards/card_lines.h"

#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

// std::regex recurses once per character of a match; 100 kB overflow the stack.
constexpr std::size_t kLongestLine = 10000;

}  // namespace

std::vector<CardLine> card_lines(const std::string& text, const std::string& comment) {
  std::vector<CardLine> lines;
  std::istringstream stream(text);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.size() > kLongestLine) {
      throw std::runtime_error("line " + std::to_string(number) + ": has " +
                               std::to_string(line.size()) + " characters; a card has at most " +
                               std::to_string(kLongestLine));
    }
    if (trimmed(line).rfind(comment, 0) == 0) continue;
    lines.push_back({number, line});
  }
  return lines;
}

std::string upper(std::string_view text) {
  std::string out;
  for (const char c : text) {
    out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return out;
}

std::vector<std::string> cells(std::string_view line, char separator) {
  std::vector<std::string> out;
  for (const std::string_view part : split(line, separator)) out.emplace_back(trimmed(part));
  return out;
}

std::string at_line(const CardLine& line, const std::string& text) {
  return "line " + std::to_string(line.number) + ": " + text;
}

double card_number(const std::string& cell, const CardLine& line, const std::string& expected) {
  std::string text = cell;
  for (char& c : text) {
    if (c == 'D' || c == 'd') c = 'e';
  }
  // Fortran allows an exponent without its letter: "1.2-5".
  const std::size_t sign = text.find_first_of("+-", 1);
  if (sign != std::string::npos && text.find_first_of("eE") == std::string::npos) {
    text.insert(sign, "e");
  }
  if (const auto value = number_from_text(text)) return *value;
  throw std::runtime_error(
      at_line(line, "'" + cell + "' is not a number (" + expected + " expected)"));
}

double cell_number(const std::vector<std::string>& row, std::size_t index, const CardLine& line,
                   const std::string& expected) {
  if (index >= row.size()) {
    throw std::runtime_error(
        at_line(line, expected + " is missing (field " + std::to_string(index + 1) + ")"));
  }
  return card_number(row[index], line, expected);
}

int cell_integer(const std::vector<std::string>& row, std::size_t index, const CardLine& line,
                 const std::string& expected) {
  const double value = cell_number(row, index, line, expected);
  if (value >= 0.0 && value <= 1e6 && value == std::floor(value)) return static_cast<int>(value);
  throw std::runtime_error(at_line(
      line, "'" + row[index] + "' is not a whole number from 0 to 1000000 (" + expected + ")"));
}

double cell_number_or_zero(const std::vector<std::string>& row, std::size_t index,
                           const CardLine& line, const std::string& expected) {
  if (index >= row.size() || row[index].empty()) return 0.0;
  return card_number(row[index], line, expected);
}

}  // namespace viscard
