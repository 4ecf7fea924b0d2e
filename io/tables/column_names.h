#pragma once

#include "io/basics/units.h"
#include "io/tables/csv_table.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Which headers of a table mean which quantity.
struct Quantity {
  const char* name;                  // "force_N"
  const char* base;                  // "force"
  const char* si_unit;               // "N"; "1" for a plain number
  std::vector<const char*> aliases;  // lower case unless a single letter; that one's case matters
  bool is_text = false;
};

const std::vector<Quantity>& quantities();

// The names of all quantities, in the order of the table.
const std::vector<std::string>& column_names();

// Throws std::invalid_argument when there is none of that name.
const Quantity& quantity_named(const std::string& name);

// False for no unit and for "-".
bool is_stated(const std::string& unit);

// How well a column's header says that it holds the quantity: 3 by its viscard name, 2 by the
// quantity's own name and a unit, 1 by an alias. Nothing when it does not, or in another unit.
struct HeaderMatch {
  int rank = 0;
  UnitScale scale;
};
std::optional<HeaderMatch> match_header(const CsvColumn& column, const Quantity& quantity);

}  // namespace viscard
