#pragma once

#include "io/basics/option_use.h"
#include "io/tables/column_map.h"
#include "io/tables/csv_table.h"
#include "models/material/material.h"
#include "models/material/prediction.h"
#include "models/quantities/modulus_kind.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// What a material file predicts for a test, beside a measured curve if there is one.
struct PredictFileRequest {
  std::string material;               // path of a material file
  std::optional<PredictedTest> test;  // none: the columns of the measured table decide
  PredictionRequest prediction;       // its `test`, `history` and `also_at` are filled in
  std::string history;                // table with time_s and strain or stress_Pa; may be empty
  std::string against;                // table of measured values; may be empty
  // Tables that stand for these two files, of which then only the names are used.
  std::shared_ptr<const CsvTable> history_in_memory, against_in_memory;
  bool is_driven_by_stress = false;  // of a table with strain and stress, which one is the input
  ColumnMap columns;                 // of both tables
  std::optional<ModulusKind> modulus_kind;  // of both; none: their headers decide
  bool accepts_unverified = false;          // of tables of damaged captures; the result is flagged
  double time_zero_s = 0.0;                 // time in the tables where t = 0
  std::optional<double> temperature_C;      // by the material's temperature shift
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any value, and flags the prediction
  // Names of the options that were given, "recovery"; those without an effect on the test are
  // refused.
  std::vector<std::string> given;
};

// 95 % are expected; the band errs in the same direction everywhere, and of few rows one may lie outside.
constexpr double kAgreeingShare = 0.8;

// Measured values of one predicted curve, and how far the prediction is from them.
struct Agreement {
  std::string name;  // "modulus_Pa"
  // Time or frequency of the rows that can be compared, and their values in the unit of the name.
  std::vector<double> at, measured;  // the rows that can be compared
  std::vector<std::size_t> index;    // of each row in the prediction
  std::size_t n_left_out = 0;        // rows before the test begins
  std::size_t n_inside_window = 0;
  // Statistics of predicted - measured, in the unit of the name; relative to the rms measured.
  double rms = 0.0, rms_relative = 0.0;  // of predicted - measured; relative to the rms measured
  double rms_inside_window = 0.0;        // NaN if no row is inside
  // Largest magnitude of predicted - measured, and where.
  double worst = 0.0, worst_at = 0.0;  // predicted - measured, largest magnitude
  // Share of the rows inside the 95 % band of the curve; NaN without a band.
  double share_inside_band = 0.0;
  // The same with the noise of the measurement added in quadrature, where at least 20 rows show it.
  double share_inside_band_and_noise = 0.0;
  // Whether at least kAgreeingShare of the rows lie inside band and noise; none: there is no band.
  std::optional<bool> agrees;
  double noise_sigma = 0.0;        // from differences between neighbours; NaN: not known
  bool is_noise_relative = false;  // of frequency sweeps, whose values span decades
};

// What a material file predicts for a test.
struct PredictedFile {
  std::string path, name;  // of the material
  double systematic_relative = 0.0;
  bool has_band = false;
  std::vector<MaterialFlag> flags;  // of the material, and of the tables
  bool is_trustworthy = true;       // none of them is a defect
  TestPrediction prediction;
  std::string against;               // table that was compared; empty: none
  std::vector<Agreement> agreement;  // one for each predicted quantity that was measured
  std::vector<std::string> notes;    // doubts about the material and its band, sentences
};

// Throws std::runtime_error naming the file, std::invalid_argument as predict_test() does.
PredictedFile predict_file(const PredictFileRequest& request);

// The same for a material in memory; request.material stands for it in messages.
PredictedFile predict_material(Material material, const PredictFileRequest& request);

// The options of a request, and whether they have an effect on this test.
OptionUses uses_in(PredictedTest test, const PredictFileRequest& request);

// "relaxation", "creep", "recovery", "cycles", "oscillation", "history", in this order.
const std::vector<std::string>& names_of_predicted_tests();

// The keys of `viscard predict --json`.
void show_keys(ResultVisitor& v, const PredictedFile& predicted);

// A table that viscard fit reads again: argument, input, value, band, and whether the row is inside
// the window of the fit. command: recorded in the first line.
std::string csv_from_prediction(const PredictedFile& predicted, const std::string& command);

}  // namespace viscard
