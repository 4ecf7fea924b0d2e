#include "io/tables/known_names.h"

#include "io/tables/column_match.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_header.h"

#include <algorithm>

namespace viscard {
namespace {

bool names_a_quantity(const std::string& word) {
  CsvColumn column;
  column.header = word;
  const HeaderParts parts = split_header(word);
  column.name = parts.name;
  column.unit = parts.unit;
  const auto& kinds = column_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const ColumnKind& kind) {
    return match_header(column, kind).has_value();
  });
}

}  // namespace

bool KnownNames::has(const std::string& word) {
  const auto found = known_.find(word);
  if (found != known_.end()) return found->second;
  if (known_.size() >= kMost) return false;
  return known_.emplace(word, names_a_quantity(word)).first->second;
}

}  // namespace viscard
