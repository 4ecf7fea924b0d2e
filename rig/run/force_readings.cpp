#include "rig/run/force_readings.h"

#include "models/experiment/sample_force.h"

#include <algorithm>
#include <cmath>

namespace viscard {

ForceReadings::Reading ForceReadings::take(const LoadSample& sample, double made_at_s) {
  const std::optional<double> reading_N = force_N_from_sample(sample, rig_);
  const double absolute_N = reading_N.value_or(tare_N_);
  const double force_N = absolute_N - tare_N_;
  const bool is_doubtful =
      sample.is_glitch || sample.is_saturated || !reading_N || !std::isfinite(*reading_N);
  if (is_doubtful) return {force_N, true};
  force_N_ = force_N;
  ++n_forces_;
  peak_force_N_ = std::max(peak_force_N_, force_N);
  if (threshold_N_ && std::abs(force_N) > *threshold_N_) has_exceeded_ = true;
  last_made_s_ = std::max(last_made_s_, made_at_s);
  newest_made_s_ = made_at_s;
  if (collects_from_s_ && made_at_s >= *collects_from_s_) collect(absolute_N, made_at_s);
  return {force_N, false};
}

void ForceReadings::add_to_tare(double force_N) {
  tare_N_ += force_N;
  force_N_ -= force_N;
  peak_force_N_ = 0.0;
}

void ForceReadings::watch(std::optional<double> threshold_N) {
  threshold_N_ = threshold_N;
  has_exceeded_ = false;
}

void ForceReadings::collect_from(double time_s) {
  collects_from_s_ = time_s;
  collected_until_s_ = time_s;
  collected_N_.clear();
}

void ForceReadings::collect(double absolute_N, double made_at_s) {
  if (collected_N_.empty()) collected_first_s_ = made_at_s;
  collected_N_.push_back(absolute_N);
  collected_until_s_ = made_at_s;
}

ForceMean ForceReadings::collected_mean() const {
  ForceMean result;
  result.n = n_collected();
  double sum_N = 0.0;
  for (const double force_N : collected_N_) sum_N += force_N;
  const double mean_N = sum_N / result.n;
  double squares_N2 = 0.0;
  for (const double force_N : collected_N_) squares_N2 += (force_N - mean_N) * (force_N - mean_N);
  result.force_N = mean_N - tare_N_;
  result.sd_N = std::sqrt(squares_N2 / (result.n - 1));
  result.rate_Hz = (result.n - 1) / std::max(1e-9, collected_until_s_ - collected_first_s_);
  return result;
}

}  // namespace viscard
