#include "rig/spike_watch.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr int kToLearn = 6;
constexpr double kForget = 0.05;  // of the usual distance, per reading
constexpr double kFarBelow = 0.1;
constexpr double kFastDown = 0.8;
constexpr double kTimesUsual = 10.0;
constexpr double kTimesNeighbours = 5.0;
constexpr double kTeaches = 5.0;  // further off is no noise

}  // namespace

std::optional<std::int64_t> SpikeWatch::take(std::int64_t index, double value) {
  if (n_ > 0 && index != last_.back().index + 1) interrupt();
  const double step = n_ > 0 ? std::abs(value - last_.back().value) : 0.0;
  if (step > 0.0 && (least_step_ == 0.0 || step < least_step_)) least_step_ = step;
  std::shift_left(last_.begin(), last_.end(), 1);
  last_.back() = {index, value};
  n_ = std::min(n_ + 1, last_.size());
  if (n_ < last_.size()) return std::nullopt;

  // The line through the four others, at -2 -1 1 2.
  const double mean = 0.25 * (last_[0].value + last_[1].value + last_[3].value + last_[4].value);
  const double slope =
      0.1 * (2.0 * (last_[4].value - last_[0].value) + last_[3].value - last_[1].value);
  const double distance = std::abs(last_[2].value - mean);
  double around = 0.0;
  for (const int i : {0, 1, 3, 4}) {
    const double on_line = mean + slope * (i - 2);
    around = std::max(around, std::abs(last_[static_cast<std::size_t>(i)].value - on_line));
  }
  const double noise = std::max(usual_, least_ > 0.0 ? least_ : least_step_);
  const bool is_spike = n_learnt_ >= kToLearn && distance > kTimesUsual * noise &&
                        distance > kTimesNeighbours * around;
  learn(distance, noise);
  return is_spike ? std::optional(last_[2].index) : std::nullopt;
}

// Follows the median of the distances, so that no single one matters; quickly down from a value
// that a spoilt beginning has left.
void SpikeWatch::learn(double distance, double noise) {
  if (++n_learnt_ == 1) {
    usual_ = distance;
  } else if (distance > kTeaches * noise && n_learnt_ > kToLearn) {
    return;
  } else if (distance < usual_) {
    usual_ *= distance < kFarBelow * usual_ ? kFastDown : 1.0 - kForget;
  } else {
    usual_ = std::min(distance, std::max(usual_ * (1.0 + kForget), kFarBelow * distance));
  }
}

}  // namespace viscard
