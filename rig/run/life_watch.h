#pragma once

#include "models/experiment/run_record.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace viscard {

// What the readings of a load cell, taken at rest, show of the converter that made them.
struct LifeSigns {
  std::int64_t n = 0;         // readings, with those at the end of the converter's range
  std::int64_t n_equal = 0;   // equal to the reading before
  std::int64_t n_zero = 0;    // exactly 0
  std::int64_t n_at_end = 0;  // at the end of the converter's range
  double least_step = 0.0;    // smallest difference between neighbours that is not 0
  double usual_step = 0.0;    // median of those differences
  double noise = 0.0;         // median second difference; 0 if most are 0
  double first_s = 0.0, last_s = 0.0;

  // Chance that a reading equals the one before, from what was seen; never 0 or 1.
  double share_equal() const {
    return static_cast<double>(n_equal + 1) / static_cast<double>(n + 1);
  }
  // The noise moves the last digits so often that a stretch of equal readings has a meaning.
  bool shows_noise() const;
  // Each value comes several times although the values differ by many digits: the converter is
  // slower than the lines.
  bool repeats_values() const;
};

// Watches the readings of a whole run for signs that the converter behind them has stopped
// measuring: a stretch of equal readings that its noise cannot make, noise that vanishes or grows
// many times, readings that come much faster than at rest.
class LifeWatch {
 public:
  enum class Trouble { kNone, kEqual, kQuiet, kWild, kFast, kSlow };

  // value: counts, volts or force, as received.
  void take(double value, double made_at_s);
  void take_at_end() { ++signs_.n, ++signs_.n_at_end; }
  // Forgets all readings: the device has restarted.
  void restart() { *this = LifeWatch(); }

  LifeSigns signs() const;
  // From now on the readings are judged by those so far, which were made at rest.
  void begin_watch(bool has_clock);
  bool is_watching() const { return is_watching_; }

  // is_settled: the stage has stood still for so long that only noise bends the force. most: readings
  // in a row that may be equal before the force could have risen too far; 0: as many as noise might
  // make.
  Trouble judged(bool is_settled, std::int64_t most) const;
  bool has_noise() const { return has_noise_; }  // the readings at rest showed it
  double newest() const { return last_; }
  std::int64_t n_changes() const { return n_changes_; }
  std::int64_t n_equal_now() const { return n_equal_now_; }  // readings equal to the newest
  // So many in a row are no chance.
  std::int64_t most_equal() const;
  double usual_rate_Hz() const { return usual_rate_Hz_; }

  static constexpr std::size_t kRecent = 32;  // readings that show the noise and the rate

 private:
  double recent_noise() const;
  double share_equal_before() const;
  double rate_Hz(std::size_t n_steps) const;  // of the last readings

  LifeSigns signs_;
  std::vector<double> steps_, bends_;                        // at rest, not 0; second differences
  std::array<double, kRecent> recent_bends_{}, recent_s_{};  // rings
  std::int64_t n_taken_ = 0;
  std::int64_t n_changes_ = 0;
  std::int64_t n_equal_now_ = 0;
  double last_ = 0.0, before_last_ = 0.0;
  bool is_watching_ = false;
  bool has_clock_ = false;
  bool has_noise_ = false;
  double usual_noise_ = 0.0;
  double least_step_ = 0.0;
  double usual_rate_Hz_ = 0.0;
};

// The value that was received: counts, volts or force; 0 without any.
double received_value(const LoadSample& sample);

}  // namespace viscard
