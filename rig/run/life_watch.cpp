#include "rig/run/life_watch.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr std::size_t kMostLearnt = 1024;
constexpr std::int64_t kFewestToWatch = 10;
constexpr double kOftenEqual = 0.9;             // above: the resolution hides the noise
constexpr double kNoChance = 1e-12;             // of a stretch of equal readings
constexpr double kManyDigits = 4.0;             // usual step over the smallest one
constexpr double kSomeEqual = 0.3;              // a noise of many digits makes far fewer equal
constexpr double kVanished = 0.12;              // of the noise at rest
constexpr double kGrown = 8.0;                  // times the noise at rest
constexpr double kShownDigits = 4.0;            // smaller noise is shaped by the digits
constexpr double kFaster = 1.4, kSlower = 0.5;  // of the rate at rest
constexpr std::size_t kFewSteps = 8;            // that show a slower rate

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double received_value(const LoadSample& sample) {
  return sample.counts.value_or(sample.volts.value_or(sample.force_N.value_or(0.0)));
}

bool LifeSigns::shows_noise() const {
  return n - n_at_end >= kFewestToWatch && share_equal() < kOftenEqual;
}

bool LifeSigns::repeats_values() const {
  return n >= kFewestToWatch && share_equal() > kSomeEqual && least_step > 0.0 &&
         usual_step > kManyDigits * least_step;
}

void LifeWatch::take(double value, double made_at_s) {
  if (n_taken_ > 0) {
    const double step = std::abs(value - last_);
    n_equal_now_ = step == 0.0 ? n_equal_now_ + 1 : 0;
    n_changes_ += step == 0.0 ? 0 : 1;
    signs_.n_equal += step == 0.0 ? 1 : 0;
    if (step > 0.0 && !is_watching_ && steps_.size() < kMostLearnt) steps_.push_back(step);
  } else {
    signs_.first_s = made_at_s;
  }
  const double bend = n_taken_ < 2 ? 0.0 : std::abs(value - 2.0 * last_ + before_last_);
  if (n_taken_ >= 2 && !is_watching_ && bends_.size() < kMostLearnt) bends_.push_back(bend);
  const auto at = static_cast<std::size_t>(n_taken_) % kRecent;
  recent_bends_[at] = bend;
  recent_s_[at] = made_at_s;
  ++n_taken_;
  ++signs_.n;
  signs_.n_zero += value == 0.0 ? 1 : 0;
  signs_.last_s = made_at_s;
  before_last_ = last_;
  last_ = value;
}

LifeSigns LifeWatch::signs() const {
  LifeSigns signs = signs_;
  signs.least_step = steps_.empty() ? 0.0 : *std::min_element(steps_.begin(), steps_.end());
  signs.usual_step = median_of(steps_);
  signs.noise = median_of(bends_);
  return signs;
}

void LifeWatch::begin_watch(bool has_clock) {
  const LifeSigns found = signs();
  is_watching_ = true;
  has_noise_ = found.shows_noise();
  has_clock_ = has_clock;
  usual_noise_ = found.noise;
  least_step_ = found.least_step;
  const double took_s = found.last_s - found.first_s;
  usual_rate_Hz_ = took_s > 0.0 ? static_cast<double>(found.n - 1) / took_s : 0.0;
}

// The stretch that is judged is no evidence of how often readings are equal.
double LifeWatch::share_equal_before() const {
  return static_cast<double>(signs_.n_equal - n_equal_now_ + 1) /
         static_cast<double>(signs_.n - n_equal_now_ + 1);
}

std::int64_t LifeWatch::most_equal() const {
  return static_cast<std::int64_t>(std::ceil(std::log(kNoChance) / std::log(share_equal_before())));
}

double LifeWatch::rate_Hz(std::size_t n_steps) const {
  const auto taken = static_cast<std::size_t>(n_taken_);
  const double took_s =
      recent_s_[(taken - 1) % kRecent] - recent_s_[(taken - 1 - n_steps) % kRecent];
  return took_s > 0.0 ? static_cast<double>(n_steps) / took_s : 1e9;
}

double LifeWatch::recent_noise() const {
  return median_of(std::vector<double>(recent_bends_.begin(), recent_bends_.end()));
}

LifeWatch::Trouble LifeWatch::judged(bool is_settled, std::int64_t most) const {
  if (!is_watching_) return Trouble::kNone;
  if (has_noise_) {
    const std::int64_t chance = most_equal();
    if (n_equal_now_ >= (most > 0 ? std::min(most, chance) : chance)) return Trouble::kEqual;
  }
  if (n_taken_ < static_cast<std::int64_t>(kRecent)) return Trouble::kNone;
  if (usual_noise_ > kShownDigits * least_step_) {
    const double noise = recent_noise();
    if (noise < kVanished * usual_noise_) return Trouble::kQuiet;
    if (is_settled && noise > kGrown * usual_noise_) return Trouble::kWild;
  }
  if (!has_clock_ || usual_rate_Hz_ == 0.0) return Trouble::kNone;
  if (rate_Hz(kRecent - 1) > kFaster * usual_rate_Hz_) return Trouble::kFast;
  if (rate_Hz(kFewSteps) < kSlower * usual_rate_Hz_) return Trouble::kSlow;
  return Trouble::kNone;
}

}  // namespace viscard
