#pragma once

#include "io/flow/command_error.h"
#include "rig/move_stage.h"
#include "rig/rig_check.h"
#include "rig/run/run_outcome.h"
#include "rig/zero_force.h"

#include <optional>
#include <string>

namespace viscard {

class ResultVisitor;

// The keys of `viscard rig check`; with "error" if the rig is not fit for a test.
void show_keys(ResultVisitor& v, const RigCheck& found);

// The keys of `viscard rig jog`.
void show_keys(ResultVisitor& v, const StageMoved& moved);
// The keys of `viscard rig zero-force`.
void show_keys(ResultVisitor& v, const ZeroedForce& zeroed);

// A capture of `viscard capture`: a run, or why there was none.
struct CaptureOfSeries {
  std::string file;
  std::string status;  // of a run that was not made: "not begun", "finished before"
  // Of one that could not begin, or could not be changed after it had finished.
  std::optional<CommandError> error;
  std::optional<RunOutcome> run;
  std::string specimen;  // of a repeated one
  int touch = 0;         // from 1; 0: not repeated
};
// With "error" if it did not finish, or could not be changed afterwards.
void show_keys(ResultVisitor& v, const CaptureOfSeries& capture);
// How the capture ended, in one word.
std::string status_of(const CaptureOfSeries& capture);
// Why it did not finish, or could not be changed afterwards; nothing if all is well.
std::optional<CommandError> error_of(const CaptureOfSeries& capture);

}  // namespace viscard
