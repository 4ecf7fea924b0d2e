#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/run_record.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace viscard {

// Change of a force per second, from the first half of its readings to the second, and its standard
// uncertainty by their noise.
struct Drift {
  double N_per_s = 0.0, u_N_per_s = 0.0;
};
Drift drift_of(const std::vector<double>& force_N, double noise_N, double took_s);

struct ForceMean {
  double force_N = 0.0;  // mean from the tare, without readings that stand out of both neighbours
  double sd_N = 0.0;     // standard deviation of one reading
  double rate_Hz = 0.0;  // of the readings that have a force
  Drift drift;
  int n = 0;
};

// A difference between two means of n readings is more than noise from here on, N. noise_N: of one
// reading.
double felt_difference_N(double noise_N, int n);

// Values without those that stand out of both neighbours by more than 16 times the noise: a garbled
// digit. A force that rises, falls or relaxes loses none.
std::vector<double> without_spikes(const std::vector<double>& values);

// The force at the end of a press is known so much later: an adapter and the stage answer late, and
// a reading may be the mean of its period. wall_s: rig time of a second on the wall.
inline double press_seen_after_s(double period_s, double wall_s) {
  return 2.0 * period_s + 0.025 * wall_s;
}

// Turns readings of the load cell into forces from the tare. Keeps the newest and the largest,
// reports when a force passes a threshold, and collects the readings of a mean.
class ForceReadings {
 public:
  explicit ForceReadings(const RigConfig& rig) : rig_(rig) {}

  struct Reading {
    double force_N = 0.0;      // from the tare; 0 if the sample has no force
    bool is_doubtful = false;  // a glitch code, saturated, or without a finite force
  };
  // made_at_s: the rig time at which the reading was made. Doubtful readings change nothing.
  Reading take(const LoadSample& sample, double made_at_s);

  double force_N() const { return force_N_; }
  double earlier_N() const { return earlier_N_[0]; }  // the force before it
  // The newest force, or the one before it if the newest stands out of the last ones by more than 8
  // times the noise.
  double sound_force_N(double noise_N) const;
  double peak_force_N() const { return peak_force_N_; }
  double tare_N() const { return tare_N_; }
  std::int64_t n_forces() const { return n_forces_; }  // readings that were not doubtful
  double last_made_s() const { return last_made_s_; }
  double newest_made_s() const { return newest_made_s_; }  // of the newest force

  // Moves the zero by this force and forgets the peak.
  void add_to_tare(double force_N);

  // From now on has_exceeded() is true once a force lies above highest_N or below lowest_N.
  void watch(double lowest_N, double highest_N);
  void stop_watching() { watched_.reset(); }
  bool has_exceeded() const { return has_exceeded_; }

  // A move away from the specimen, which must not raise the force. Readings made until from_s show
  // the force at its start, whenever they arrive; it counts as least_N at least, because a punch
  // that is pulled comes free at zero. goes_on: the start is that of the move before,
  // unless the force is lower now.
  struct MoveAway {
    double from_s = 0.0, least_N = 0.0;
    bool goes_on = false;
  };
  void watch_rise(const MoveAway& away);
  // How far the last two forces lie above the one at the start; 0 if nothing is watched.
  double rise_N() const { return rise_ ? rise_->rise_N : 0.0; }
  bool is_rise_open() const { return rise_ && !rise_->has_end; }  // that move goes on
  void end_rise(double at_s);  // later readings change nothing, from the second one on
  void forget_rise() { rise_.reset(); }

  // Collects the readings made at or after time_s until stop_collecting().
  void collect_from(double time_s);
  void stop_collecting() { collects_from_s_.reset(); }
  int n_collected() const { return static_cast<int>(collected_N_.size()); }
  double collected_until_s() const { return collected_until_s_; }  // time of the last of them
  // Of the collected readings. Precondition: at least two readings.
  ForceMean collected_mean() const;

 private:
  void take_rise(double made_at_s);
  void collect(double absolute_N, double made_at_s);

  const RigConfig& rig_;
  double tare_N_ = 0.0;
  double force_N_ = 0.0;
  std::array<double, 2> earlier_N_{};  // the two forces before it, the newer one first
  double peak_force_N_ = 0.0;
  std::int64_t n_forces_ = 0;
  double last_made_s_ = 0.0;
  double newest_made_s_ = 0.0;
  struct Range {
    double lowest_N = 0.0, highest_N = 0.0;
  };
  std::optional<Range> watched_;
  bool has_exceeded_ = false;
  struct Rise {
    double from_s = 0.0, from_N = 0.0, rise_N = 0.0;
    double until_s = 0.0;
    bool has_end = false, is_over = false;
  };
  std::optional<Rise> rise_;
  std::optional<double> collects_from_s_;
  std::vector<double> collected_N_;  // before the tare is subtracted
  double collected_first_s_ = 0.0, collected_until_s_ = 0.0;
};

}  // namespace viscard
