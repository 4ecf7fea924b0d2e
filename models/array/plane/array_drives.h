#pragma once

#include "models/pillar/time/load_history.h"

#include <variant>
#include <vector>

namespace viscard {

// What is done to a row of pillars: one alternative for each analysis (array_analysis.h). The load
// itself, which pillars it presses and which way, stands in ArrayScene.

struct RowStatic {};

struct RowModal {
  int modes = 3;  // clusters of each family
};

struct RowHarmonic {
  std::vector<double> frequencies_Hz;  // ascending
};

struct RowTransient {
  std::vector<HistoryPoint> history;  // load in Pa
  double end_time_s = 0.0;
  int outputs = 1000;  // equal intervals
};

using RowDrive = std::variant<RowStatic, RowModal, RowHarmonic, RowTransient>;

}  // namespace viscard
