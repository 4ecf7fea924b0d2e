#include "rig/run/hold_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace viscard {
namespace {

constexpr std::size_t kMedianOf = 8;  // readings: one or two garbled ones move it little
constexpr double kTrend = 3.0;        // a jump is larger than so many times the change before it

}  // namespace

void HoldWatch::begin(const Limits& limits) {
  limits_ = limits;
  force_N_.clear();
  lowest_N_.reset();
}

// Of the readings before the newest `ago` ones.
double HoldWatch::median_N(std::size_t ago) const {
  std::array<double, kMedianOf> values{};
  const auto end = force_N_.end() - static_cast<std::ptrdiff_t>(ago);
  std::copy(end - static_cast<std::ptrdiff_t>(kMedianOf), end, values.begin());
  std::sort(values.begin(), values.end());
  return 0.5 * (values[kMedianOf / 2 - 1] + values[kMedianOf / 2]);
}

std::optional<HoldWatch::Change> HoldWatch::take(double force_N, double made_at_s) {
  if (!limits_ || made_at_s < limits_->from_s + limits_->settles_s) return std::nullopt;
  force_N_.push_back(force_N);
  if (force_N_.size() > 3 * kMedianOf) force_N_.pop_front();
  if (force_N_.size() < kMedianOf) return std::nullopt;
  const double now_N = median_N(0);
  lowest_N_ = std::min(lowest_N_.value_or(now_N), now_N);
  Change change{false, now_N - *lowest_N_, made_at_s - limits_->from_s};
  bool is_found = limits_->rise_N && change.by_N > *limits_->rise_N;
  if (force_N_.size() == 3 * kMedianOf) {
    const double jump_N = now_N - median_N(kMedianOf);
    const double before_N = median_N(kMedianOf) - median_N(2 * kMedianOf);
    if (std::abs(jump_N) > limits_->jump_N + kTrend * std::abs(before_N)) {
      is_found = true;
      change.is_jump = true;
      change.by_N = jump_N;
    }
  }
  if (!is_found) return std::nullopt;
  end();
  return change;
}

}  // namespace viscard
