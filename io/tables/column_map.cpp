#include "io/tables/column_map.h"

#include "io/basics/number_text.h"
#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/tables/column_match.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_dialect.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

std::string place(std::size_t index) {
  return std::to_string(index + 1);
}

std::string quoted_header(const CsvColumn& column) {
  return column.header.empty() ? std::string() : " '" + column.header + "'";
}

std::string columns_there(const CsvTable& table) {
  std::string out = "; there ";
  if (!table.has_header) {
    out += "is no header, so give the column by its number: --column NAME=1 to " +
           std::to_string(table.columns.size());
    if (!table.preamble.empty()) {
      out += " ('" + table.preamble.back() +
             "' was read as a note, because the rows of numbers have another number of cells)";
    }
    return out;
  }
  out += table.columns.size() == 1 ? "is" : "are";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    out += (i == 0 ? " " : ", ") + place(i) + quoted_header(table.columns[i]);
    if (!table.columns[i].unit.empty() && table.columns[i].name == table.columns[i].header) {
      out += " in " + table.columns[i].unit;
    }
  }
  return out;
}

[[noreturn]] void fail(const CsvTable& table, const std::string& what) {
  throw std::runtime_error(table.file + ": " + what);
}

// Returns a column's scale from the command line's unit, the table's unit or its name's suffix.
UnitScale scale_of(const CsvTable& table, const CsvColumn& column, const ColumnKind& quantity,
                   const std::string& said_unit) {
  if (quantity.is_text) return {};
  const std::string& unit = is_stated(said_unit) ? said_unit : column.unit;
  if (is_stated(unit)) {
    try {
      return scale_to_si(unit, quantity.unit.si);
    } catch (const std::invalid_argument& error) {
      fail(table, "column" + quoted_header(column) + " for " + quantity.name + ": " + error.what());
    }
  }
  const std::size_t underscore = column.name.rfind('_');
  if (underscore != std::string::npos) {
    const std::string suffix = column.name.substr(underscore + 1);
    if (is_unit_of(suffix, quantity.unit.si)) return scale_to_si(suffix, quantity.unit.si);
  }
  return {};
}

ColumnUse use_of(const CsvTable& table, std::size_t index, const ColumnKind& quantity,
                 double factor, UnitScale scale) {
  ColumnUse use{index, factor * scale.factor, factor * scale.offset, ""};
  use.description =
      quantity.name + std::string(": column ") + place(index) + quoted_header(table.columns[index]);
  use.written_factor = factor;
  use.is_unit_stated = factor != 1.0 || !table.columns[index].unit.empty();
  if (use.factor != 1.0) use.description += " x " + text_from_number(use.factor);
  if (use.offset != 0.0) use.description += " + " + text_from_number(use.offset);
  return use;
}

// Returns the index of the column that the right-hand side of --column names, or npos. If a unit in
// brackets follows a name or number that matches without it, said_unit is set to that unit.
std::size_t index_of(const CsvTable& table, std::string_view spec, std::string& said_unit) {
  const auto& columns = table.columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].header.empty() && columns[i].header == spec) return i;
  }
  std::size_t found = std::string::npos, count = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name.empty() || columns[i].name != spec) continue;
    found = i;
    ++count;
  }
  if (count == 1) return found;
  if (count > 1) {
    fail(table, std::to_string(count) + " columns are named '" + std::string(spec) +
                    "'; choose one by its number");
  }
  std::size_t number = 0;
  const auto result = std::from_chars(spec.data(), spec.data() + spec.size(), number);
  if (result.ec == std::errc() && result.ptr == spec.data() + spec.size()) {
    return number >= 1 && number <= columns.size() ? number - 1 : std::string::npos;
  }
  const std::size_t open = spec.find_last_of("([");
  const bool is_bracketed = open != std::string_view::npos && open > 0 && said_unit.empty() &&
                            (spec.back() == ')' || spec.back() == ']');
  if (!is_bracketed) return std::string::npos;
  said_unit = trimmed(spec.substr(open + 1, spec.size() - open - 2));
  return index_of(table, trimmed(spec.substr(0, open)), said_unit);
}

