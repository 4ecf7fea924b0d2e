#include "io/tables/column_proposal.h"

#include "io/basics/number_text.h"
#include "io/basics/units.h"
#include "io/tables/column_names.h"
#include "io/tables/header_words.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace viscard {
namespace {

constexpr std::size_t kMostColumns = 12;

bool is_rising(const CsvColumn& column) {
  return std::is_sorted(column.values.begin(), column.values.end()) &&
         column.values.front() < column.values.back();
}

// The columns that hold numbers only and do not just count the rows.
std::vector<std::size_t> number_columns(const CsvTable& table) {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    const bool is_usable = column.first_bad_line == 0 && !column.values.empty();
    if (is_usable && !is_counter(column)) columns.push_back(i);
  }
  return columns;
}

std::string word(const char* quantity, std::size_t column) {
  return std::string(" --column ") + quantity + "=" + std::to_string(column + 1);
}

bool may_have_unit(const CsvColumn& column, const char* si_unit) {
  return !is_stated(column.unit) || is_unit_of(column.unit, si_unit);
}

// Takes the first of the columns that its header names as the quantity, or else the first whose
// header contains a name of it.
std::optional<std::size_t> taken_by_name(const CsvTable& table, std::vector<std::size_t>& columns,
                                         const char* quantity_name) {
  const ColumnKind& quantity = column_kind(quantity_name);
  auto at = std::find_if(columns.begin(), columns.end(), [&](std::size_t i) {
    return match_header(table.columns[i], quantity).has_value();
  });
  if (at == columns.end()) {
    at = std::find_if(columns.begin(), columns.end(), [&](std::size_t i) {
      return speaks_of(table.columns[i], quantity) &&
             may_have_unit(table.columns[i], quantity.unit.si);
    });
  }
  if (at == columns.end()) return std::nullopt;
  const std::size_t column = *at;
  columns.erase(at);
  return column;
}

// By name, or else the first with a unit of that kind.
std::optional<std::size_t> taken(const CsvTable& table, std::vector<std::size_t>& columns,
                                 const char* si_unit, const char* quantity = nullptr) {
  if (quantity != nullptr) {
    if (const auto named = taken_by_name(table, columns, quantity)) return named;
  }
  for (auto i = columns.begin(); i != columns.end(); ++i) {
    const std::string& unit = table.columns[*i].unit;
    if (!is_stated(unit) || !is_unit_of(unit, si_unit)) continue;
    const std::size_t column = *i;
    columns.erase(i);
    return column;
  }
  return std::nullopt;
}

// Takes the column of time: by name or unit, or else the first without a unit that only rises, or the
// first without a unit.
std::optional<std::size_t> taken_time(const CsvTable& table, std::vector<std::size_t>& columns) {
  if (const auto column = taken(table, columns, "s", "time_s")) return column;
  const auto is_plain = [&](std::size_t i) { return !is_stated(table.columns[i].unit); };
  auto at = std::find_if(columns.begin(), columns.end(),
                         [&](std::size_t i) { return is_plain(i) && is_rising(table.columns[i]); });
  if (at == columns.end()) at = std::find_if(columns.begin(), columns.end(), is_plain);
  if (at == columns.end()) return std::nullopt;
  const std::size_t column = *at;
  columns.erase(at);
  return column;
}

bool names_any(const CsvColumn& column, std::initializer_list<const char*> parts) {
  std::string text = column.header;
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return std::any_of(parts.begin(), parts.end(),
                     [&](const char* part) { return text.find(part) != std::string::npos; });
}

// The first column if its header speaks of a frequency and two more are left.
std::optional<std::size_t> taken_frequency(const CsvTable& table,
                                           std::vector<std::size_t>& columns) {
  if (const auto found = taken(table, columns, "Hz", "frequency_Hz")) return found;
  const bool is_one = columns.size() == 3 &&
                      names_any(table.columns[columns[0]], {"freq", "omega", "ω", "hz", "rad"});
  if (!is_one) return std::nullopt;
  const std::size_t column = columns.front();
  columns.erase(columns.begin());
  return column;
}

// What a single column beside the time may be.
const char* lone_quantity(const CsvColumn& column) {
  return names_any(column, {"compl", "nachgieb", "creep", "kriech", "柔量"}) ? "compliance_1_Pa"
                                                                             : "modulus_Pa";
}

