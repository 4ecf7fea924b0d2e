#include "rig/run/force_readings.h"

#include "models/experiment/sample_force.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kSigmas = 8.0;
// The noise of twenty readings is known to 27 % only, so a mean removes fewer readings.
constexpr double kMeanSigmas = 16.0;
constexpr double kPerStep = 0.954;  // median of the step between two readings over their noise
constexpr double kSteeper = 2.5;    // an end may be so much steeper than the step beside it

// How far the middle value stands out of both others; 0 if it lies between them.
double stands_out(double before, double value, double behind) {
  if ((value - before) * (value - behind) <= 0.0) return 0.0;
  return std::min(std::abs(value - before), std::abs(value - behind));
}

// The same for a value at an end, which has neighbours on one side only.
double end_stands_out(double end, double next, double next_but_one) {
  return std::abs(end - next) - kSteeper * std::abs(next - next_but_one);
}

double middle_of(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Standard deviation of the noise, from the steps between neighbours.
double noise_of_steps(const std::vector<double>& values) {
  std::vector<double> steps;
  double least = 1e300;
  for (std::size_t i = 1; i < values.size(); ++i) {
    steps.push_back(std::abs(values[i] - values[i - 1]));
    if (steps.back() > 0.0) least = std::min(least, steps.back());
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::max(*middle, least < 1e300 ? least : 0.0) / kPerStep;
}

}  // namespace

std::vector<double> without_spikes(const std::vector<double>& values) {
  const std::size_t n = values.size();
  if (n < 5) return values;
  const double cut = kMeanSigmas * noise_of_steps(values);
  std::vector<double> result;
  result.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double by = i == 0       ? end_stands_out(values[0], values[1], values[2])
                      : i == n - 1 ? end_stands_out(values[n - 1], values[n - 2], values[n - 3])
                                   : stands_out(values[i - 1], values[i], values[i + 1]);
    if (!(by > cut)) result.push_back(values[i]);
  }
  return result.size() < 2 ? values : result;
}

Drift drift_of(const std::vector<double>& force_N, double noise_N, double took_s) {
  const std::size_t half = force_N.size() / 2;
  const double between_s = 0.5 * took_s;
  if (half == 0 || !(between_s > 0.0)) return {};
  double early_N = 0.0, late_N = 0.0;
  for (std::size_t i = 0; i < half; ++i) {
    early_N += force_N[i];
    late_N += force_N[force_N.size() - 1 - i];
  }
  const auto n = static_cast<double>(half);
  return {(late_N - early_N) / n / between_s, noise_N * std::sqrt(2.0 / n) / between_s};
}

double felt_difference_N(double noise_N, int n) {
  constexpr double kFeltSigmas = 6.0;
  return kFeltSigmas * noise_N * std::sqrt(2.0 / n);
}

double ForceReadings::sound_force_N(double noise_N) const {
  const double by_N = end_stands_out(force_N_, earlier_N_[0], earlier_N_[1]);
  return n_forces_ >= 3 && by_N > kSigmas * noise_N ? earlier_N_[0] : force_N_;
}

ForceReadings::Reading ForceReadings::take(const LoadSample& sample, double made_at_s) {
  const std::optional<double> reading_N = force_N_from_sample(sample, rig_);
  const double absolute_N = reading_N.value_or(tare_N_);
  const double force_N = absolute_N - tare_N_;
  const bool is_doubtful =
      sample.is_glitch || sample.is_saturated || !reading_N || !std::isfinite(*reading_N);
  if (is_doubtful) return {force_N, true};
  earlier_N_ = {force_N_, earlier_N_[0]};
  force_N_ = force_N;
  ++n_forces_;
  peak_force_N_ = std::max(peak_force_N_, force_N);
  if (watched_ && (force_N < watched_->lowest_N || force_N > watched_->highest_N)) {
    has_exceeded_ = true;
  }
  last_made_s_ = std::max(last_made_s_, made_at_s);
  newest_made_s_ = made_at_s;
  take_rise(made_at_s);
  if (collects_from_s_ && made_at_s >= *collects_from_s_) collect(absolute_N, made_at_s);
  return {force_N, false};
}

void ForceReadings::add_to_tare(double force_N) {
  tare_N_ += force_N;
  force_N_ -= force_N;
  for (double& earlier_N : earlier_N_) earlier_N -= force_N;
  peak_force_N_ = 0.0;
  rise_.reset();
}

void ForceReadings::watch_rise(const MoveAway& away) {
  const double newest_N =
      n_forces_ < 3 ? force_N_ : middle_of(force_N_, earlier_N_[0], earlier_N_[1]);
  const double from_N = std::max(away.least_N, newest_N);
  if (away.goes_on && rise_) {
    rise_->from_N = std::min(rise_->from_N, from_N);
  } else {
    rise_ = Rise{away.from_s, from_N};
  }
  rise_->has_end = rise_->is_over = false;
}

void ForceReadings::end_rise(double at_s) {
  if (!rise_) return;
  rise_->until_s = at_s;
  rise_->has_end = true;
}

void ForceReadings::take_rise(double made_at_s) {
  if (!rise_ || rise_->is_over) return;
  const double force_N = std::min(force_N_, earlier_N_[0]);  // one garbled digit does not count
  if (made_at_s <= rise_->from_s) rise_->from_N = std::max(rise_->from_N, force_N);
  rise_->rise_N = force_N - rise_->from_N;
  rise_->is_over = rise_->has_end && made_at_s > rise_->until_s;
}

void ForceReadings::watch(double lowest_N, double highest_N) {
  watched_ = Range{lowest_N, highest_N};
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
  const std::vector<double> sound_N = without_spikes(collected_N_);
  ForceMean result;
  result.n = static_cast<int>(sound_N.size());
  double sum_N = 0.0;
  for (const double force_N : sound_N) sum_N += force_N;
  const double mean_N = sum_N / result.n;
  double squares_N2 = 0.0;
  for (const double force_N : sound_N) squares_N2 += (force_N - mean_N) * (force_N - mean_N);
  result.force_N = mean_N - tare_N_;
  result.sd_N = std::sqrt(squares_N2 / (result.n - 1));
  result.drift = drift_of(sound_N, result.sd_N, collected_until_s_ - collected_first_s_);
  result.rate_Hz = (n_collected() - 1) / std::max(1e-9, collected_until_s_ - collected_first_s_);
  return result;
}

}  // namespace viscard
