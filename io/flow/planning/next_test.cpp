#include "io/flow/planning/next_test.h"

#include "io/capture/capture_file.h"
#include "io/flow/planning/plan_tests.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

// The rig as this run shows it.
RigPerformance performance_of(const CapturedRun& run, const FitResult& fit) {
  RigPerformance performance;
  performance.noise_N = fit.noise.sigma;
  for (const CommandedMove& move : run.moves) {
    if (move.purpose != "ramp") continue;
    performance.acceleration_m_s2 = move.move.acceleration_m_s2;
    performance.approach_s = std::max(0.0, move.move.start_time_s - run.plan.baseline_s);
    break;
  }
  return performance;
}

}  // namespace

std::vector<NextMeasurement> next_after_capture(const std::string& path, const FitResult& fit,
                                                const Specimen& specimen,
                                                const std::vector<std::string>& want) {
  std::vector<WantedQuantity> wanted;
  for (const std::string& text : want) wanted.push_back(wanted_from_text(text));
  const CapturedRun run = read_capture(path, {.accepts_damage = true});  // the fit has judged it
  FittedRun fitted{run.plan, {run.rig, performance_of(run, fit), specimen}, fit};
  fitted.bench.specimen.modulus_guess_Pa = fit.E0_Pa;
  return next_measurements(fitted, wanted);
}

}  // namespace viscard
