#pragma once

#include "fit/fit_master_curve.h"
#include "fit/intervals/fit_result.h"
#include "fit/laws/fit_mixing_ratio.h"
#include "fit/laws/fractional_diagnosis.h"
#include "fit/samples/fit_data.h"
#include "io/tables/column_map.h"
#include "models/experiment/run_temperature.h"
#include "models/experiment/specimen.h"
#include "models/material/material.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What to fit in a capture or a table, and how.
struct FitRequest {
  std::optional<FitKind> kind;  // none: the columns decide
  FitOptions options;
  ColumnMap columns;
  std::vector<std::string> segments;  // use only rows of these; empty: all
  double time_zero_s = 0.0;           // time in the table where t = 0
  std::optional<Specimen> specimen;   // replaces the specimen of a capture
  bool diagnose = false;              // compare with other laws (FitResult::laws)
  std::string model;                  // a law of fit/laws/law_values.h as the answer; empty: series
  bool needs_specimen = false;        // a table of several specimens is refused
  bool needs_modulus = false;         // a stiffness is refused, because a material will be written
  double frame_stiffness_N_m = 0.0;   // for tables whose depth_m is the position of the stage
  std::optional<double> T_ref_C;      // reference temperature of a master curve
};

// The fit of one file, with the specimen that the file or the options describe.
struct FittedFile {
  std::string path;
  FitResult result;
  Specimen specimen;        // empty for a table without --specimen
  std::string specimen_id;  // of the capture, or of the table's column "specimen"; empty: not known
  std::string fitted_unit;  // unit of the fitted column: "N", "Pa", "1/Pa"
  // Rows of an exported capture before its first baseline, which are not fitted.
  std::size_t n_before_test = 0;
  // By the thermometer of the run; nothing if there was none.
  std::optional<RunTemperature> temperature;
  // For a table of several temperatures; `result` is then the fit at the reference temperature.
  std::optional<MasterCurve> master;
  // If FitRequest::diagnose is set, of a relaxation after a step.
  std::optional<FractionalDiagnosis> fractional;
  std::string model;  // the law that `result` is written from; empty: a series
};

// Reads a capture or a table and fits it. Throws std::runtime_error naming the file.
FittedFile fit_file(const std::string& path, const FitRequest& request);

// Called with the fraction done and the name of the step that was finished last; may be empty.
using FlowProgress = std::function<void(double fraction, const std::string& step)>;

// Fits all files on all cores. If some fail, rethrows the exception of the first such file.
std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitRequest& request,
                                  const FlowProgress& progress);

// Properties of the material that the fit does not determine.
struct MaterialRequest {
  std::optional<double> nu;         // none: that of the specimen, or 0.495 without punch geometry
  std::optional<double> rho_kg_m3;  // none: that of the specimen
  std::string command;
  std::string created_at;  // ISO 8601, empty in reproducible mode
};

// Makes the material of one fitted capture or table, with its name, validity window and provenance
// (including the SHA-256 of the raw file). Throws std::invalid_argument if the fit gave
// stiffnesses, std::runtime_error if the raw file cannot be read.
Material material_from_fitted(const FittedFile& fitted, const MaterialRequest& request);

// Specimens of one material at several mixing ratios.
struct JointRequest {
  std::vector<std::string> files;  // captures, tables, material files
  std::vector<double> ratios;      // one for each file; empty: the files state them
  // One for each file, of the specimen that it is a record of; empty: the files state them.
  std::vector<std::string> specimen_ids;
  FitRequest fit;
  MaterialRequest material;
  MixingOptions options;
  FlowProgress progress;
  std::function<void(const std::string&)> note;  // called for each specimen that is fitted again
};

// Fits the measured records with one common number of terms (with options.own_terms: one for each
// ratio), then the law in the mixing ratio. Records of one specimen are repeated touches. Throws what
// fit_file(), read_material() and fit_mixing_ratio() throw; std::runtime_error for a record that is
// given twice, a specimen with two ratios, and files with repeats and others that do not state their
// specimen.
RatioFit fit_jointly(const JointRequest& request);

}  // namespace viscard
