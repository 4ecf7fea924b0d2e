#pragma once

#include "fit/samples/fit_data.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/rig_performance.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

namespace viscard {

// A rig and the specimen on it.
struct Bench {
  RigConfig rig;
  RigPerformance performance;
  Specimen specimen;
};

// The data that one run of a test will record, before it is made: the times of the readings, the
// moves of the stage, and the duration of the run. data.force_N are zeros, because the information
// of a run does not depend on the values of the readings.
struct PlannedRun {
  IndentationData data;
  double total_s = 0.0;       // at the rig, from the start of the run to its end
  double peak_force_N = 0.0;  // elastic, at the largest depth
};

// The moves of a test whose phases are moves and holds of the stage ("ramp-hold", "levels", "cycles",
// "staircase"). Like the rig, it converts depths to stage travel with the specimen's modulus_guess.
// Throws std::invalid_argument for other protocols, as phases_from_plan() does, and if a number of
// the rig or of the specimen is missing.
PlannedRun planned_run(const TestPlan& plan, const Bench& bench);

}  // namespace viscard
