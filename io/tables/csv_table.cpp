#include "io/tables/csv_table.h"

#include "io/basics/units.h"
#include "io/tables/csv_dialect.h"
#include "io/tables/csv_header.h"
#include "io/tables/maker_table.h"
#include "io/tables/table_rows.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

constexpr std::size_t kSampleLines = 200;

std::string without_doubled_quotes(std::string_view cell) {
  std::string out;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    out += cell[i];
    if (cell[i] == '"' && i + 1 < cell.size() && cell[i + 1] == '"') ++i;
  }
  return out;
}

class TableReader {
 public:
  TableReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    table_.file = name_;
  }

  CsvTable read() {
    take_sample();
    dialect_ = detect_dialect(sample_, name_);
    table_.separator = dialect_.separator;
    table_.has_decimal_comma = dialect_.has_decimal_comma;
    find_width();
    read_head();
    read_rows();
    drop_empty_edge_columns();
    return std::move(table_);
  }

 private:
  void take_sample() {
    LineReader lines(text_);
    TextLine line;
    while (sample_.size() < kSampleLines && lines.next(line)) sample_.push_back(line);
    if (sample_.empty()) {
      throw std::runtime_error(name_ + ": is empty; expected a table of numbers");
    }
  }

  bool has_number(const std::vector<std::string_view>& cells) const {
    return std::any_of(cells.begin(), cells.end(), [&](std::string_view cell) {
      return number_from_cell(cell, dialect_).has_value();
    });
  }

  // Finds the number of cells that most lines with numbers have, and how many of them are empty at
  // the end of all these lines.
  void find_width() {
    std::map<std::size_t, std::size_t> counts;
    std::vector<std::string_view> cells;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      if (!has_number(cells)) continue;
      ++counts[cells.size()];
      width_ = cells.size();  // the last line wins a tie, because notes come first
    }
    if (counts.empty()) {
      throw std::runtime_error(name_ + ": has no line with a number in its first " +
                               counted(sample_.size(), "line") + "; expected a table of numbers");
    }
    for (const auto& [width, count] : counts) {
      if (count > counts[width_]) width_ = width;
    }
    n_empty_end_ = width_;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      if (!has_number(cells) || cells.size() != width_) continue;
      std::size_t n_empty = 0;
      while (n_empty < width_ && cells[width_ - 1 - n_empty].empty()) ++n_empty;
      n_empty_end_ = std::min(n_empty_end_, n_empty);
    }
  }

  // Without the empty cells that separators at the end of a line make.
  void fit_to_width(std::vector<std::string_view>& cells) const {
    while (cells.size() > width_ && cells.back().empty()) cells.pop_back();
  }

  // The names or units of a line, with the empty cells at the end that only lines of numbers have.
  std::vector<std::string_view> names_of(const TextLine& line) const {
    std::vector<std::string_view> names = header_cells(line, dialect_.separator);
    fit_to_width(names);
    const bool is_short = names.size() < width_ && names.size() + n_empty_end_ >= width_;
    if (is_short && !names.empty() && !names.back().empty()) names.resize(width_);
    return names;
  }

  static bool are_empty(const std::vector<std::string_view>& cells) {
    return std::all_of(cells.begin(), cells.end(),
                       [](std::string_view cell) { return cell.empty(); });
  }

  // The line of the header: the line of text above a row of units, or else the first one, with as
  // many cells as the table. A short table of results may stand before the record: its rows are
  // notes if a later header has units below it and three times as many rows. 0: no header.
  std::size_t header_line() const {
    struct Run {
      std::size_t header = 0, last_text = 0, n_rows = 0;
      bool has_units = false;
    };
    Run chosen, run;
    std::vector<std::string_view> cells;
    const auto choose = [&] {
      const bool is_record = run.has_units && run.n_rows > 3 * chosen.n_rows;
      if (run.n_rows > 0 && (chosen.n_rows == 0 || is_record)) chosen = run;
    };
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      const std::vector<std::string_view> names = names_of(line);
      fit_to_width(cells);
      if (has_number(cells)) {
        if (cells.size() == width_) ++run.n_rows;
        continue;
      }
      if (names.size() != width_ || are_empty(names)) continue;
      if (run.n_rows > 0) {
        choose();
        run = {};
      }
      if (run.last_text != 0 && !run.has_units && is_row_of_units(names)) {
        run.header = run.last_text;
        run.has_units = true;
      } else {
        if (run.header == 0) run.header = line.number;
        run.last_text = line.number;
      }
    }
    choose();
    return chosen.header;
  }

  // Reads the notes, the header and the units; leaves first_row_ at the first line of numbers.
  void read_head() {
    table_.columns.resize(width_);
    const std::size_t header = header_line();
    LineReader lines(text_);
    TextLine line;
    std::vector<std::string_view> cells;
    bool has_units = false;
    while (lines.next(line)) {
      split_cells(line, dialect_.separator, cells);
      const std::vector<std::string_view> names = names_of(line);
      fit_to_width(cells);
      const bool is_text = !has_number(cells);
      if (line.number > header && header != 0 && are_empty(cells)) continue;
      if (line.number == header) {
        take_header(names);
      } else if (is_text && table_.has_header && !has_units && is_row_of_units(names)) {
        has_units = true;
        take_units(names);
      } else if (line.number < header ||
                 (header == 0 && (is_text || (cells.size() != width_ && !is_all_numbers(cells))))) {
        table_.preamble.emplace_back(line.text);
      } else {
        break;
      }
    }
    first_line_ = line.number;
    first_at_ = static_cast<std::size_t>(line.text.data() - text_.data());
    while (first_at_ > 0 && text_[first_at_ - 1] != '\n' && text_[first_at_ - 1] != '\r') {
      --first_at_;
    }
    if (!table_.has_header) take_header_from_comment(lines.last_comment());
    for (CsvColumn& column : table_.columns) {
      if (!column.unit.empty()) continue;
      const HeaderParts parts = split_header(column.header);
      column.name = parts.name;
      column.unit = parts.unit;
    }
  }

  bool is_all_numbers(const std::vector<std::string_view>& cells) const {
    return std::all_of(cells.begin(), cells.end(), [&](std::string_view cell) {
      return number_from_cell(cell, dialect_).has_value();
    });
  }

  void take_header(const std::vector<std::string_view>& names) {
    table_.has_header = true;
    std::string whole;
    for (const std::string_view name : names) whole += std::string(name) + "\t";
    table_.maker = maker_of_header(whole);
    for (std::size_t i = 0; i < width_; ++i) {
      table_.columns[i].header = without_doubled_quotes(names[i]);
      table_.columns[i].name = table_.columns[i].header;
    }
  }

  bool is_row_of_units(const std::vector<std::string_view>& cells) const {
    return cells.size() == width_ && !are_empty(cells) &&
           std::all_of(cells.begin(), cells.end(),
                       [](std::string_view cell) { return is_unit(without_brackets(cell)); });
  }

  void take_units(const std::vector<std::string_view>& cells) {
    for (std::size_t i = 0; i < width_; ++i) {
      table_.columns[i].unit = std::string(without_brackets(cells[i]));
    }
  }

  void take_header_from_comment(std::string_view comment) {
    if (comment.empty()) return;
    try {
      const auto names = header_cells({0, comment}, dialect_.separator);
      if (names.size() == width_ && !has_number(names)) take_header(names);
    } catch (const std::runtime_error&) {
      // A comment may contain a single quote.
    }
  }

  void read_rows() {
    const auto guess = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n')) + 1;
    for (CsvColumn& column : table_.columns) column.values.reserve(guess);
    is_text_ =
        append_rows(text_, {first_at_, first_line_}, dialect_, name_, table_.columns, table_.lines);
    const bool has_text =
        std::any_of(is_text_.begin(), is_text_.end(), [](char is) { return is != 0; });
    if (!has_text) return;
    for_each_row([&](const TextLine&, const std::vector<std::string_view>& cells) {
      for (std::size_t i = 0; i < width_; ++i) {
        if (is_text_[i] != 0) table_.columns[i].text.push_back(without_doubled_quotes(cells[i]));
      }
    });
  }

  template <typename Take>
  void for_each_row(Take take) {
    LineReader lines(text_);
    TextLine line;
    std::vector<std::string_view> cells;
    while (lines.next(line)) {
      if (line.number < first_line_) continue;
      row_cells(line, dialect_, width_, name_, cells);
      take(line, cells);
    }
  }

  static bool is_empty(const CsvColumn& column) {
    return column.header.empty() && column.text.empty() &&
           std::all_of(column.values.begin(), column.values.end(),
                       [](double value) { return std::isnan(value); });
  }

  // Lines that begin or end with a separator make empty first and last columns.
  void drop_empty_edge_columns() {
    std::vector<CsvColumn>& columns = table_.columns;
    while (columns.size() > 1 && is_empty(columns.back())) columns.pop_back();
    if (columns.size() > 1 && is_empty(columns.front())) columns.erase(columns.begin());
  }

  std::string_view text_;
  std::string name_;
  CsvTable table_;
  Dialect dialect_;
  std::vector<TextLine> sample_;
  std::vector<char> is_text_;
  std::size_t width_ = 0;
  std::size_t n_empty_end_ = 0;
  std::size_t first_line_ = 0;  // of numbers: its number from 1, and ...
  std::size_t first_at_ = 0;    // ... the character at which it begins
};

}  // namespace

CsvTable plain_table(std::string_view text, const std::string& name) {
  return TableReader(text, name).read();
}

}  // namespace viscard
