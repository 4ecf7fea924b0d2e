#pragma once

#include "models/experiment/captured_run.h"

#include <string>

namespace viscard {

// The samples of a capture as CSV (columns: io/capture/capture_export.h), with times and positions
// on the clock that the fit uses, so that a fit of the table agrees with a fit of the capture. The
// starts of the moves need a fit of the run; if that fails they are as recorded, and the head of the
// table states so.
std::string table_from_capture(const CapturedRun& run);

}  // namespace viscard
