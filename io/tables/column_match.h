#pragma once

#include "io/basics/units.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_table.h"

#include <optional>
#include <string>

namespace viscard {

// False for an empty unit and for "-".
bool is_stated(const std::string& unit);

// Returns how well a column's header matches the kind: 3 for its viscard name, 2 for the
// quantity's own name with a unit, 1 for an alias. Returns nothing for any other header, and if the
// unit measures another quantity.
struct HeaderMatch {
  int rank = 0;
  UnitScale scale;
  bool is_unit_assumed = false;  // the header states none, and the quantity is no plain number
  bool is_weight = false;        // a force in a unit of mass, taken as the weight of it
};
std::optional<HeaderMatch> match_header(const CsvColumn& column, const ColumnKind& kind);

}  // namespace viscard
