#pragma once

#include "io/cli/words/streams.h"
#include "models/experiment/emulated_specimen.h"
#include "models/material/material.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// viscard report: writes one HTML page about captures, tables, material files and a joint fit.
int run_report(const Words& words, Streams& streams);

// Runs one viscard command line and returns its exit status.
using CommandRunner = std::function<int(const Words& words, Streams& streams)>;

// viscard demo: runs the whole flow on the emulated rig for the three mixing ratios of data/demo.
// Each step is a command as a user would type it, run by `run_command`. A step is skipped whose output is
// what a finished step made of the same inputs (demo_record.h).
int run_demo(const Words& words, Streams& streams, const CommandRunner& run_command);

// Truth, estimate and 95 % interval of one fitted number.
struct ScoreRow {
  std::string specimen;
  std::string quantity;  // "E0", "g_1", "tau_1" ...
  std::string unit;
  double truth = 0.0;
  double estimate = 0.0;
  Interval interval_95;
  bool is_inside = false;
};

// One row for E0 and for every g and tau of the truth, in its order. If the fit does not have a
// term, its estimate is NaN and it counts as missed.
std::vector<ScoreRow> score_rows(const std::string& specimen, const EmulatedTruth& truth,
                                 const Material& estimate);

// The rows as a text table, moduli in MPa.
std::string table_from_scores(const std::vector<ScoreRow>& rows);

}  // namespace viscard
