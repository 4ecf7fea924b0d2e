#pragma once

#include "io/flow/fit_file.h"
#include "rig/rig_check.h"
#include "rig/run/run_outcome.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace viscard {

// The objects that commands print with --json and that the page at the rig receives.

// `viscard rig check`; with "error" if the rig is not fit for a test.
nlohmann::ordered_json json_from_rig_check(const RigCheck& found);
// One run of `viscard capture`, with "error" if it did not finish; file: of the capture.
nlohmann::ordered_json json_from_outcome(const RunOutcome& outcome, const std::string& file);
// `viscard fit`: its keys are those of FitResult with the unit in the name. Numbers that are not
// finite become null.
nlohmann::ordered_json json_from_fit(const FittedFile& fitted);

}  // namespace viscard
