#pragma once

#include "io/flow/fit_request.h"
#include "io/tables/csv_table.h"

#include <optional>
#include <string>

namespace viscard {

// Unit of a fitted strain, which is no unit of stress or force.
inline constexpr const char* kStrainUnit = "strain";

// The rows of a table, fitted as one kind of test.
struct TableFit {
  FitResult result;
  std::string unit;                   // of the fitted column: "Pa", "1/Pa", "N", "N/m", kStrainUnit
  bool has_no_depth = false;          // a force alone
  std::optional<MasterCurve> master;  // of several temperatures, whose fit is the result
};

// All rows are fitted; moduli are converted to those of tension by request.young_factor. Throws std::runtime_error for
// columns that this kind of test does not allow.
TableFit fit_of_kind(const CsvTable& table, FitKind kind, const FitRequest& request);

// What a master curve is fitted to, if a table of relaxation moduli or frequency sweeps has several temperatures.
std::optional<MasterData> master_data(const CsvTable& table, FitKind kind,
                                      const FitRequest& request);

}  // namespace viscard
