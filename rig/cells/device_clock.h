#pragma once

#include <deque>
#include <optional>
#include <utility>

namespace viscard {

// Turns a processor's 32-bit millis() or micros() into a time that only grows, distinguishes
// duplicates and restarts from the counter's wrap, and relates the time to the host's clock.
class DeviceClock {
 public:
  enum class Verdict {
    kGood,
    kDuplicate,   // repeats one of the last readings
    kSuspect,     // does not fit: a garbled line, or the first one after a restart
    kRestarted,   // agrees with the suspect before it: the device has restarted
    kLastWasBad,  // good, and shows that the previous one was garbled: its time was too large
  };

  // tick_s: unit of the counter; slack_s: how late a line can arrive.
  DeviceClock(double tick_s, double slack_s) : tick_s_(tick_s), slack_s_(slack_s) {}

  // The time of the first reading; without this it is what its counter shows.
  void start_at(double time_s) { start_s_ = time_s; }

  // ticks as sent; host_time_s: arrival of the line. After kGood and kLastWasBad, time_s() is the
  // time of this reading.
  Verdict take(double ticks, double host_time_s, double period_s);

  double time_s() const { return time_s_; }
  // Time since the previous good reading (after kLastWasBad: the one before it); 0 for the first.
  double step_s() const { return step_s_; }
  // Host time minus device time: the smallest of the last window, because delays are not negative.
  // On a line that falls behind every delay of the window is too large. Then the smallest delay of
  // all readings is used, raised by the largest error of a device's clock.
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
  std::optional<double> start_s_;
  double slack_s_;
  std::optional<Accepted> last_, before_last_;
  double time_s_ = 0.0;
  double step_s_ = 0.0;
  std::deque<double> recent_ticks_;
  std::optional<double> suspect_ticks_;
  double suspect_host_s_ = 0.0;
  std::deque<std::pair<double, double>> window_;  // device time, delay: ascending in both
  double least_delay_s_ = 0.0;   // of all before, raised by the error of the device's clock since
  double least_before_s_ = 0.0;  // the same, without the newest reading
};

}  // namespace viscard
