// viscard fit --want: what to measure next.
#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"
#include "io/flow/planning/next_test.h"
#include "io/flow/planning/plan_tests.h"

#include <stdexcept>

namespace viscard {

void check_want(const FitCommand& command) {
  const bool is_capture = command.files.size() == 1 && command.files.front().ends_with(".viscap");
  if (!command.want.empty() && !is_capture) {
    throw UsageError("--want needs a single capture (*.viscap), which holds its rig and its test");
  }
  for (const std::string& text : command.want) {
    try {
      wanted_from_text(text);
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
}

NextMeasurements next_of(const FileOutcome& outcome, const Words& want) {
  if (want.empty()) return std::nullopt;
  const FittedFile& fitted = *outcome.fitted;
  return next_after_capture(outcome.path, fitted.result, fitted.specimen, want);
}

}  // namespace viscard
