#pragma once

#include "io/flow/fit_request.h"
#include "io/tables/csv_table.h"
#include "models/maths/interval.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

struct MasterSegment;  // fit/master_segments.h

// fit_file() for a table that was read already.
FittedFile fit_csv(CsvTable all, const FitRequest& request);

// fit_file() for a table. Throws std::runtime_error, which may lack the name of the file.
FittedFile fit_table(const std::string& path, const FitRequest& request);

// The isotherms that the master curve of this table is fitted to, in the unit of its columns in SI; empty for a table of
// one temperature. Its computed columns exist already (derive_columns). Throws what fit_csv() throws.
std::vector<MasterSegment> isotherms_of(CsvTable all, const FitRequest& request);

// What --from, --to, --hold and --crop chose.
struct ChosenPart {
  std::string text;  // which rows; empty if the request chooses none, so that all stay
  // The specimen was loaded before the first chosen row, and perhaps still is.
  bool was_loaded = false, is_loaded = false;
  // Of --crop auto without a depth: when the load rose before the first chosen row, in the table's
  // time. The middle becomes t = 0.
  std::optional<Interval> rise_s;
};

// Keeps the chosen rows of a table. Throws std::runtime_error if no row remains, or if the table does
// not have what the choice needs.
ChosenPart choose_part(CsvTable& table, const FitRequest& request);

// The request with t = 0 in the middle of the rise.
FitRequest with_zero_in(const Interval& rise_s, FitRequest request);

// Reports loading that the chosen part does not contain: the fit takes the specimen as at rest, or
// the rise before the part as a step.
void flag_history(const ChosenPart& part, FitResult& result);

}  // namespace viscard
