// viscard fit --want: what to measure next.
#include "io/cli/fit/fit_next.h"

#include "io/cli/words/command_line.h"
#include "io/flow/planning/next_test.h"
#include "io/flow/planning/plan_tests.h"

#include <stdexcept>

namespace po = boost::program_options;

namespace viscard {

void add_next_option(po::options_description& options) {
  options.add_options()(
      "want", po::value<Words>()->composing(),
      "of one capture: a quantity and the relative half-width of its 95 % interval, such as g_2=5% "
      "(repeatable; E0, E_inf, sum_g, E_i, g_i, tau_i); prints what to measure next: what narrows "
      "the "
      "widest one most for a minute at the rig");
}

Words next_words(const po::variables_map& values, const Words& files) {
  Words want = given<Words>(values, "want").value_or(Words{});
  if (!want.empty() && (files.size() != 1 || !files.front().ends_with(".viscap"))) {
    throw UsageError("--want needs a single capture (*.viscap), which holds its rig and its test");
  }
  for (const std::string& text : want) {
    try {
      wanted_from_text(text);
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  return want;
}

NextMeasurements next_of(const FileOutcome& outcome, const Words& want) {
  if (want.empty()) return std::nullopt;
  const FittedFile& fitted = *outcome.fitted;
  return next_after_capture(outcome.path, fitted.result, fitted.specimen, want);
}

}  // namespace viscard
