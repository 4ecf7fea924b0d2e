#include "io/cost/effect_savings.h"

#include "io/cost/study_trials.h"
#include "models/maths/may_stop.h"

#include <algorithm>

namespace viscard {
namespace {

constexpr double kLong_s = 0.5;
// Unknowns of a row: its pieces are condensed as full matrices, gigabytes beyond this.
constexpr double kLargestRow = 2e4;

struct TimedRun {
  double cpu_s = 0.0;
  int unknowns = 0;
};

// The quicker of two runs unless the first took long: the first one also waits for memory.
TimedRun timed(const CostTrial& trial, const CostClock& clock) {
  TimedRun best;
  for (int i = 0; i < 2; ++i) {
    const double before_s = clock.cpu_s();
    best.unknowns = trial.run().unknowns;
    const double cpu_s = clock.cpu_s() - before_s;
    best.cpu_s = i == 0 ? cpu_s : std::min(cpu_s, best.cpu_s);
    if (cpu_s > kLong_s) break;
  }
  return best;
}

}  // namespace

std::vector<EffectSaving> effect_savings(const Scene& scene, double limit_s,
                                         const CostClock& clock) {
  const double start_s = clock.cpu_s();
  const auto left_s = [&] { return limit_s - (clock.cpu_s() - start_s); };
  const StopCheck stop([&] {
    if (left_s() < 0.0) throw OutOfTime();
  });
  std::vector<EffectSaving> savings;
  try {
    std::vector<CostTrial> trials = effect_trials_on(scene, 2, 1);
    if (trials.size() < 2) return {};
    if (std::holds_alternative<ArrayScene>(scene) &&
        mesh_size(scene, trials.front().mesh) > kLargestRow)
      return {};
    TimedRun with = timed(trials.front(), clock);
    if (with.cpu_s < kLong_s / 10.0) {  // degree 4 takes about ten times as long as degree 2
      trials = effect_trials_on(scene, 4, 2);
      with = timed(trials.front(), clock);
    }
    for (std::size_t i = 1; i < trials.size(); ++i) {
      if (left_s() < with.cpu_s) break;
      const TimedRun without = timed(trials[i], clock);
      savings.push_back({.effect = trials[i].effects,
                         .discretisation = trials[i].discretisation,
                         .unknowns = with.unknowns,
                         .unknowns_without = without.unknowns,
                         .cpu_s = with.cpu_s,
                         .cpu_s_without = without.cpu_s});
    }
  } catch (const OutOfTime&) {  // those before stand
  }
  return savings;
}

}  // namespace viscard
