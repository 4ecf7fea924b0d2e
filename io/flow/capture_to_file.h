#pragma once

#include "io/capture/capture_file.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"
#include "rig/emulator/rig_fault.h"
#include "rig/run/run_control.h"
#include "rig/run/run_outcome.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// All that one run needs, read from files; an emulated rig has defaults for missing files.
struct CaptureSetup {
  RigConfig rig;
  TestPlan plan;
  Specimen specimen;
  std::optional<EmulatedTruth> truth;  // of an emulated rig
  RigFault fault;                      // of an emulated rig
};

// Runs between which the stage is not homed, with home = true under [stage]: the first one homes it
// before its test, the last one after its lift, unless one of them was doubtful.
struct SeriesHoming {
  bool is_last = true;  // the run that comes next
  bool is_doubtful = false;
  bool has_homed = false;           // an earlier run
  bool has_answered = false;        // the load cell, to the contact of an earlier run
  std::optional<HomedStage> homed;  // if its driver compares the count
  // Of an emulated stage: what it has lost so far, and where it counts itself on its bench.
  double emulated_lost_m = 0.0, emulated_counted_m = 0.0;
};

// One capture: what is run, and the file it goes to.
struct CaptureRequest {
  CaptureSetup setup;
  std::filesystem::path path;
  bool overwrite = false;
  std::string command;  // recorded in the file as its origin
  // A punch that presses before the test is lifted, and the test goes on instead of ending.
  bool lifts_at_start = false;
  SeriesHoming* homing = nullptr;  // of a series; none: the run stands alone
};

// Callbacks and flags of a person or program that watches a capture. Any of them may be empty.
struct CaptureWatch {
  const std::atomic<bool>* stop = nullptr;          // ends the run when set
  const std::atomic<bool>* stop_at_once = nullptr;  // the same without braking
  // The file is open and the drivers are ready; the writer lives until `closing` has returned.
  std::function<void(const RigConfig& rig, const CaptureWriter& writer)> opened;
  std::function<void(const RunProgress& now)> progress;
  std::function<void(const RunReading& reading)> reading;  // every one that is not doubtful
  std::function<void()> closing;                           // the run is over, also if it threw
  std::function<void(const std::string& text)> note;       // after `closing`: what else to know
};

// Opens both ports (or makes an emulated rig), creates the file and runs one test. A capture that
// is replaced is kept until the stage has moved. Beside a capture of an emulated rig its truth is
// written (emulated_truth.h). Throws std::runtime_error if the test could not begin.
RunOutcome capture_to_file(const CaptureRequest& request, const CaptureWatch& watch);

// What homing after the last run of a series has shown holds for all runs since the stage was homed
// before: adds it to the outcome and the capture of each earlier one. A capture that cannot be
// changed does not keep it from the others.
struct EarlierRun {
  std::filesystem::path path;
  RunOutcome* outcome = nullptr;
};
// A capture in which it is missing.
struct UnchangedCapture {
  std::filesystem::path path;
  std::string why;  // what is missing, and why it could not be added; with the path
};
// Returns the captures in which the count of the last run is missing.
std::vector<UnchangedCapture> share_count(const std::vector<EarlierRun>& earlier,
                                          const RunOutcome& last);

// Extension of the file, beside an emulated capture, that holds its truth.
inline constexpr const char* kTruthEnding = ".truth.json";

// The truth as JSON for the file beside the capture: the result that a fit of the run should find.
std::string json_from_truth(const EmulatedTruth& truth);

// Reads a truth file written by a user (TOML) or by `viscard capture --emulate` (JSON). Throws
// std::runtime_error naming the file.
EmulatedTruth truth_from_file(const std::string& path);

}  // namespace viscard