// Words for force and depth beside those for the time; force alone if there is no other column.
std::string words_of_contact(const CsvTable& table, const std::string& words, std::size_t force,
                             std::optional<std::size_t> depth) {
  const std::string with_force = words + word("force_N", force);
  if (!depth) return with_force.substr(1);
  // The force rises with the depth; a separation falls.
  const std::vector<double>& forces = table.columns[force].values;
  const std::vector<double>& depths = table.columns[*depth].values;
  const auto peak = std::max_element(forces.begin(), forces.end()) - forces.begin();
  const bool falls = depths[static_cast<std::size_t>(peak)] < depths.front();
  return (with_force + " --column depth_m=" + (falls ? "-" : "") + std::to_string(*depth + 1))
      .substr(1);
}

// Words for a force and a depth that the headers name; other columns do not matter.
std::optional<std::string> named_contact(const CsvTable& table, std::vector<std::size_t> columns) {
  const auto force = taken_by_name(table, columns, "force_N");
  const auto depth = taken_by_name(table, columns, "depth_m");
  if (!force || !depth) return std::nullopt;
  const auto time = taken_time(table, columns);
  if (!time) return std::nullopt;
  return words_of_contact(table, word("time_s", *time), *force, depth);
}

// Words for an oscillation: storage and loss modulus by name, by unit, or in the order of the columns.
std::optional<std::string> named_sweep(const CsvTable& table, std::vector<std::size_t> columns) {
  const auto frequency = taken_frequency(table, columns);
  if (!frequency) return std::nullopt;
  auto storage = taken_by_name(table, columns, "storage_modulus_Pa");
  auto loss = taken_by_name(table, columns, "loss_modulus_Pa");
  for (auto* missing : {&storage, &loss}) {
    if (!*missing) *missing = taken(table, columns, "Pa");
    if (*missing || columns.empty() || is_stated(table.columns[columns.front()].unit)) continue;
    *missing = columns.front();
    columns.erase(columns.begin());
  }
  if (!storage || !loss) return std::nullopt;
  return (word("frequency_Hz", *frequency) + word("storage_modulus_Pa", *storage) +
          word("loss_modulus_Pa", *loss))
      .substr(1);
}

}  // namespace

std::string columns_with_values(const CsvTable& table) {
  constexpr std::size_t kValues = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(table.columns.size(), kMostColumns); ++i) {
    const CsvColumn& column = table.columns[i];
    text += (i == 0 ? "" : ", ") + std::to_string(i + 1);
    if (!column.header.empty()) text += " '" + column.header + "'";
    if (is_stated(column.unit) && column.name == column.header) text += " in " + column.unit;
    text += " (";
    const std::size_t n = std::min(column.values.size(), kValues);
    for (std::size_t row = 0; row < n; ++row) {
      const bool is_number = std::isfinite(column.values[row]);
      const std::string cell = is_number             ? text_from_number(column.values[row])
                               : column.text.empty() ? std::string("empty")
                                                     : column.text[row].substr(0, 20);
      text += (row == 0 ? "" : ", ") + cell;
    }
    text += column.values.size() > n ? ", ...)" : ")";
  }
  if (table.columns.size() > kMostColumns) {
    text += " and " + std::to_string(table.columns.size() - kMostColumns) + " more";
  }
  return text;
}

std::string proposed_words(const CsvTable& table) {
  std::vector<std::size_t> rest = number_columns(table);
  if (rest.size() < 2) return "";
  if (const auto sweep = named_sweep(table, rest)) return *sweep;
  if (const auto contact = named_contact(table, rest)) return *contact;
  const auto modulus = taken(table, rest, "Pa", "modulus_Pa");
  const auto time = taken_time(table, rest);
  if (!time) return "";
  const std::string words = word("time_s", *time);
  if (modulus) return (words + word("modulus_Pa", *modulus)).substr(1);
  auto force = taken(table, rest, "N", "force_N");
  auto depth = taken(table, rest, "m", "depth_m");
  const auto is_without_unit = [&](std::size_t i) { return !is_stated(table.columns[i].unit); };
  std::erase_if(rest, [&](std::size_t i) { return !is_without_unit(i); });
  if (!force && !depth && rest.size() == 1) {
    return (words + word(lone_quantity(table.columns[rest[0]]), rest[0])).substr(1);
  }
  for (auto* missing : {&force, &depth}) {
    if (*missing || rest.empty()) continue;
    *missing = rest.front();
    rest.erase(rest.begin());
  }
  return force ? words_of_contact(table, words, *force, depth) : "";
}

}  // namespace viscard
