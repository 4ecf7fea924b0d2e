#pragma once

#include "io/basics/units.h"
#include "io/tables/csv_table.h"
#include "models/quantities/quantities.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What a column of a table may hold, and the headers by which it is found.
struct ColumnKind {
  const char* name;  // "force_N"
  const char* base;  // "force"
  QuantityOrUnit unit;
  std::vector<const char*> aliases;  // beside base; lower case, but single letters keep theirs
  bool is_text = false;
};

const std::vector<ColumnKind>& column_kinds();

// The names of all of them, in the order of the table.
const std::vector<std::string>& column_names();

// Throws std::invalid_argument if none has that name.
const ColumnKind& column_kind(const std::string& name);

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
