#include "rig/run/tare_phase.h"

#include "models/maths/text_of_number.h"
#include "rig/run/preflight.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kSlow = 0.8;        // of the expected rate: measured again, then checked
constexpr double kFarTooSlow = 0.5;  // of the expected rate: refused in any case

// How far an approach overshoots depends on the rate of readings, so the rate in the rig file must
// be true. A rate that is too low is measured twice, because the machine may have stalled.
void check_rate(TestRun& run, const ForceMean& zero, double duration_s) {
  const double expected_Hz = run.rig.load_cell.expected_rate_Hz;
  double rate_Hz = zero.rate_Hz;
  if (rate_Hz < kSlow * expected_Hz) {
    rate_Hz = std::max(rate_Hz, run.session.mean_force(duration_s).rate_Hz);
  }
  if (rate_Hz >= kSlow * expected_Hz) return;
  RigConfig measured = run.rig;
  measured.load_cell.expected_rate_Hz = rate_Hz;
  const Preflight found =
      preflight(measured, run.plan, run.specimen, run.session.stage().dynamics());
  if (found.problems.empty() && rate_Hz >= kFarTooSlow * expected_Hz) return;
  throw RigError("the load cell gives " + text_from_number(rate_Hz, 1) +
                 " readings/s, but expected_rate in the rig file is " +
                 text_from_number(expected_Hz, 1) +
                 " Hz, so the approach would not stop in time: " +
                 remedy_for_slow_readings(run.rig.load_cell) +
                 ", or correct expected_rate under [load_cell] of the rig file");
}

}  // namespace

void carry_out_tare(TestRun& run, const TestPhase& phase) {
  const ForceMean zero = run.session.tare(phase.duration_s);
  run.outcome.noise_N = zero.sd_N;
  if (std::abs(zero.force_N) > kPressesAtStart * limit_N(run)) {
    run.presses_at_start = true;
    throw RigError("the load cell reads " + text_from_number(zero.force_N, 3) +
                   " N before anything was touched. Take away what presses on it, or correct "
                   "zero_volts of the calibration");
  }
  check_rate(run, zero, phase.duration_s);
}

}  // namespace viscard
