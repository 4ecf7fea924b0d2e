#include "io/tables/column_proposal.h"

#include "io/basics/number_text.h"
#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/tables/column_match.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_header.h"
#include "io/tables/header_words.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace viscard {
namespace {

constexpr std::size_t kMostShown = 12;

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

// As stated, or at the end of a name, "separation_m".
std::string unit_of(const CsvColumn& column) {
  const std::size_t at = column.name.rfind('_');
  return is_stated(column.unit) || at == std::string::npos ? column.unit
                                                           : column.name.substr(at + 1);
}

// By name, or else the first with a unit of that kind.
std::optional<std::size_t> taken(const CsvTable& table, std::vector<std::size_t>& columns,
                                 const char* si_unit, const char* quantity = nullptr) {
  if (quantity != nullptr) {
    if (const auto named = taken_by_name(table, columns, quantity)) return named;
  }
  for (auto i = columns.begin(); i != columns.end(); ++i) {
    const std::string unit = unit_of(table.columns[*i]);
    if (!is_stated(unit) || !is_unit_of(unit, si_unit)) continue;
    const std::size_t column = *i;
    columns.erase(i);
    return column;
  }
  return std::nullopt;
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

// Words for an oscillation; none if a modulus of it has no name.
std::string words_of_sweep(const CsvTable& table, std::vector<std::size_t> columns,
                           std::size_t frequency) {
  std::string words = word("frequency_Hz", frequency);
  std::size_t n_found = 0;
  for (const char* name :
       {"storage_modulus_Pa", "loss_modulus_Pa", "complex_modulus_Pa", "tan_delta", "phase_rad"}) {
    if (n_found == 2) break;
    const auto found = taken_by_name(table, columns, name);
    if (!found) continue;
    words += word(name, *found);
    ++n_found;
  }
  return n_found == 2 ? words.substr(1) : "";
}

}  // namespace

std::string columns_with_values(const CsvTable& table) {
  constexpr std::size_t kValues = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(table.columns.size(), kMostShown); ++i) {
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
  if (table.columns.size() > kMostShown) {
    text += " and " + std::to_string(table.columns.size() - kMostShown) + " more";
  }
  return text;
}

namespace {

// "E (Mpa)" in its parts although the unit is none; empty unit: there are no brackets at the end.
HeaderParts with_any_unit(const CsvColumn& column) {
  if (is_stated(column.unit)) return {column.name, column.unit};
  const std::string& header = column.header;
  const std::size_t open = header.find_last_of("([");
  const bool has_brackets =
      open != std::string::npos && open > 0 && (header.back() == ')' || header.back() == ']');
  if (!has_brackets) return {header, ""};
  return {
      std::string(trimmed(std::string_view(header).substr(0, open))),
      std::string(trimmed(std::string_view(header).substr(open + 1, header.size() - open - 2)))};
}

}  // namespace

std::string unknown_unit(const CsvTable& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    const auto [name, unit] = with_any_unit(column);
    if (unit.empty() || is_unit(unit)) continue;
    CsvColumn bare = column;
    bare.unit.clear();
    bare.header = bare.name = name;
    for (const ColumnKind& kind : column_kinds()) {
      // "E" may be of several quantities; the unit that was meant decides.
      const std::string meant(unit_in_right_case(unit, kind.unit.si));
      if (meant.empty() || !match_header(bare, kind)) continue;
      const double factor = scale_to_si(meant, kind.unit.si).factor;
      const std::string times = factor == 1.0 ? "" : text_from_number(factor) + "*";
      return "column " + std::to_string(i + 1) + " '" + column.header + "' is by its name " +
             kind.name + ", but '" + unit + "' is not a known unit (capitals matter). If " + meant +
             " was meant, write " +
             quoted_for_shell({"--column", std::string(kind.name) + "=" + times + column.header});
    }
  }
  return "";
}

std::string proposed_words(const CsvTable& table) {
  std::vector<std::size_t> rest = number_columns(table);
  if (const auto frequency = taken(table, rest, "Hz", "frequency_Hz")) {
    return words_of_sweep(table, rest, *frequency);
  }
  const auto time = taken(table, rest, "s", "time_s");
  if (!time) return "";
  const std::string words = word("time_s", *time);
  const auto force = taken(table, rest, "N", "force_N");
  const auto depth = taken(table, rest, "m", "depth_m");
  if (force && depth) return words_of_contact(table, words, *force, depth);
  for (const char* name : {"modulus_Pa", "compliance_1_Pa", "stress_Pa"}) {
    if (const auto found = taken_by_name(table, rest, name)) {
      return (words + word(name, *found)).substr(1);
    }
  }
  return force && rest.empty() ? words_of_contact(table, words, *force, depth) : "";
}

}  // namespace viscard
