#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/material/material.h"

#include <string>
#include <vector>

namespace viscard {

// Truth, estimate and 95 % interval of one fitted number, side by side.
struct ScoreRow {
  std::string specimen;
  std::string quantity;  // "E0", "g_1", "tau_1" ...
  std::string unit;
  double truth = 0.0;
  double estimate = 0.0;
  Interval interval_95;
  bool is_inside = false;
};

// E0, every g and tau of the truth, in its order. A term the fit does not have gets NaN for its
// estimate and counts as missed.
std::vector<ScoreRow> score_rows(const std::string& specimen, const EmulatedTruth& truth,
                                 const Material& estimate);

// The rows as a table a person can read; moduli in MPa.
std::string table_from_scores(const std::vector<ScoreRow>& rows);

}  // namespace viscard
