#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Builds one plain table of a file with several parts. Its columns are those of all parts; a cell
// that a part does not have stays empty.
class TableParts {
 public:
  // The next part. Columns of equal name and unit are one column.
  void begin(const std::string& segment, const std::vector<std::string>& names,
             const std::vector<std::string>& units);
  // Cells of a row, in the order of the part's columns; one more or one less is refused with its line.
  void row(const std::vector<std::string_view>& cells);
  void other_line() { lines_.emplace_back("#"); }  // a line of the file that is not a row
  bool has_part() const { return !segment_.empty(); }
  std::size_t n_columns() const { return places_.size(); }

  // The table. The header stands in the last line before the first row.
  std::string text() const;

 private:
  std::vector<std::string> headers_;  // "name [unit]"
  std::vector<std::size_t> places_;   // of the part's columns among all
  std::string segment_;
  std::vector<std::string> segments_;  // of all parts
  std::vector<std::string> lines_;
  std::vector<std::size_t> widths_;  // cells of each line; 0: a comment
  std::size_t first_row_ = 0;        // line, from 0
  bool has_row_ = false;
};

// Takes the next line off the text, without its end.
std::string_view take_line(std::string_view& text);

// Cells between separators, trimmed and without quotes around them.
std::vector<std::string_view> plain_cells(std::string_view line, char separator);

// Words between blanks and tabs.
std::vector<std::string_view> plain_words(std::string_view line);

}  // namespace viscard
