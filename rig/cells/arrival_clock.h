#pragma once

#include <cstdint>

namespace viscard {

// How far a stream without a clock of its own has fallen behind, from the number of its readings
// and the period between them. The period is measured, but it is never taken to be longer than the
// converter's oscillator allows: a line that is too slow from the beginning looks like a converter
// that is too slow.
class ArrivalClock {
 public:
  explicit ArrivalClock(double expected_period_s);

  // n_periods: from the last reading to this one, with those that were lost.
  void take(double n_periods, double host_time_s);
  // Delay of the newest reading beyond the smallest one seen; 0 until the period is known.
  double lag_s() const { return lag_s_; }

 private:
  double longest_period_s_;
  double period_s_;
  std::int64_t n_ = 0;
  double last_s_ = 0.0;
  double lag_s_ = 0.0;
};

}  // namespace viscard
