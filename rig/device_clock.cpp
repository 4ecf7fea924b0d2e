#include "rig/device_clock.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kWrap = 4294967296.0;  // of millis() and micros()
constexpr double kWindow_s = 30.0;  // short enough that .1 % between the clocks stays below 30 ms

}  // namespace

DeviceClock::Verdict DeviceClock::take(double ticks, double host_time_s, double period_s) {
  if (!last_ticks_) {
    accept(ticks, 0.0, host_time_s);
    time_s_ = ticks * tick_s_;
    window_.assign({{time_s_, host_time_s - time_s_}});
    return Verdict::kGood;
  }
  if (ticks == *last_ticks_) return Verdict::kDuplicate;
  // Modulo 2^32: a wrap is a small step forward, anything backward a huge one.
  const double step_s = std::fmod(ticks - *last_ticks_ + kWrap, kWrap) * tick_s_;
  const double host_step_s = host_time_s - last_host_s_;
  const double slack_s = slack_s_ + 20.0 * period_s + 0.05 * host_step_s;
  if (step_s <= host_step_s + slack_s) {
    accept(ticks, step_s, host_time_s);
    return Verdict::kGood;
  }
  if (suspect_ticks_) {
    const double from_suspect_s = (ticks - *suspect_ticks_) * tick_s_;
    const double host_from_suspect_s = host_time_s - suspect_host_s_;
    if (from_suspect_s > 0.0 && from_suspect_s <= host_from_suspect_s + slack_s) {
      return Verdict::kRestarted;
    }
  }
  suspect_ticks_ = ticks;
  suspect_host_s_ = host_time_s;
  return Verdict::kSuspect;
}

void DeviceClock::accept(double ticks, double step_s, double host_time_s) {
  last_ticks_ = ticks;
  last_host_s_ = host_time_s;
  suspect_ticks_.reset();
  step_s_ = step_s;
  time_s_ += step_s;
  const double delay_s = host_time_s - time_s_;
  while (!window_.empty() && window_.back().second >= delay_s) window_.pop_back();
  window_.emplace_back(time_s_, delay_s);
  while (window_.front().first < time_s_ - kWindow_s) window_.pop_front();
}

double DeviceClock::host_minus_device_s() const {
  return window_.empty() ? 0.0 : window_.front().second;
}

}  // namespace viscard
