#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Parts of csv_table.cpp: from the bytes of a file to lines and cells.

// Bytes of UTF-8 (BOM or not), UTF-16 or Latin-1 as UTF-8. Throws std::runtime_error naming the
// file when there are NUL bytes in it, so that it is no text.
std::string utf8_from_bytes(std::string_view bytes, const std::string& name);

struct TextLine {
  std::size_t number = 0;  // from 1
  std::string_view text;
};

// Goes through the lines, whatever ends them; skips blank ones and comments (#, %, //).
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  bool next(TextLine& line);
  // The last comment met, without its mark: tables made by numpy keep their header there.
  std::string_view last_comment() const { return last_comment_; }

 private:
  std::string_view take_line();
  std::string_view rest_;
  const char* newline_ = nullptr;  // the next one, or the end
  std::size_t number_ = 0;
  std::string_view last_comment_;
};

struct Dialect {
  char separator = ',';  // ' ' for runs of blanks
  bool has_decimal_comma = false;
};

// Cells of a line, trimmed, without the quotes around them. Throws std::runtime_error with "line N"
// when a quote is not closed.
void split_cells(const TextLine& line, char separator, std::vector<std::string_view>& cells);

// Like split_cells(), but with blanks as separators "Time (s)" is one cell.
std::vector<std::string_view> header_cells(const TextLine& line, char separator);

// A number written in the dialect, NaN and infinities included; nothing for anything else.
std::optional<double> number_from_cell(std::string_view cell, const Dialect& dialect);

// Throws std::runtime_error naming the file when decimal points and commas are mixed.
Dialect detect_dialect(const std::vector<TextLine>& sample, const std::string& name);

std::string_view trimmed_cell(std::string_view text);

}  // namespace viscard
