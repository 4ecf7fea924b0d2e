#pragma once

#include "models/experiment/captured_run.h"
#include "models/experiment/run_timing.h"

namespace viscard {

// The times that fit_indentation() uses for a captured run: the readings on the clock of
// indentation_from_capture(), and the fitted start of each move in contact. The start of the
// retraction is fitted to the force in the same way as the first contact. Other moves keep their
// recorded start; so do all moves of a run that cannot be fitted, and the description states why.
RunTiming timing_from_capture(const CapturedRun& run);

}  // namespace viscard
