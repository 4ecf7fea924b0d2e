#include "rig/lines/rig_clock.h"

#include "models/maths/text_of_number.h"

#include <time.h>

#include <cmath>
#include <stdexcept>

namespace viscard {

double monotonic_s() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

RigClock::RigClock(double speed) : speed_(speed), origin_s_(monotonic_s()) {
  if (!(speed > 0.0) || !std::isfinite(speed)) {
    throw std::invalid_argument("clock speed is " + text_of(speed) +
                                "; it must be positive (1 on a real rig)");
  }
}

double RigClock::look_s() const {
  if (rig_ != nullptr) return rig_->now_s();
  const double wall_s = monotonic_s();
  lateness_.look(wall_s);
  return wall_s;
}

double RigClock::awake_s() const {
  return look_s() - lateness_.total_s();
}

}  // namespace viscard
