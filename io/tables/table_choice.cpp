#include "io/tables/table_choice.h"

#include "io/tables/column_map.h"
#include "io/tables/column_match.h"
#include "io/tables/column_names.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Columns from `first` to before `last`.
struct ColumnRange {
  std::size_t first = 0, last = 0;
};

bool is_empty(const CsvColumn& column) {
  return column.text.empty() && std::all_of(column.values.begin(), column.values.end(),
                                            [](double value) { return std::isnan(value); });
}

bool is_time_or_frequency(const CsvColumn& column) {
  return match_header(column, column_kind("time_s")) ||
         match_header(column, column_kind("frequency_Hz"));
}

// Groups of columns between empty ones, or that begin where the first header stands again.
std::vector<ColumnRange> groups_of(const std::vector<CsvColumn>& columns) {
  std::vector<ColumnRange> groups;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (is_empty(columns[i])) continue;
    const bool is_next = i > 0 && !groups.empty() && groups.back().last == i;
    const bool repeats = is_next && columns[i].header == columns[groups.back().first].header &&
                         !columns[i].header.empty();
    if (is_next && !repeats) {
      ++groups.back().last;
    } else {
      groups.push_back({i, i + 1});
    }
  }
  return groups;
}

std::size_t n_numbers(const CsvTable& table) {
  std::size_t count = 0;
  for (const CsvColumn& column : table.columns) {
    count +=
        static_cast<std::size_t>(std::count_if(column.values.begin(), column.values.end(),
                                               [](double value) { return !std::isnan(value); }));
  }
  return count;
}

}  // namespace

std::vector<CsvTable> tables_side_by_side(CsvTable table) {
  const std::vector<ColumnRange> groups = groups_of(table.columns);
  const bool are_tables =
      groups.size() > 1 && std::all_of(groups.begin(), groups.end(), [&](const ColumnRange& group) {
        const auto begin = table.columns.begin() + static_cast<std::ptrdiff_t>(group.first);
        const auto end = table.columns.begin() + static_cast<std::ptrdiff_t>(group.last);
        return group.last - group.first > 1 && std::any_of(begin, end, is_time_or_frequency);
      });
  std::vector<CsvTable> tables;
  if (!are_tables) {
    tables.push_back(std::move(table));
    return tables;
  }
  for (const ColumnRange& group : groups) {
    CsvTable one = table;
    one.columns.assign(table.columns.begin() + static_cast<std::ptrdiff_t>(group.first),
                       table.columns.begin() + static_cast<std::ptrdiff_t>(group.last));
    // A shorter table ends in empty cells.
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.lines.size(); ++row) {
      const bool has_one =
          std::any_of(one.columns.begin(), one.columns.end(),
                      [&](const auto& column) { return !std::isnan(column.values[row]); });
      if (has_one) rows.push_back(row);
    }
    tables.push_back(rows.size() == table.lines.size() ? std::move(one) : chosen_rows(one, rows));
  }
  return tables;
}

CsvTable chosen_table(std::vector<CsvTable> tables, std::size_t number) {
  std::vector<CsvTable> all;
  for (CsvTable& table : tables) {
    for (CsvTable& one : tables_side_by_side(std::move(table))) all.push_back(std::move(one));
  }
  std::size_t most = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (n_numbers(all[i]) > n_numbers(all[most])) most = i;
  }
  if (number > all.size()) {
    throw std::runtime_error(all.front().file + ": has no table " + std::to_string(number) +
                             "; there " +
                             (all.size() == 1 ? "is 1" : "are " + std::to_string(all.size())));
  }
  const std::size_t chosen = number > 0 ? number - 1 : most;
  CsvTable table = std::move(all[chosen]);
  if (all.size() > 1) {
    table.notes.push_back("table " + std::to_string(chosen + 1) + " of " +
                          std::to_string(all.size()) + ", from line " +
                          std::to_string(table.lines.front()) + " on" +
                          (number > 0 ? "" : "; --table N chooses another"));
  }
  return table;
}

}  // namespace viscard
