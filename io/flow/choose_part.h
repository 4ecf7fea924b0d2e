#pragma once

#include "io/flow/fit_request.h"
#include "io/tables/csv_table.h"

#include <string>

namespace viscard {

// The rows of a table that --from, --to, --hold and --crop choose, and a sentence that says which.
// Throws std::runtime_error if none remain, or if the table does not have what the choice needs.
struct ChosenPart {
  CsvTable table;
  std::string text;  // empty: all rows
};
ChosenPart choose_part(const CsvTable& table, const FitRequest& request);

}  // namespace viscard
