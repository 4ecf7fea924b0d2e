#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace viscard {

// Makes a time that only grows out of a processor's 32-bit millis() or micros(), tells duplicates
// and restarts from wrapping, and relates it to the host's clock.
class DeviceClock {
 public:
  enum class Verdict {
    kGood,
    kDuplicate,   // one of the last readings again
    kSuspect,     // a time that does not fit: a garbled line, or the first after a restart
    kRestarted,   // and the next one agreed with it: the device has started anew
    kLastWasBad,  // good, and it shows that the good one before was garbled: that had come too
                  // early
  };

  // slack_s: how much a line can be late in arriving.
  DeviceClock(double tick_s, double slack_s) : tick_s_(tick_s), slack_s_(slack_s) {}

  // ticks as sent, and when the line arrived on the host. After kGood and kLastWasBad time_s() is
  // that of this reading.
  Verdict take(double ticks, double host_time_s, double period_s);

  double time_s() const { return time_s_; }
  // Time since the good reading before (after kLastWasBad: the one before that); 0 for the first.
  double step_s() const { return step_s_; }
  // Host time minus device time: the smallest of the last window, since delays are never negative.
  double host_minus_device_s() const;

 private:
  struct Accepted {
    double ticks = 0.0;
    double time_s = 0.0;
    double host_s = 0.0;
  };
  void accept(double ticks, double step_s, double host_time_s);
  bool continues(const Accepted& from, double ticks, double host_time_s, double period_s) const;

  double tick_s_;
  double slack_s_;
  std::optional<Accepted> last_, before_last_;
  double time_s_ = 0.0;
  double step_s_ = 0.0;
  std::deque<double> recent_ticks_;
  std::optional<double> suspect_ticks_;
  double suspect_host_s_ = 0.0;
  std::deque<std::pair<double, double>> window_;  // device time, delay: ascending in both
};

}  // namespace viscard
