#include "io/tables/log_columns.h"

#include "io/tables/column_match.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_header.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {
namespace {

struct Logarithm {
  double base = 10.0;
  std::string of;  // what the logarithm is of: "E'", "E' (Pa)"
};

bool is_small_letter(char c) {
  return c >= 'a' && c <= 'z';
}

// "log10 E'", "log(E'/Pa)", "logG"; nothing for "login" or "logger".
std::optional<Logarithm> logarithm_in(const std::string& header) {
  struct Prefix {
    std::string_view word;
    double base;
  };
  for (const Prefix& prefix : {Prefix{"log10", 10.0}, Prefix{"log_10", 10.0}, Prefix{"log", 10.0},
                               Prefix{"lg", 10.0}, Prefix{"ln", std::numbers::e}}) {
    if (!lower_case(header).starts_with(prefix.word)) continue;
    std::string rest = header.substr(prefix.word.size());
    // "logt", but not "logging".
    if (rest.size() > 1 && is_small_letter(rest[0]) && is_small_letter(rest[1]))
      return std::nullopt;
    rest.erase(0, rest.find_first_not_of(" _"));
    if (rest.size() > 2 && rest.front() == '(' && rest.find(')') + 1 == rest.size()) {
      rest = rest.substr(1, rest.size() - 2);
    }
    return Logarithm{prefix.base, rest};
  }
  return std::nullopt;
}

bool is_known(const CsvColumn& column) {
  const auto& kinds = column_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const ColumnKind& kind) {
    return !kind.is_text && match_header(column, kind);
  });
}

}  // namespace

void take_antilogarithms(CsvTable& table) {
  for (CsvColumn& column : table.columns) {
    const auto found = logarithm_in(column.header);
    if (!found || !column.text.empty() || is_known(column)) continue;  // "log strain" is Hencky's
    CsvColumn of = column;
    const HeaderParts parts = split_header(found->of);
    of.header = found->of;
    of.name = parts.name;
    if (!parts.unit.empty()) of.unit = parts.unit;
    if (!is_known(of)) continue;
    column.name = of.name;
    column.unit = of.unit;
    for (double& value : column.values) value = std::pow(found->base, value);
    table.notes.push_back("column '" + column.header + "' was read as logarithms to base " +
                          (found->base == 10.0 ? "10" : "e"));
  }
}

}  // namespace viscard
