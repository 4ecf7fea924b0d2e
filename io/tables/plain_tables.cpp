#include "io/tables/plain_tables.h"

#include "io/basics/units.h"
#include "io/tables/clock_times.h"
#include "io/tables/csv_dialect.h"
#include "io/tables/csv_header.h"
#include "io/tables/known_names.h"
#include "io/tables/log_columns.h"
#include "io/tables/maker_table.h"
#include "io/tables/table_rows.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

using Cells = std::vector<std::string_view>;

std::string without_doubled_quotes(std::string_view cell) {
  std::string out;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    out += cell[i];
    if (cell[i] == '"' && i + 1 < cell.size() && cell[i + 1] == '"') ++i;
  }
  return out;
}

bool are_empty(const Cells& cells) {
  return std::all_of(cells.begin(), cells.end(),
                     [](std::string_view cell) { return cell.empty(); });
}

// A line that may be a row of numbers, by its first character.
bool begins_with_number(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t\"+-.,;");
  return at != std::string_view::npos && line[at] >= '0' && line[at] <= '9';
}

// Reads one table: notes, a header, a row of units, rows. The block of numbers is found first, by the
// cells that most lines fill with numbers; what stands above it are its header, its units and notes.
class TableReader {
 public:
  // reserves: space for as many rows as the text has lines. A file of thousands of tables would ask for it
  // thousands of times.
  TableReader(std::string_view text, std::string name, RowPlace begin, bool reserves,
              KnownNames& known_names)
      : text_(text),
        name_(std::move(name)),
        begin_(begin),
        reserves_(reserves),
        known_names_(known_names) {
    table_.file = name_;
  }

  CsvTable read() {
    take_sample();
    dialect_ = detect_dialect(sample_, name_);
    table_.separator = dialect_.separator;
    table_.has_decimal_comma = dialect_.has_decimal_comma;
    find_width();
    find_number_columns();
    read_head();
    read_rows();
    drop_empty_edge_columns();
    read_clock_times(table_);
    take_antilogarithms(table_);
    return std::move(table_);
  }

  // After read(): where the next table of the text may begin; its end if none does.
  RowPlace next() const { return next_; }

 private:
  // Enough lines to see the rows, also below long notes.
  void take_sample() {
    constexpr std::size_t kLines = 200, kMost = 5000;
    LineReader lines(text_.substr(begin_.at), begin_.line);
    TextLine line;
    std::size_t n_numbers = 0;
    while (sample_.size() < kLines || (sample_.size() < kMost && 2 * n_numbers < sample_.size())) {
      if (!lines.next(line)) break;
      sample_.push_back(line);
      if (begins_with_number(line.text)) ++n_numbers;
    }
    if (sample_.empty()) {
      throw std::runtime_error(name_ + ": is empty; expected a table of numbers");
    }
  }

  bool is_number(std::string_view cell) const {
    return number_from_cell(cell, dialect_).has_value();
  }
  std::size_t n_numbers(const Cells& cells) const {
    return static_cast<std::size_t>(std::count_if(
        cells.begin(), cells.end(), [&](std::string_view cell) { return is_number(cell); }));
  }

