#pragma once

#include "models/experiment/captured_run.h"

#include <string>
#include <vector>

namespace viscard {

// The samples of a capture as CSV (columns: io/capture/capture_export.h), with times and positions
// on the clock that the fit uses, so that a fit of the table agrees with a fit of the capture. The
// starts of the moves need a fit of the run; if that fails they are as recorded, and the head of the
// table states so.
std::string table_from_capture(const CapturedRun& run);

// The force of a capture from the first contact to the retraction, for pictures of several: averages of
// readings over 0.4 % of the time since the last motion began.
struct ContactCurve {
  double contact_s = 0.0;       // of the first motion into the specimen, on the clock of the fit
  double zero_N = 0.0;          // mean force before it, which is subtracted
  std::vector<double> time_s;   // since contact_s
  std::vector<double> force_N;  // above zero_N
};
// Throws as indentation_from_capture() does.
ContactCurve contact_curve(const CapturedRun& run);

}  // namespace viscard
