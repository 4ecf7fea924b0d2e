#include "rig/lines/host_lateness.h"

#include <utility>

namespace viscard {
namespace {

constexpr double kUsual_s = 0.010;  // an idle computer delays a program by less
constexpr double kLong_s = 0.1;

}  // namespace

void HostLateness::look(double wall_s) {
  const double expected_s = std::exchange(expected_s_, 0.0);
  const double before_s = std::exchange(last_look_s_, wall_s);
  if (before_s < 0.0) return;
  const double late_s = wall_s - before_s - expected_s;
  if (late_s < kUsual_s) return;
  total_s_ += late_s;
  if (late_s < kLong_s) return;
  ++n_long_;
  newest_long_s_ = late_s;
  newest_ended_s_ = wall_s;
}

double HostLateness::recent_s(double within_s) const {
  return last_look_s_ - newest_ended_s_ < within_s ? newest_long_s_ : 0.0;
}

}  // namespace viscard
