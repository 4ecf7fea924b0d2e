#include "rig/spike_watch.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr int kToLearn = 20;
constexpr double kForget = 0.02;  // of the usual size, per reading
constexpr double kTimesUsual = 10.0;
constexpr double kTimesNeighbours = 4.0;

}  // namespace

std::optional<std::int64_t> SpikeWatch::take(std::int64_t index, double value) {
  std::shift_left(last_.begin(), last_.end(), 1);
  last_.back() = {index, value};
  n_ = std::min(n_ + 1, last_.size());
  if (n_ < last_.size()) return std::nullopt;
  const auto step = [&](std::size_t from, std::size_t to) {
    return std::abs(last_[to].value - last_[from].value);
  };
  if (step(3, 4) > 0.0 && (least_step_ == 0.0 || step(3, 4) < least_step_))
    least_step_ = step(3, 4);
  const double noise = std::max(usual_, least_step_);
  const double d = std::abs(last_[2].value - 0.5 * (last_[1].value + last_[3].value));
  const double around = std::max({step(0, 1), step(1, 3), step(3, 4)});
  const bool is_spike =
      n_learnt_ >= kToLearn && d > kTimesUsual * noise && d > kTimesNeighbours * around;
  // A spike's own neighbours see it too: they must not teach.
  const bool is_beside = std::max(step(1, 2), step(2, 3)) > kTimesNeighbours * noise;
  if (n_learnt_ < kToLearn || !is_beside) {
    ++n_learnt_;
    usual_ += (d - usual_) * std::max(kForget, 1.0 / n_learnt_);
  }
  return is_spike ? std::optional(last_[2].index) : std::nullopt;
}

}  // namespace viscard
