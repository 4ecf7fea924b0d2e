#pragma once

#include "models/quantities/modulus_kind.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One column of a CsvTable.
struct CsvColumn {
  std::string header;          // as written: "Force [nN]"; "" without a header
  std::string name;            // without the bracketed unit: "Force"
  std::string unit;            // bracketed or from the row of units: "nN"; "" if none
  std::vector<double> values;  // as written, one per row; NaN where the cell is not a finite number
  std::vector<std::string> text;  // all cells, if one of them is text; otherwise empty
  // The first cell that is not a finite number: its line (from 1; 0 if there is none) and its text.
  std::size_t first_bad_line = 0;
  std::string first_bad_cell;
  // Of a computed column: the header that it follows from, and the kind of modulus that this one states.
  std::string derived_from;
  std::optional<ModulusKind> modulus_kind;
  double zero_unsure_s = 0.0;  // of clock times: by how much their begin was assumed
};

}  // namespace viscard
