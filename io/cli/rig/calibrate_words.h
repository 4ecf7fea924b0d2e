#pragma once

#include "io/cli/words/streams.h"
#include "io/config/config_file.h"
#include "io/flow/calibrate.h"
#include "io/results/result_schema.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard calibrate`. SI.
struct CalibrateWords {
  std::optional<std::string> rig_file, data_file, truth_file;
  Plausible plausible = Plausible::kMeasured;
  std::string out_file;
  CalibrationRequest request;
  bool is_compliance = false;
  bool is_emulated = false;
  bool asks_nobody = false;
  bool overwrite = false;
  bool accepts_unverified = false;
  bool as_json = false;
  std::string weights;  // "20 g, 50 g"
  std::vector<double> masses_kg;
  int series = 3;
  std::optional<double> capacity_N;
  double settle_s = 1.0;
  double mean_s = 3.0;
  double force_N = 0.0;  // highest force on the block; 0: 70 % of the soft limit
  int steps = 8;
  double speed = 1.0;
};

// Calibrates the load cell with dead weights, from a table or on the rig; writes the record and
// prints the result.
int calibrate_load_cell(const CalibrateWords& words, Streams& streams);
// Measures the frame's stiffness on a rigid block, from a table, a capture or on the rig; likewise.
int calibrate_frame(const CalibrateWords& words, Streams& streams);
// What they print with --json.
DescribedResult result_of_load_cell();
DescribedResult result_of_frame();

// Configuration and truth of the emulated rig for these words.
RigConfig calibrate_rig(const CalibrateWords& words);
EmulatedTruth calibrate_truth(const CalibrateWords& words);
// The rows of a table with a number in both columns; stderr has the count of the others.
CsvTable complete_rows(CsvTable table, bool is_block, Streams& streams);
// Refuses --unverified beside a table that no capture was exported to.
void refuse_unverified(const CsvTable& table, const CalibrateWords& words);
// The files that the words name.
Words inputs_of(const CalibrateWords& words);

}  // namespace viscard