  // Finds the number of cells that most lines with numbers have, and how many of them are empty at
  // the end of all these lines.
  void find_width() {
    std::map<std::size_t, std::size_t> counts;
    Cells cells;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      const std::size_t found = n_numbers(cells);
      if (found == 0) continue;
      counts[cells.size()] += found;
      width_ = cells.size();  // the last line wins a tie, because notes come first
    }
    if (counts.empty()) {
      throw std::runtime_error(name_ + ": has no line with a number in its " +
                               (sample_.size() > 1 ? "first " + counted(sample_.size(), "line")
                                                   : std::string("only line")) +
                               "; expected a table of numbers");
    }
    for (const auto& [width, count] : counts) {
      if (count > counts[width_]) width_ = width;
    }
    n_empty_end_ = width_;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      if (n_numbers(cells) == 0 || cells.size() != width_) continue;
      std::size_t n_empty = 0;
      while (n_empty < width_ && cells[width_ - 1 - n_empty].empty()) ++n_empty;
      n_empty_end_ = std::min(n_empty_end_, n_empty);
    }
  }

  // The columns in which most of the lines with most numbers have a number.
  void find_number_columns() {
    std::map<std::size_t, std::size_t> lines_with;
    Cells cells;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      fit_to_width(cells);
      if (cells.size() == width_) ++lines_with[n_numbers(cells)];
    }
    lines_with.erase(0);
    std::size_t typical = 1, most = 0;
    for (const auto& [count, n_lines] : lines_with) {
      if (count * n_lines < most) continue;
      most = count * n_lines;
      typical = count;
    }
    std::vector<std::size_t> filled(width_, 0);
    std::size_t n_lines = 0;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      fit_to_width(cells);
      if (cells.size() != width_ || n_numbers(cells) < typical) continue;
      ++n_lines;
      for (std::size_t i = 0; i < width_; ++i) filled[i] += is_number(cells[i]) ? 1 : 0;
    }
    counts_rows_ = first_column_counts();
    has_numbers_.assign(width_, 0);
    for (std::size_t i = 0; i < width_; ++i) has_numbers_[i] = 2 * filled[i] > n_lines ? 1 : 0;
  }

  // The first column has the numbers of the rows.
  bool first_column_counts() const {
    std::optional<double> last;
    Cells cells;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      const auto number =
          cells.size() == width_ ? number_from_cell(cells.front(), dialect_) : std::nullopt;
      if (!number) continue;
      if (last && *number != *last + 1.0) return false;
      last = number;
    }
    return last.has_value();
  }

  // Without the empty cells that separators at the end of a line make.
  void fit_to_width(Cells& cells) const {
    while (cells.size() > width_ && cells.back().empty()) cells.pop_back();
  }

  // A row: numbers, or gaps, in all columns of numbers, and at least one number.
  bool is_row(const Cells& cells) const {
    if (cells.size() != width_) return false;
    bool has_one = false;
    for (std::size_t i = 0; i < width_; ++i) {
      if (has_numbers_[i] == 0) continue;
      if (!is_number(cells[i]) && !is_gap(cells[i])) return false;
      has_one = has_one || is_number(cells[i]);
    }
    return has_one;
  }

  // The names or units of a line, with the empty cells at the end that only lines of numbers have.
  // One more name than columns at the end, such as "Comment", belongs to no numbers.
  Cells names_of(const TextLine& line) const {
    Cells names = header_cells(line, dialect_.separator);
    fit_to_width(names);
    const bool is_short = names.size() < width_ && names.size() + n_empty_end_ >= width_;
    if (is_short && !names.empty() && !names.back().empty()) names.resize(width_);
    if (names.size() + 1 == width_ && counts_rows_ && n_known(names) > 0) {
      names.insert(names.begin(), std::string_view());  // as R writes names of rows
    }
    if (names.size() == width_ + 1 && n_known({names.back()}) == 0 && n_known(names) > 1) {
      names.pop_back();
    }
    return names;
  }

  // The names that belong to a quantity.
  std::size_t n_known(const Cells& names) const {
    return static_cast<std::size_t>(std::count_if(
        names.begin(), names.end(),
        [&](std::string_view name) { return known_names_.has(without_doubled_quotes(name)); }));
  }

  bool is_row_of_units(const Cells& cells) const {
    return cells.size() == width_ && !are_empty(cells) &&
           std::all_of(cells.begin(), cells.end(),
                       [](std::string_view cell) { return is_unit(without_brackets(cell)); });
  }

  // A row of units of which some are not known: a column is not read rather than in a wrong unit.
  bool is_mostly_units(const Cells& cells) const {
    std::size_t n_filled = 0, n_units = 0;
    for (const std::string_view cell : cells) {
      if (cell.empty()) continue;
      ++n_filled;
      n_units += is_unit(without_brackets(cell)) ? 1 : 0;
    }
    return cells.size() == width_ && 2 * n_units >= n_filled && n_units > 0;
  }

  struct Head {
    std::size_t header = 0, units = 0, first_row = 0;  // numbers of lines; 0: none
  };

  // Of the lines of text above the first row, the header is the one with most names of quantities, else
  // with fewest empty cells, else the last. A row of units may follow it.
  Head find_head() const {
    Head head;
    struct Line {
      std::size_t number = 0;
      Cells names;
      std::size_t known = 0, filled = 0;
    };
    std::vector<Line> lines;
    Cells cells;
    for (const TextLine& line : sample_) {
      split_cells(line, dialect_.separator, cells);
      fit_to_width(cells);
      const auto n_columns = std::count(has_numbers_.begin(), has_numbers_.end(), 1);
      if (is_row(cells) && 2 * n_numbers(cells) >= static_cast<std::size_t>(n_columns)) {
        head.first_row = line.number;
        break;
      }
      Line one{line.number, names_of(line), 0, 0};
      if (one.names.size() != width_ || are_empty(one.names) || n_numbers(cells) > 0) continue;
      one.known = n_known(one.names);
      one.filled = width_ - static_cast<std::size_t>(
                                std::count(one.names.begin(), one.names.end(), std::string_view()));
      lines.push_back(std::move(one));
    }
    const Line* best = nullptr;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const bool is_below_names = i > 0 && (lines[i - 1].known > 0 || lines[i].known < width_);
      const bool is_units = is_row_of_units(lines[i].names) ||
                            (lines[i].known == 0 && is_mostly_units(lines[i].names));
      if (is_below_names && is_units) continue;
      const auto rank = [](const Line& line) { return std::pair(line.known, line.filled); };
      if (best == nullptr || rank(lines[i]) >= rank(*best)) best = &lines[i];
    }
    if (best == nullptr) return head;
    head.header = best->number;
    for (const Line& line : lines) {
      const bool is_units =
          line.number > head.header && head.units == 0 && is_mostly_units(line.names);
      if (is_units) head.units = line.number;
    }
    // In a table with columns of text this may be a row whose number is bad.
    const bool has_text = std::count(has_numbers_.begin(), has_numbers_.end(), 0) > 0;
    for (const Line& line : lines) {
      const bool is_below = line.number > std::max(head.header, head.units);
      if (is_below && has_text) {
        head.first_row = line.number;
        break;
      }
    }
    return head;
  }

  // Reads the notes, the header and the units; leaves first_ at the first line of numbers.
  void read_head() {
    table_.columns.resize(width_);
    const Head head = find_head();
    if (head.first_row == 0) {
      throw std::runtime_error(name_ + ": has no row of numbers in its first " +
                               counted(sample_.size(), "line") +
                               "; omit lines above the table with --skip N");
    }
    LineReader lines(text_.substr(begin_.at), begin_.line);
    TextLine line;
    while (lines.next(line) && line.number != head.first_row) {
      if (line.number == head.header) {
        take_header(names_of(line));
      } else if (line.number == head.units) {
        take_units(names_of(line));
      } else if (!are_empty(cells_of(line)) && (head.header == 0 || line.number < head.header)) {
        table_.preamble.emplace_back(line.text);
      } else if (!are_empty(cells_of(line))) {
        table_.notes.push_back("line " + std::to_string(line.number) +
                               " between the header and the rows was left out: '" +
                               std::string(line.text.substr(0, 60)) + "'");
      }
    }
    first_ = {static_cast<std::size_t>(line.text.data() - text_.data()), line.number};
    while (first_.at > 0 && text_[first_.at - 1] != '\n' && text_[first_.at - 1] != '\r') {
      --first_.at;
    }
    if (!table_.has_header) take_header_from_comment(lines.last_comment());
    for (CsvColumn& column : table_.columns) {
      if (!column.unit.empty()) continue;
      const HeaderParts parts = split_header(column.header);
      column.name = parts.name;
      column.unit = parts.unit;
    }
  }

  Cells cells_of(const TextLine& line) const {
    Cells cells;
    split_cells(line, dialect_.separator, cells);
    return cells;
  }

  void take_header(const Cells& names) {
    table_.has_header = true;
    std::string whole;
    for (const std::string_view name : names) whole += std::string(name) + "\t";
    table_.maker = maker_of_header(whole);
    for (std::size_t i = 0; i < width_; ++i) {
      table_.columns[i].header = without_doubled_quotes(names[i]);
      table_.columns[i].name = table_.columns[i].header;
    }
  }

  void take_units(const Cells& cells) {
    for (std::size_t i = 0; i < width_; ++i) {
      table_.columns[i].unit = std::string(without_brackets(cells[i]));
    }
  }

  void take_header_from_comment(std::string_view comment) {
    if (comment.empty()) return;
    try {
      const auto names = header_cells({0, comment}, dialect_.separator);
      if (names.size() == width_ && n_numbers(names) == 0) take_header(names);
    } catch (const std::runtime_error&) {
      // A comment may contain a single quote.
    }
  }

  // The rows end where a line is none and nothing but text follows, or where another header follows.
  // Any other line stays a row, whose bad cell is refused if its column is used.
  bool ends_before(const TextLine& line) {
    if (line.number < no_end_before_) return false;
    LineReader lines(text_.substr(static_cast<std::size_t>(line.text.data() - text_.data())),
                     line.number);
    TextLine next;
    while (lines.next(next)) {
      Cells cells = cells_of(next);
      fit_to_width(cells);
      if (is_row(cells)) {
        no_end_before_ = next.number;
        return false;
      }
      if (n_numbers(cells) > 0) continue;
      const Cells names = header_cells(next, dialect_.separator);
      if (names.size() > 1 && n_known(names) > 0) return true;
    }
    return true;
  }

  // A line whose first column of numbers has a word in it.
  bool begins_with_word(Cells cells) const {
    fit_to_width(cells);
    const auto first = static_cast<std::size_t>(
        std::find(has_numbers_.begin(), has_numbers_.end(), 1) - has_numbers_.begin());
    return first < cells.size() && !is_number(cells[first]) && !is_gap(cells[first]);
  }

  void read_rows() {
    if (reserves_) {
      const auto guess = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n')) + 1;
      for (CsvColumn& column : table_.columns) column.values.reserve(guess);
    }
    const auto is_end = [&](const TextLine& line, const Cells& cells) {
      return (n_numbers(cells) == 0 || begins_with_word(cells)) && ends_before(line);
    };
    const RowsRead rows =
        append_rows(text_, first_, dialect_, name_, table_.columns, table_.lines, is_end);
    next_ = rows.next;
    if (std::none_of(rows.is_text.begin(), rows.is_text.end(), [](char is) { return is != 0; })) {
      return;
    }
    LineReader lines(text_.substr(first_.at, next_.at - first_.at), first_.line);
    TextLine line;
    Cells cells;
    while (lines.next(line)) {
      row_cells(line, dialect_, width_, name_, cells);
      if (are_empty(cells)) continue;
      for (std::size_t i = 0; i < width_; ++i) {
        if (rows.is_text[i] != 0)
          table_.columns[i].text.push_back(without_doubled_quotes(cells[i]));
      }
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
  RowPlace begin_, first_, next_;
  bool reserves_;
  KnownNames& known_names_;  // of the file
  CsvTable table_;
  Dialect dialect_;
  std::vector<TextLine> sample_;
  std::vector<char> has_numbers_;  // by column
  bool counts_rows_ = false;       // the first column numbers the rows
  std::size_t width_ = 0;
  std::size_t n_empty_end_ = 0;
  std::size_t no_end_before_ = 0;  // a line of a row: no line before it ends the table
};

bool has_number_line(std::string_view text) {
  LineReader lines(text, 1);
  for (TextLine line; lines.next(line);) {
    if (line.text.find_first_of("0123456789") != std::string_view::npos) return true;
  }
  return false;
}

// The place after the first lines, which are not read.
RowPlace place_after(std::string_view text, std::size_t n_lines) {
  RowPlace place;
  for (; place.line <= n_lines && place.at < text.size(); ++place.line) {
    place.at += first_line(text.substr(place.at)).size();
  }
  return place;
}

}  // namespace

std::vector<CsvTable> plain_tables(std::string_view text, const std::string& name,
                                   std::size_t skip) {
  std::vector<CsvTable> tables;
  KnownNames known_names;
  RowPlace place = place_after(text, skip);
  if (skip > 0 && place.at >= text.size()) {
    throw std::runtime_error(name + ": has fewer than " + counted(skip, "line") +
                             "; give a smaller --skip");
  }
  while (tables.empty() || (place.at < text.size() && has_number_line(text.substr(place.at)))) {
    TableReader reader(text, name, place, /*reserves=*/tables.empty(), known_names);
    if (tables.empty()) {
      tables.push_back(reader.read());
    } else {
      std::optional<CsvTable> next;
      try {
        next = reader.read();
      } catch (const std::runtime_error&) {
        // What follows the table is none.
      }
      if (!next || !next->has_header) {
        tables.back().notes.push_back("the lines from " + std::to_string(place.line) +
                                      " on are no rows of the table");
        break;
      }
      tables.push_back(std::move(*next));
    }
    place = reader.next();
  }
  return tables;
}

}  // namespace viscard
