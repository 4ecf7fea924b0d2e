#pragma once

#include "fit/planning/predicted_errors.h"

#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// A possible next measurement after a fit, and how much it narrows the intervals.
struct NextMeasurement {
  std::string what;      // "another touch with a hold of 240 s"
  std::string how;       // "viscard calibrate --compliance"; empty: no command
  std::string quantity;  // the wanted one that is widest against its tolerance
  double before = 0.0;   // relative half-width of its 95 % interval, with systematic parts ...
  double after = 0.0;    // ... and after the measurement
  double minutes = 0.0;  // at the rig
  double gain_per_minute() const { return (before - after) / minutes; }
};

void show_keys(ResultVisitor& v, const NextMeasurement& next);

// A fitted capture: what was measured, and how.
struct FittedRun {
  TestPlan plan;
  Bench bench;  // performance.noise_N: that of the fit
  FitResult fit;
};

// The information of the fit, in the form of a prediction.
PredictedFit known_fit(const FittedRun& run);

// Proposes the next measurements: further touches (as before, with a longer hold, with a longer
// recovery), a frame, a calibration and a geometry known twice as well, a layer twice as thick.
// They are sorted by how much they narrow the widest wanted interval per minute. The information of
// a further touch is added to that of the fit. Throws std::invalid_argument if the fit has no
// geometry or no such quantity.
std::vector<NextMeasurement> next_measurements(const FittedRun& run,
                                               const std::vector<WantedQuantity>& wanted);

// The first proposal as a sentence with its numbers, compared with the second.
std::string text_of_next(const std::vector<NextMeasurement>& measurements);

}  // namespace viscard
