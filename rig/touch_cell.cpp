#include "rig/touch_cell.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace viscard {
namespace {

constexpr double kZero_s = 1.0;
constexpr int kFewestOfZero = 5;
constexpr double kTouchSigmas = 8.0;
constexpr double kTouchShare = 0.01;  // of the capacity
constexpr int kTouchReadings = 3;

struct CellZero {
  double force_N = 0.0, noise_N = 0.0;
};

CellZero zero_of(const std::vector<double>& force_N) {
  if (force_N.size() < kFewestOfZero) {
    throw RigError("only " + counted(force_N.size(), "reading") +
                   " came in a second. Check the load cell with: viscard rig check");
  }
  CellZero zero;
  const auto n = static_cast<double>(force_N.size());
  for (const double one_N : force_N) zero.force_N += one_N / n;
  for (const double one_N : force_N) {
    zero.noise_N += (one_N - zero.force_N) * (one_N - zero.force_N) / (n - 1.0);
  }
  zero.noise_N = std::sqrt(zero.noise_N);
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
  std::vector<double> force_N;
  load_cell.set_listener([&](const LoadSample& sample) {
    const auto one_N = force_N_from_sample(sample, rig);
    if (one_N && !sample.is_glitch && !sample.is_saturated) force_N.push_back(*one_N);
  });
  const double zero_until_s = clock.now_s() + kZero_s;
  while (clock.now_s() < zero_until_s) pump();
  const CellZero zero = zero_of(force_N);
  const double felt_N =
      std::max(kTouchSigmas * zero.noise_N, kTouchShare * rig.calibration.capacity_N);
  if (options.ready) options.ready();
  const double until_s = clock.now_s() + options.wait_s;
  double largest_N = 0.0;
  int n_felt = 0;
  std::size_t seen = force_N.size();
  while (n_felt < kTouchReadings && clock.now_s() < until_s) {
    pump();
    for (; seen < force_N.size(); ++seen) {
      const double change_N = std::abs(force_N[seen] - zero.force_N);
      n_felt = change_N > felt_N ? n_felt + 1 : 0;
      if (change_N > felt_N) largest_N = std::max(largest_N, change_N);
    }
  }
  load_cell.set_listener({});
  if (n_felt >= kTouchReadings) return largest_N;
  throw RigError("the load cell has not answered within " + text_from_number(options.wait_s, 0) +
                 " s: no force differed from its zero by more than " +
                 text_from_number(felt_N * 1e3, 1) +
                 " mN. Is the finger or weight on the cell itself, and is the amplifier connected "
                 "to it?");
}

}  // namespace viscard
