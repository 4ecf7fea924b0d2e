#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// The first step of reading a table: from the bytes of a file to lines and cells.

struct TextLine {
  std::size_t number = 0;  // from 1
  std::string_view text;
};

// Iterates over the lines, which end in LF, CRLF or CR; skips blank lines and comments (#, %, //).
class LineReader {
 public:
  // first: number of its first line.
  explicit LineReader(std::string_view text, std::size_t first = 1)
      : rest_(text), number_(first - 1) {}
  bool next(TextLine& line);
  // The last comment before this line, without its mark: numpy writes the header there.
  std::string_view last_comment() const { return last_comment_; }

 private:
  std::string_view take_line();
  std::string_view rest_;
  const char* newline_ = nullptr;  // the next newline, or the end
  std::size_t number_ = 0;
  std::string_view last_comment_;
};

// The comments with which a text begins, without their marks.
std::vector<std::string> leading_comments(std::string_view text);

// The first line of a text with its end: LF, CRLF or CR.
std::string_view first_line(std::string_view text);

struct Dialect {
  char separator = ',';  // ' ' stands for any run of blanks
  bool has_decimal_comma = false;
  bool has_thousands_comma = false;  // "1,498,996.2", in quotes where commas separate the cells
  bool has_thousands_point = false;  // "1.498.996,2", beside decimal commas
};

// Returns the cells of a line, trimmed and without the quotes around them. Throws
// std::runtime_error with "line N" if a quote is not closed.
void split_cells(const TextLine& line, char separator, std::vector<std::string_view>& cells);

// Like split_cells(), but "Time (s)" is one cell even if blanks separate the cells.
std::vector<std::string_view> header_cells(const TextLine& line, char separator);

// Returns the number that a cell holds (NaN and infinities included), or nothing.
std::optional<double> number_from_cell(std::string_view cell, const Dialect& dialect);

// True for a cell that stands for a missing value: empty, "-", "NaN", "n/a", "#N/A", "null" ....
bool is_gap(std::string_view cell);

// Throws std::runtime_error naming the file if it mixes decimal points and decimal commas, or if "1,498" may
// be either of two numbers.
Dialect detect_dialect(const std::vector<TextLine>& sample, const std::string& name);

}  // namespace viscard
