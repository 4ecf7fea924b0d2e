#pragma once

#include "io/flow/fit_request.h"
#include "io/tables/csv_table.h"

#include <string>

namespace viscard {

// fit_file() for a table that was read already.
FittedFile fit_csv(CsvTable all, const FitRequest& request);

// fit_file() for a table. Throws std::runtime_error, which may lack the name of the file.
FittedFile fit_table(const std::string& path, const FitRequest& request);

}  // namespace viscard
