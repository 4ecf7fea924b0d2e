#include "rig/cells/device_clock.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kWrap = 4294967296.0;  // at which millis() and micros() start again from 0
constexpr std::size_t kRemembered = 64;
constexpr double kClockError = 0.006;  // a ceramic resonator is off by up to 0.5 %
constexpr double kWindow_s = 30.0;     // short, so that 0.1 % between the clocks stays below 30 ms

// Modulo 2^32: a wrap is a small step forward, a step backward becomes a huge one.
double step_s_between(double from_ticks, double to_ticks, double tick_s) {
  return std::fmod(to_ticks - from_ticks + kWrap, kWrap) * tick_s;
}

}  // namespace

// A device's clock cannot advance further than the host's, apart from the lateness of a line.
bool DeviceClock::continues(const Accepted& from, double ticks, double host_time_s,
                            double period_s) const {
  const double host_step_s = host_time_s - from.host_s;
  const double slack_s = slack_s_ + 20.0 * period_s + 0.05 * host_step_s;
  return step_s_between(from.ticks, ticks, tick_s_) <= host_step_s + slack_s;
}

DeviceClock::Verdict DeviceClock::take(double ticks, double host_time_s, double period_s) {
  if (!last_) {
    time_s_ = start_s_.value_or(ticks * tick_s_);
    accept(ticks, 0.0, host_time_s);
    return Verdict::kGood;
  }
  // A repeated part of the stream must not look like a clock that restarted.
  if (std::find(recent_ticks_.begin(), recent_ticks_.end(), ticks) != recent_ticks_.end()) {
    return Verdict::kDuplicate;
  }
  if (continues(*last_, ticks, host_time_s, period_s)) {
    before_last_ = last_;
    accept(ticks, step_s_between(last_->ticks, ticks, tick_s_), host_time_s);
    return Verdict::kGood;
  }
  if (before_last_ && continues(*before_last_, ticks, host_time_s, period_s)) {
    time_s_ = before_last_->time_s;
    while (!window_.empty() && window_.back().first > time_s_) window_.pop_back();
    least_delay_s_ = least_before_s_;  // the garbled time made the delay look small
    accept(ticks, step_s_between(before_last_->ticks, ticks, tick_s_), host_time_s);
    return Verdict::kLastWasBad;
  }
  if (suspect_ticks_) {
    const double from_suspect_s = (ticks - *suspect_ticks_) * tick_s_;
    const double host_from_suspect_s = host_time_s - suspect_host_s_;
    const double slack_s = slack_s_ + 20.0 * period_s + 0.05 * (host_time_s - last_->host_s);
    if (from_suspect_s > 0.0 && from_suspect_s <= host_from_suspect_s + slack_s) {
      return Verdict::kRestarted;
    }
  }
  suspect_ticks_ = ticks;
  suspect_host_s_ = host_time_s;
  return Verdict::kSuspect;
}

void DeviceClock::accept(double ticks, double step_s, double host_time_s) {
  suspect_ticks_.reset();
  recent_ticks_.push_back(ticks);
  if (recent_ticks_.size() > kRemembered) recent_ticks_.pop_front();
  step_s_ = step_s;
  time_s_ += step_s;
  const double delay_s = host_time_s - time_s_;
  least_before_s_ = last_ ? least_delay_s_ + kClockError * step_s : delay_s;
  least_delay_s_ = std::min(delay_s, least_before_s_);
  last_ = Accepted{ticks, time_s_, host_time_s};
  while (!window_.empty() && window_.back().second >= delay_s) window_.pop_back();
  window_.emplace_back(time_s_, delay_s);
  while (window_.front().first < time_s_ - kWindow_s) window_.pop_front();
}

double DeviceClock::host_minus_device_s() const {
  return window_.empty() ? 0.0 : std::min(window_.front().second, least_delay_s_);
}

}  // namespace viscard
