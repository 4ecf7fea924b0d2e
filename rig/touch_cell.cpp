#include "rig/touch_cell.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/run/rest_findings.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace viscard {
namespace {

constexpr double kZero_s = 2.0;
constexpr int kFewestOfZero = 5;
constexpr double kTouchSigmas = 8.0;
constexpr double kTouchShare = 0.01;  // of the capacity
constexpr double kReleased = 0.5;     // of the force that counts as a touch
constexpr int kTouchReadings = 3;
constexpr double kDriftSigmas = 6.0;

// The readings of the load cell from the connection on.
struct TouchReadings {
  std::vector<double> force_N, made_s;
  LifeWatch life;
};

// The force without a touch, which may drift a little.
struct CellZero {
  RestReadings seen;
  double middle_s = 0.0, drift_N_s = 0.0;
  double change_N(double force_N, double made_s) const {
    return std::abs(force_N - seen.force_N - drift_N_s * (made_s - middle_s));
  }
};

// Throws what forbids a test, because it would look like a touch, too.
CellZero zero_of(const TouchReadings& readings, const RigConfig& rig) {
  if (readings.force_N.size() < kFewestOfZero) {
    throw RigError("only " + counted(readings.force_N.size(), "reading") + " came in " +
                   text_from_number(kZero_s, 0) +
                   " s. Check the load cell with: viscard rig check");
  }
  const auto n = static_cast<double>(readings.force_N.size());
  const double took_s = readings.made_s.back() - readings.made_s.front();
  CellZero zero{.middle_s = 0.5 * (readings.made_s.front() + readings.made_s.back())};
  RestReadings& seen = zero.seen;
  for (const double one_N : readings.force_N) seen.force_N += one_N / n;
  for (const double one_N : readings.force_N) {
    seen.noise_N += (one_N - seen.force_N) * (one_N - seen.force_N) / (n - 1.0);
  }
  seen.noise_N = std::sqrt(seen.noise_N);
  seen.drift = drift_of(readings.force_N, seen.noise_N, took_s);
  seen.rate_Hz = took_s > 0.0 ? (n - 1.0) / took_s : 0.0;
  seen.life = readings.life.signs();
  for (const RestFinding& found : findings_at_rest(seen, rig)) throw RigError(found.text);
  const bool drifts = std::abs(seen.drift.N_per_s) > kDriftSigmas * seen.drift.u_N_per_s;
  zero.drift_N_s = drifts ? seen.drift.N_per_s : 0.0;
  return zero;
}

}  // namespace

double await_touch(LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                   const TouchOptions& options) {
  const Pump pump = [&] {
    wait_readable({&load_cell.transport()}, clock, 0.005);
    load_cell.service();
    if (options.stop != nullptr && *options.stop) throw RigError("the wait for a touch was ended");
  };
  load_cell.connect(pump);
  TouchReadings readings;
  load_cell.set_listener([&](const LoadSample& sample) {
    const double made_s = load_cell.made_at_s(sample);
    if (sample.is_saturated) readings.life.take_at_end();
    const auto one_N = force_N_from_sample(sample, rig);
    if (!one_N || sample.is_glitch || sample.is_saturated) return;
    readings.force_N.push_back(*one_N);
    readings.made_s.push_back(made_s);
    readings.life.take(received_value(sample), made_s);
  });
  const double zero_until_s = clock.now_s() + kZero_s;
  while (clock.now_s() < zero_until_s) pump();
  const CellZero zero = zero_of(readings, rig);
  const double felt_N =
      std::max(kTouchSigmas * zero.seen.noise_N, kTouchShare * rig.calibration.capacity_N);
  double largest_N = 0.0;
  std::size_t taken = readings.force_N.size();
  // Waits for some changes of the force in a row that are as asked.
  const auto comes = [&](const std::function<bool(double)>& is_asked) {
    const double until_s = clock.now_s() + options.wait_s;
    for (int n_asked = 0; n_asked < kTouchReadings;) {
      if (clock.now_s() >= until_s) return false;
      pump();
      for (; taken < readings.force_N.size() && n_asked < kTouchReadings; ++taken) {
        const double change_N = zero.change_N(readings.force_N[taken], readings.made_s[taken]);
        n_asked = is_asked(change_N) ? n_asked + 1 : 0;
        if (change_N > felt_N) largest_N = std::max(largest_N, change_N);
      }
    }
    return true;
  };
  if (options.ready) options.ready();
  if (!comes([&](double change_N) { return change_N > felt_N; })) {
    throw RigError("the load cell has not answered within " + text_from_number(options.wait_s, 0) +
                   " s: no force differed from its zero by more than " +
                   text_from_number(felt_N * 1e3, 1) +
                   " mN. Is the finger or weight on the cell itself, and is the amplifier "
                   "connected to it?");
  }
  if (options.felt) options.felt();
  if (!comes([&](double change_N) { return change_N < kReleased * felt_N; })) {
    throw RigError("the force changed by " + text_from_number(largest_N, 4) +
                   " N and did not come back within " + text_from_number(options.wait_s, 0) +
                   " s. If the finger or weight is away, it was no touch: the cell drifts or its "
                   "zero has jumped. Check its wires, let the amplifier warm up, and repeat it");
  }
  load_cell.set_listener({});
  return largest_N;
}

}  // namespace viscard
