#pragma once

#include "io/flow/capture_to_file.h"
#include "models/quantities/plausible.h"
#include "rig/run/preflight.h"

#include <cstdint>
#include <optional>
#include <string>

namespace viscard {

// The files that describe one capture. An emulated rig needs none of them.
struct SetupRequest {
  std::optional<std::string> rig_file, test_file, truth_file;
  std::string specimen_file;  // empty: the emulated rig's own
  bool is_emulated = false;
  std::optional<std::uint64_t> seed;
  double speed = 1.0;  // of the emulated clock over the wall clock
  RigFault fault;      // of the emulated rig
  int touch = 1;       // on the specimen; emulated touches may differ from each other
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any value in the files
};

// The largest speed of an emulated clock.
inline constexpr double kFastestEmulation = 500.0;

// Without a truth file, an emulated specimen has the geometry of the specimen file and the material
// of the demonstration, or its relaxation with the guessed modulus. Throws std::runtime_error on a
// bad file.
CaptureSetup setup_from_files(const SetupRequest& request);

// Throws std::invalid_argument for a fault that this test never reaches: its phase is none of the
// test, which are named, or it begins later than the plan lets that phase last.
void check_fault(const RigFault& fault, const TestPlan& plan);

// What the test is expected to do. Throws CodedError "preflight" if it would overload the cell or
// cannot be carried out by this rig.
Preflight safe_preflight(const CaptureSetup& setup);

// Throws CodedError "calibration" if the calibration has expired or is dated later than today.
// Returns why it is doubtful (it has no date), or "".
std::string refuse_expired_calibration(const LoadCellCalibration& calibration);

}  // namespace viscard
