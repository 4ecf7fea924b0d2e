#pragma once

#include "models/experiment/sample_force.h"
#include "rig/lines/rig_error.h"
#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// Runs of one instrument over disturbed lines, counted.
struct FaultTally {
  int finished = 0, ended = 0, refused = 0;
  long long faults = 0, readings = 0, wrong = 0;
  double worst = 0.0;  // error of a wrong reading over the detection threshold
};

inline TestPlan shortest_test() {
  TestPlan plan;
  plan.approach_speed_m_s = 0.2e-3;
  plan.baseline_s = 0.5;
  plan.hold_s = 1.0;
  plan.recovery_s = 0.5;
  return plan;
}

// The largest step between neighbours among sent[from, to).
inline double largest_step(const std::vector<double>& sent, std::size_t from, std::size_t to) {
  double largest = 0.0;
  for (std::size_t i = from + 1; i < to; ++i) {
    largest = std::max(largest, std::abs(sent[i] - sent[i - 1]));
  }
  return largest;
}

// A reading that is not marked is one of those sent about then, or differs from them by less than
// can be noticed. sent: what the instrument sent, in the unit of the calibration.
inline void check_readings_were_sent(const DeviceFixture& rig, const std::vector<double>& sent,
                                     double noise, FaultTally& tally) {
  constexpr double kNoticed = 12.0, kNoticedSteps = 2.5;
  std::set<std::string> marked;
  for (const RunEvent& event : rig.all<RunEvent>()) {
    if (event.name == "implausible") marked.insert(event.value);
  }
  const std::vector<LoadSample> samples = rig.all<LoadSample>();
  tally.readings += static_cast<long long>(samples.size());
  const std::size_t n_lost = sent.size() > samples.size() ? sent.size() - samples.size() : 0;
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const LoadSample& sample = samples[row];
    const auto value = reading_from_sample(sample, rig.config.load_cell);
    if (!value || sample.is_glitch || sample.is_saturated) continue;
    if (marked.count(std::to_string(sample.index)) > 0) continue;
    const std::size_t from = row < 8 ? 0 : row - 8, to = std::min(sent.size(), row + n_lost + 8);
    double off = 1e9;
    for (std::size_t i = from; i < to; ++i) off = std::min(off, std::abs(sent[i] - *value));
    if (off < 1e-9) continue;
    ++tally.wrong;
    const double notice = std::max(kNoticed * noise, kNoticedSteps * largest_step(sent, from, to));
    tally.worst = std::max(tally.worst, off / notice);
    INFO("reading " << sample.index << " of " << samples.size() << ": " << *value << " is off by "
                    << off << ", noticed from " << notice);
    CHECK(off <= notice);
  }
}

// The run ends finished or with a reason, at rest, lifted unless the reason states otherwise, and
// with a whole cell.
inline void run_disturbed(const EmulatedRigOptions& options, std::uint64_t seed,
                          const std::function<std::vector<double>(DeviceFixture&)>& sent,
                          FaultTally& tally) {
  DeviceFixture rig(options, faults_of(seed));
  std::string status, reason;
  try {
    const RunOutcome outcome = rig.run(shortest_test());
    status = outcome.status;
    reason = outcome.reason;
    ++(status == "finished" ? tally.finished : tally.ended);
  } catch (const RigError& error) {  // before anything moved
    status = "refused";
    reason = error.what();
    ++tally.refused;
  }
  INFO(status << ": " << reason);
  const double until_s = rig.clock.awake_s() + 40.0;
  while (rig.emulated.outcome().is_moving && rig.clock.awake_s() < until_s) {
    wait_readable({}, rig.clock, 0.005);
  }
  const EmulatedOutcome bench = rig.emulated.outcome();
  CHECK_FALSE(bench.is_moving);
  CHECK_FALSE(bench.is_cell_broken);
  const bool is_said =
      reason.find("by hand") != std::string::npos || reason.find("And: ") != std::string::npos;
  if (!is_said) CHECK(bench.final_position_m < options.truth.surface_position_m);
  if (status != "finished") CHECK(reason.size() > 20);
  const double gain = rig.config.calibration.volts_per_newton;
  check_readings_were_sent(rig, sent(rig), gain * options.truth.force_noise_N, tally);
  tally.faults += rig.stage_proxy->counts().faults + rig.cell_proxy->counts().faults;
}

}  // namespace viscard
