#include "rig/cells/arrival_clock.h"

#include <algorithm>

namespace viscard {
namespace {

constexpr double kSlowest = 1.1;        // period over the expected one; an HX711 is off by some %
constexpr std::int64_t kToKnow = 64;    // readings until the period is known
constexpr std::int64_t kFollow = 1024;  // readings over which it may change
constexpr double kPeriodError = 0.01;   // of the measured period; only a larger lag counts

}  // namespace

ArrivalClock::ArrivalClock(double expected_period_s)
    : longest_period_s_(kSlowest * expected_period_s), period_s_(expected_period_s) {}

void ArrivalClock::take(double n_periods, double host_time_s) {
  const double step_s = host_time_s - last_s_;
  last_s_ = host_time_s;
  if (++n_ == 1) return;
  if (n_periods > 0.0) {
    const double gain = 1.0 / static_cast<double>(std::min(n_ - 1, kFollow));
    period_s_ = std::min(longest_period_s_, period_s_ + gain * (step_s / n_periods - period_s_));
  }
  if (n_ < kToKnow) return;
  lag_s_ = std::max(0.0, lag_s_ + (1.0 - kPeriodError) * step_s - n_periods * period_s_);
}

}  // namespace viscard
