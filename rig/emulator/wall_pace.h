#pragma once

#include "rig/lines/rig_clock.h"

#include <chrono>
#include <thread>

namespace viscard {

// Keeps a rig that waits from running faster than the wall clock times a speed, as far as this
// computer keeps up with that.
class WallPace {
 public:
  explicit WallPace(double speed) : speed_(speed), origin_s_(monotonic_s()) {}

  // Sleeps if rig time now_s is ahead.
  void keep(double now_s) {
    constexpr double kShortest_s = 1e-3;       // shorter sleeps are put off
    constexpr double kLongestHurry_s = 50e-3;  // a longer delay is not made up for
    const double ahead_s = now_s / speed_ - (monotonic_s() - origin_s_);
    if (ahead_s < -kLongestHurry_s) origin_s_ -= ahead_s + kLongestHurry_s;
    if (ahead_s < kShortest_s) return;
    std::this_thread::sleep_for(std::chrono::duration<double>(ahead_s));
  }

 private:
  double speed_;
  double origin_s_;  // wall time at rig time 0
};

}  // namespace viscard
