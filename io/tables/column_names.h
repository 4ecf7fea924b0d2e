#pragma once

#include "models/quantities/quantities.h"

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

// Names of angular frequencies, in rad/s even if the column has no unit.
const std::vector<const char*>& angular_frequency_names();

}  // namespace viscard
