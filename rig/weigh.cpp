#include "rig/weigh.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr int kFewest = 10;
constexpr double kMostDrift = 1e-3;  // of the largest load, between the two halves of a mean
constexpr double kPatience_wall_s = 5.0;

struct Collected {
  std::vector<double> readings;
  int n_saturated = 0;
};

double mean_of(const std::vector<double>& values, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += values[i];
  return sum / static_cast<double>(to - from);
}

WeighedLoad load_from(const Collected& collected, double force_N, double full_reading) {
  const std::vector<double>& readings = collected.readings;
  const auto n = static_cast<int>(readings.size());
  const std::string which = "with " + text_from_number(force_N, 4) + " N on the load cell ";
  if (collected.n_saturated > 0) {
    throw RigError(which +
                   "the amplifier is at the end of its range. Use smaller weights or less "
                   "amplification");
  }
  if (n < kFewest) {
    throw RigError(which + "only " + std::to_string(n) +
                   " readings came. Check the load cell with: viscard rig check");
  }
  WeighedLoad load{force_N, mean_of(readings, 0, readings.size()), 0.0, n};
  for (const double reading : readings) {
    load.sd += (reading - load.reading) * (reading - load.reading) / (n - 1);
  }
  load.sd = std::sqrt(load.sd);
  const std::size_t half = readings.size() / 2;
  const double drift = mean_of(readings, half, readings.size()) - mean_of(readings, 0, half);
  const double noise = 2.0 * load.sd / std::sqrt(static_cast<double>(half));
  if (std::abs(drift) > kMostDrift * full_reading + 3.0 * noise) {
    throw RigError(which +
                   "the reading still drifts. Wait until the weight hangs still, or set a longer "
                   "--settle");
  }
  return load;
}

}  // namespace

std::vector<WeighedLoad> weigh(LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                               const std::vector<double>& forces_N, const WeighOptions& options) {
  const Pump pump = [&] {
    wait_readable({&load_cell.transport()}, clock, 0.005);
    load_cell.service();
    if (options.stop != nullptr && *options.stop) throw RigError("the weighing was interrupted");
  };
  load_cell.connect(pump);
  double largest_N = options.largest_N;
  for (const double force_N : forces_N) largest_N = std::max(largest_N, force_N);
  const double full_reading = largest_N * std::abs(rig.calibration.volts_per_newton);
  std::vector<WeighedLoad> loads;
  for (const double force_N : forces_N) {
    if (!options.put_on(force_N)) throw RigError("the weighing was ended before its last weight");
    const double from_s = clock.now_s() + options.settle_s;
    const double to_s = from_s + options.mean_s;
    Collected collected;
    bool is_complete = false;
    load_cell.set_listener([&](const LoadSample& sample) {
      const double made_s = load_cell.made_at_s(sample);
      is_complete = is_complete || made_s >= to_s;
      if (made_s < from_s || made_s >= to_s || sample.is_glitch) return;
      if (sample.is_saturated) ++collected.n_saturated;
      if (const auto reading = reading_from_sample(sample, rig.load_cell)) {
        collected.readings.push_back(*reading);
      }
    });
    const double deadline_s =
        clock.awake_s() + (to_s - clock.now_s()) / clock.speed() + kPatience_wall_s;
    while (!is_complete && clock.awake_s() < deadline_s) pump();
    load_cell.set_listener({});
    loads.push_back(load_from(collected, force_N, full_reading));
  }
  return loads;
}

}  // namespace viscard