ColumnUse mapped_column(const CsvTable& table, const ColumnKind& quantity,
                        const std::string& expression) {
  double factor = 1.0;
  std::string_view spec = trimmed(expression);
  std::string said_unit;
  std::size_t index =
      index_of(table, spec, said_unit);  // a header may begin with a sign, so try it whole
  const std::size_t star = spec.find('*');
  if (index == std::string::npos && star != std::string_view::npos) {
    const auto number = number_from_cell(trimmed(spec.substr(0, star)), {});
    if (number && std::isfinite(*number)) {
      factor = *number;
      spec = trimmed(spec.substr(star + 1));
    }
  }
  if (index == std::string::npos && !spec.empty() && spec.front() == '-') {
    factor = -factor;
    spec = trimmed(spec.substr(1));
  }
  if (index == std::string::npos) {
    said_unit.clear();
    index = index_of(table, spec, said_unit);
  }
  if (index == std::string::npos) {
    fail(table,
         "has no column '" + std::string(spec) + "' for " + quantity.name + columns_there(table));
  }
  ColumnUse use = use_of(table, index, quantity, factor,
                         scale_of(table, table.columns[index], quantity, said_unit));
  use.is_unit_stated |= !said_unit.empty();
  return use;
}

std::optional<ColumnUse> found_column(const CsvTable& table, const ColumnKind& quantity) {
  std::optional<ColumnUse> best;
  int best_rank = 0;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto match = match_header(table.columns[i], quantity);
    if (!match || match->rank < best_rank) continue;
    if (best && match->rank == best_rank) {
      fail(table, "columns " + place(best->index) + quoted_header(table.columns[best->index]) +
                      " and " + place(i) + quoted_header(table.columns[i]) + " could both be " +
                      quantity.name + "; choose one with --column " + quantity.name + "=" +
                      place(i));
    }
    best = use_of(table, i, quantity, 1.0, match->scale);
    best->is_unit_assumed = match->is_unit_assumed;
    best->is_weight = match->is_weight;
    best_rank = match->rank;
  }
  return best;
}

ColumnUse required_column(const CsvTable& table, const std::string& name, const ColumnMap& map) {
  if (const auto use = find_column(table, name, map)) return *use;
  fail(table, "has no column for " + name + columns_there(table));
}

}  // namespace

ColumnMap column_map_from_words(const std::vector<std::string>& words) {
  ColumnMap map;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == word.size()) {
      throw std::invalid_argument(
          "--column '" + word +
          "' is not of the form NAME=COLUMN; write it like time_s=\"Time (s)\" or force_N=2");
    }
    const std::string name = word.substr(0, equals);
    const auto& names = column_names();
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw std::invalid_argument("--column: there is no quantity '" + name + "'" +
                                  did_you_mean(name, names) + " There are " + listed(names));
    }
    if (!map.emplace(name, word.substr(equals + 1)).second) {
      throw std::invalid_argument("--column names " + name + " twice");
    }
  }
  return map;
}

std::optional<ColumnUse> find_column(const CsvTable& table, const std::string& name,
                                     const ColumnMap& map) {
  const ColumnKind& quantity = column_kind(name);
  const auto mapped = map.find(name);
  if (mapped != map.end()) return mapped_column(table, quantity, mapped->second);
  const auto of_maker = table.maker_columns.find(name);
  if (of_maker != table.maker_columns.end()) {
    return mapped_column(table, quantity, of_maker->second);
  }
  return found_column(table, quantity);
}

namespace {

std::vector<double> values_SI(const CsvColumn& column, const ColumnUse& use) {
  std::vector<double> out = column.values;
  if (use.factor != 1.0 || use.offset != 0.0) {
    for (double& value : out) value = value * use.factor + use.offset;
  }
  return out;
}

}  // namespace

namespace {

// "1e6", "0.01", "1e-3".
std::string factor_text(double factor) {
  const double exponent = std::round(std::log10(std::abs(factor)));
  const bool is_power = std::abs(std::abs(factor) / std::pow(10.0, exponent) - 1.0) < 1e-12;
  if (!is_power || std::abs(exponent) < 3.0) return text_of(factor);
  return (factor < 0.0 ? "-1e" : "1e") + text_of(exponent);
}

void refuse_implausible(const CsvTable& table, const std::string& name, const ColumnUse& use,
                        const std::vector<double>& values) {
  const Quantity* quantity = column_kind(name).unit.quantity;
  if (quantity == nullptr) return;
  const auto doubt = doubt_about(*quantity, values, table.judged);
  if (!doubt) return;
  const std::string words = words_for_factor(table, name, use, doubt->meant_factor);
  const char* which =
      quantity->kind == QuantityKind::kLargest ? "its largest value " : "one of its values ";
  throw BadNumber(
      table.file + ": column " + place(use.index) + quoted_header(table.columns[use.index]) +
      " for " + name + ": " + which + doubt->with_remedy(words, "add --plausible off") +
      (doubt->meant_factor < 0.0 ? ". If the instrument has the other sign, " + words : ""));
}

}  // namespace

