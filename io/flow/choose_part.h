#pragma once

#include "io/flow/fit_request.h"
#include "io/tables/csv_table.h"

#include <string>

namespace viscard {

// Keeps the rows of a table that --from, --to, --hold and --crop choose, and returns a sentence that
// says which; empty if the request chooses none, so that all stay. Throws std::runtime_error if no
// row remains, or if the table does not have what the choice needs.
std::string choose_part(CsvTable& table, const FitRequest& request);

}  // namespace viscard
