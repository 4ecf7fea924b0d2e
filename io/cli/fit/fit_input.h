#pragma once

#include "fit/fit_master_curve.h"
#include "fit/intervals/fit_result.h"
#include "fit/laws/fractional_diagnosis.h"
#include "fit/samples/fit_data.h"
#include "io/tables/column_map.h"
#include "models/experiment/specimen.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What `viscard fit` was asked, apart from the files.
struct FitWords {
  std::optional<FitKind> kind;  // none: by the columns found
  FitOptions options;
  ColumnMap columns;
  std::vector<std::string> segments;  // rows of these only; empty: all
  double time_zero_s = 0.0;           // t = 0
  std::optional<Specimen> specimen;   // geometry, in place of the capture's own
  bool diagnose = false;              // compare with a fractional model
  bool needs_modulus = false;         // a stiffness will not do: a material is to be written
  double frame_stiffness_N_m = 0.0;   // for tables whose depth is the stage's
  std::optional<double> T_ref_C;      // of a master curve
};

// One file fitted, with what the file said about the specimen.
struct FittedFile {
  std::string path;
  FitResult result;
  Specimen specimen;        // empty for a table without --specimen
  std::string fitted_unit;  // of the fitted column: "N", "Pa", "1/Pa"
  // A table of several temperatures: `result` is the master curve at the reference.
  std::optional<MasterCurve> master;
  std::optional<FractionalDiagnosis> fractional;  // with FitWords::diagnose
};

// Reads a capture or a table and fits it. Throws std::runtime_error naming the file.
FittedFile fit_file(const std::string& path, const FitWords& words);

}  // namespace viscard