std::string words_for_factor(const CsvTable& table, const std::string& name, const ColumnUse& use,
                             double factor) {
  const std::string& header = table.columns[use.index].header;
  const bool has_control = std::any_of(header.begin(), header.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  const bool has_header = !header.empty() && header.find('*') == std::string::npos && !has_control;
  const std::string word = name + "=" + factor_text(factor * use.written_factor) + "*" +
                           (has_header ? header : place(use.index));
  return "write --column " + quoted_for_shell({word});
}

namespace {

bool is_gap_at(const CsvColumn& column, std::size_t row) {
  return !std::isfinite(column.values[row]) && (column.text.empty() || is_gap(column.text[row]));
}

bool has_gaps_only(const CsvColumn& column) {
  std::size_t row = 0;
  while (row < column.values.size() && is_gap_at(column, row)) ++row;
  return row == column.values.size();
}

}  // namespace

std::vector<double> column_SI(const CsvTable& table, const std::string& name,
                              const ColumnMap& map) {
  const ColumnUse use = required_column(table, name, map);
  const CsvColumn& column = table.columns[use.index];
  if (column.first_bad_line != 0) {
    if (has_gaps_only(column)) {
      fail(table, "column " + place(use.index) + quoted_header(column) + " for " + name +
                      ": no row has a number; fill it in, or give another column");
    }
    const std::string cell = column.first_bad_cell.empty()
                                 ? "the cell is empty"
                                 : "'" + column.first_bad_cell + "' is not a finite number";
    throw std::runtime_error(table.file + ":" + std::to_string(column.first_bad_line) +
                             ": column " + place(use.index) + quoted_header(column) + " for " +
                             name + ": " + cell + "; expected a number" +
                             (table.has_decimal_comma ? " with a decimal comma" : ""));
  }
  std::vector<double> values = values_SI(column, use);
  refuse_implausible(table, name, use, values);
  return values;
}

std::vector<double> column_with_gaps_SI(const CsvTable& table, const std::string& name,
                                        const ColumnMap& map) {
  const ColumnUse use = required_column(table, name, map);
  return values_SI(table.columns[use.index], use);
}

std::vector<std::string> column_text(const CsvTable& table, const std::string& name,
                                     const ColumnMap& map) {
  const CsvColumn& column = table.columns[required_column(table, name, map).index];
  if (!column.text.empty()) return column.text;
  std::vector<std::string> out;
  for (const double value : column.values) out.push_back(text_from_number(value));
  return out;
}

CsvTable rows_of_segment(const CsvTable& table, const std::string& segment, const ColumnMap& map) {
  const std::vector<std::string> segments = column_text(table, "segment", map);
  std::vector<std::size_t> rows;
  std::vector<std::string> names;
  for (std::size_t row = 0; row < segments.size(); ++row) {
    if (segments[row] == segment) rows.push_back(row);
    const bool is_new = std::find(names.begin(), names.end(), segments[row]) == names.end();
    if (is_new && names.size() < 20) names.push_back(segments[row]);
  }
  if (rows.empty()) fail(table, "has no segment '" + segment + "'; there are " + listed(names));
  return chosen_rows(table, rows);
}

CsvTable rows_without_gaps(CsvTable table, const std::vector<std::string>& names,
                           const ColumnMap& map, std::size_t& n_left_out) {
  std::vector<const CsvColumn*> used;
  for (const std::string& name : names) {
    const auto use = find_column(table, name, map);
    if (use && table.columns[use->index].first_bad_line != 0) {
      used.push_back(&table.columns[use->index]);
    }
  }
  n_left_out = 0;
  if (used.empty()) return table;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.lines.size(); ++row) {
    const bool has_gap = std::any_of(
        used.begin(), used.end(), [&](const CsvColumn* column) { return is_gap_at(*column, row); });
    if (!has_gap) rows.push_back(row);
  }
  n_left_out = table.lines.size() - rows.size();
  if (n_left_out == 0) return table;
  if (rows.empty()) return table;  // column_SI() names the first gap
  return chosen_rows(table, rows);
}

CsvTable chosen_rows(const CsvTable& table, const std::vector<std::size_t>& rows) {
  CsvTable out = table;
  out.lines.clear();
  for (const std::size_t row : rows) out.lines.push_back(table.lines[row]);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& from = table.columns[i];
    CsvColumn& to = out.columns[i];
    to.values.clear();
    to.text.clear();
    to.first_bad_line = 0;
    to.first_bad_cell.clear();
    for (const std::size_t row : rows) {
      to.values.push_back(from.values[row]);
      if (!from.text.empty()) to.text.push_back(from.text[row]);
      if (!std::isnan(from.values[row]) || to.first_bad_line != 0) continue;
      to.first_bad_line = table.lines[row];
      to.first_bad_cell = from.text.empty() ? "" : from.text[row];
    }
  }
  return out;
}

}  // namespace viscard
