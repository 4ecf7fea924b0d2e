#pragma once

#include "fit/planning/predicted_errors.h"
#include "tests/support/in_memory_run.h"

namespace viscard::test {

// The bench of in_memory_run(): what a user of that rig would know of it.
inline Bench bench_of(const EmulatedTruth& truth) {
  Bench bench;
  bench.rig.calibration = {0.7255, 0.0, 0.0, 0.25 * 9.80665, "demo", ""};
  bench.rig.frame.stiffness_N_m = truth.frame_stiffness_N_m;
  bench.rig.frame.stiffness_relative_u = 0.02;
  bench.rig.load_cell.expected_rate_Hz = truth.sample_rate_Hz;
  bench.performance.noise_N = truth.force_noise_N;
  bench.performance.gain_drift_1_s = truth.drift_relative_per_s;
  bench.performance.step_m = 1.0 / truth.steps_per_m;
  bench.performance.acceleration_m_s2 = truth.acceleration_m_s2;
  bench.performance.approach_s = 0.0;  // an in-memory run begins with the baseline
  bench.specimen.contact = truth.contact;
  bench.specimen.modulus_guess_Pa = truth.material.E0_Pa;
  return bench;
}

}  // namespace viscard::test
