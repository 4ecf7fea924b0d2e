#include "io/tables/table_rows.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace viscard {
namespace {

const char* past_blanks(const char* at, const char* end, bool with_tabs) {
  while (at < end && (*at == ' ' || (with_tabs && *at == '\t'))) ++at;
  return at;
}

// Reads one row of plain finite numbers: `values` of them, with the separator between them and blanks
// around them, up to the end of the line (LF or CRLF). Most lines of a long record are such rows, and
// this takes a third of the time of dividing them into cells first. Returns the number of characters
// read, with the end of the line, or 0 if the line is anything else; the values are then undefined.
std::size_t take_quick_row(std::string_view text, const Dialect& dialect,
                           std::vector<double>& values) {
  const bool by_blanks = dialect.separator == ' ';
  const bool with_tabs = dialect.separator != '\t';
  const fast_float::parse_options options(fast_float::chars_format::general,
                                          dialect.has_decimal_comma ? ',' : '.');
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const char* at = begin;
  for (std::size_t i = 0; i < values.size(); ++i) {
    at = past_blanks(at, end, with_tabs);
    if (i > 0 && !by_blanks) {
      if (at == end || *at != dialect.separator) return 0;
      at = past_blanks(at + 1, end, with_tabs);
    }
    const char* const from = at;
    const auto [next, error] = fast_float::from_chars_advanced(at, end, values[i], options);
    if (error != std::errc() || !std::isfinite(values[i])) return 0;
    if (by_blanks && i > 0 && (from == begin || (from[-1] != ' ' && from[-1] != '\t'))) return 0;
    at = next;
  }
  at = past_blanks(at, end, /*with_tabs=*/true);
  if (at < end && *at == '\r') ++at;
  if (at == end) return static_cast<std::size_t>(at - begin);
  return *at == '\n' ? static_cast<std::size_t>(at + 1 - begin) : 0;
}

// Returns true if the cell is text.
bool add_value(std::string_view cell, std::size_t line, const Dialect& dialect, CsvColumn& column) {
  const auto number = number_from_cell(cell, dialect);
  const bool is_good = number && std::isfinite(*number);
  column.values.push_back(is_good ? *number : std::numeric_limits<double>::quiet_NaN());
  if (is_good) return false;
  if (column.first_bad_line == 0) {
    column.first_bad_line = line;
    column.first_bad_cell = std::string(cell.substr(0, 40));
  }
  return !cell.empty() && !number;
}

}  // namespace

void row_cells(const TextLine& line, const Dialect& dialect, std::size_t width,
               const std::string& name, std::vector<std::string_view>& cells) {
  split_cells(line, dialect.separator, cells);
  const bool has_more =
      std::any_of(cells.begin() + static_cast<std::ptrdiff_t>(std::min(width, cells.size())),
                  cells.end(), [](auto cell) { return !cell.empty(); });
  if (cells.size() >= width && !has_more) return;
  throw std::runtime_error(name + ":" + std::to_string(line.number) + ": " +
                           std::to_string(cells.size()) + " cells, but the table has " +
                           std::to_string(width) + " columns");
}

RowsRead append_rows(
    std::string_view text, RowPlace from, const Dialect& dialect, const std::string& name,
    std::vector<CsvColumn>& columns, LineNumbers& lines,
    const std::function<bool(const TextLine&, const std::vector<std::string_view>&)>& is_end) {
  const std::size_t width = columns.size();
  RowsRead read{std::vector<char>(width, 0), from};
  std::vector<double> values(width);
  std::vector<std::string_view> cells;
  RowPlace& at = read.next;
  for (; at.at < text.size(); ++at.line) {
    if (const std::size_t taken = take_quick_row(text.substr(at.at), dialect, values)) {
      at.at += taken;
      lines.push_back(static_cast<std::uint32_t>(at.line));
      for (std::size_t i = 0; i < width; ++i) columns[i].values.push_back(values[i]);
      continue;
    }
    const std::string_view whole = first_line(text.substr(at.at));
    LineReader one(whole, at.line);
    TextLine line;
    if (one.next(line)) {  // neither blank nor a comment
      split_cells(line, dialect.separator, cells);
      const bool is_blank = std::all_of(cells.begin(), cells.end(),
                                        [](std::string_view cell) { return cell.empty(); });
      if (!is_blank && is_end(line, cells)) return read;
      if (!is_blank) {
        row_cells(line, dialect, width, name, cells);
        lines.push_back(static_cast<std::uint32_t>(at.line));
        for (std::size_t i = 0; i < width; ++i) {
          if (add_value(cells[i], at.line, dialect, columns[i])) read.is_text[i] = 1;
        }
      }
    }
    at.at += whole.size();
  }
  return read;
}

}  // namespace viscard
