#include "rig/run/silence_watch.h"

#include <algorithm>

namespace viscard {

void SilenceWatch::pass(double wall_s, bool has_arrived, bool is_moving) {
  constexpr double kLongestPass_s = 0.010;
  const double pass_s = last_pass_s_ < 0.0 ? 0.0 : wall_s - last_pass_s_;
  last_pass_s_ = wall_s;
  silent_s_ += std::clamp(pass_s, 0.0, kLongestPass_s);
  if (!has_arrived) return;
  if (!is_moving) longest_at_rest_s_ = std::max(longest_at_rest_s_, silent_s_);
  silent_s_ = 0.0;
}

double SilenceWatch::limit_s(double period_s) const {
  constexpr double kPeriods = 3.0, kLargestAllowance_s = 0.25;
  const double largest_s = std::max(kLargestAllowance_s, floor_s_);
  return std::max(kPeriods * period_s, std::clamp(2.0 * longest_at_rest_s_, floor_s_, largest_s));
}

}  // namespace viscard
