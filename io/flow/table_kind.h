#pragma once

#include "io/flow/fit_request.h"
#include "io/tables/csv_table.h"

#include <string>
#include <vector>

namespace viscard {

// The kind of test by the request, or else by the columns of the table. Throws std::runtime_error
// with the columns and their first values, and words of --column that might read them.
FitKind kind_of_table(const CsvTable& table, const FitRequest& request);

// Throws std::runtime_error if the columns are not those of the stated kind of test.
void require_kind(const CsvTable& table, FitKind kind, const FitRequest& request);

// The columns that a fit of this kind of test reads.
std::vector<std::string> columns_of_kind(FitKind kind, const CsvTable& table,
                                         const FitRequest& request);

// True for a table of force without a depth, modulus or stress.
bool is_force_alone(const CsvTable& table, const FitRequest& request);

// True for a table of storage moduli over frequency without anything that tells the loss.
bool is_storage_alone(const CsvTable& table, const FitRequest& request);

// Adds the flag unit-assumed if a column of this kind of test states no unit and was read in SI.
void flag_assumed_units(const CsvTable& table, const FitRequest& request, FitResult& result);

}  // namespace viscard
