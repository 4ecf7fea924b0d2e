#pragma once

#include "models/experiment/run_record.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_clock.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// Finds readings that their neighbours contradict, for instance because of a digit that was garbled
// on the wire and still makes a number. Nothing else in a stream of bare counts can show that.
//
// One straight line is fitted to the five readings before and one to the five after (median of the
// slopes: Theil 1950; Sen, J. Am. Stat. Assoc. 63 (1968) 1379), so that one bad reading on either
// side does not move it. Bad readings before have been found already; of the five after, up to two are
// left out if the other three continue the line before. A reading is a spike if it lies outside the range that the two lines
// predict; corners, steps and readings during a quick move lie within that range.
// - If the lines agree, the prediction is the mean of all ten readings. Allowed are 6.3 robust
//   standard deviations, 8 at the beginning of the stream, and 7 after some million readings.
// - If they do not agree, the allowance also contains the uncertainty of one line, half of the
//   difference in slope (a corner may be rounded), a quarter of the slope (a reading may have been
//   made early or late), and twice the scatter of the neighbours about their line beyond noise. A
//   coarse stage turns a ramp into a staircase; there a reading between its two neighbours, or no
//   more than a step of the stage outside of them, is never a spike: a specimen that relaxes lets
//   the force fall between two steps.
// The noise is the median distance of the last 256 readings. A reading is judged five readings
// later, the first 32 together.
class SpikeWatch {
 public:
  // At rest an error of this many times the noise is always found; of 10 times, in 99 of 100 cases.
  static constexpr double kSurelyFound = 12.0;

  // least: lower bound of the noise; 0 stands for half of the smallest step between readings.
  explicit SpikeWatch(double least = 0.0) : least_(least) {}

  // A step of the stage in contact changes a reading by so much.
  void expect_step(double step) { step_ = step; }

  // value in any unit; place: the reading's number, or its time in periods, ascending. Returns the
  // indices of earlier readings that turned out to be spikes.
  std::vector<std::int64_t> take(std::int64_t index, double place, double value);
  // Call after the last reading: judges the remaining ones by fewer neighbours.
  std::vector<std::int64_t> finish();

 private:
  struct Reading {
    std::int64_t index = 0;
    double place = 0.0;
    double value = 0.0;
    bool is_spike = false;
  };
  struct Line {
    double value = 0.0, slope = 0.0, scatter = 0.0;
    bool is_known = false;
  };
  Line predicted(std::size_t at, int direction, const Line* before = nullptr) const;
  bool departs(const Line& before, std::size_t at, std::size_t from) const;
  double mean_around(std::size_t at, double middle, double slope) const;
  bool lies_between(std::size_t at, const Line& line, double slack) const;
  bool judge(std::size_t at);
  std::vector<std::int64_t> judge_until(std::size_t end);
  void learn(double distance);
  void learn_first();
  double noise() const;

  double least_;
  double step_ = 0.0;                // of the stage
  double least_step_ = 0.0;          // smallest difference between two readings that is not 0
  std::deque<Reading> readings_;     // oldest first
  std::size_t next_ = 0;             // the first reading that is not yet judged
  std::vector<double> distances_{};  // ring buffer of the last ones
  std::size_t ring_at_ = 0;
  std::size_t n_learnt_ = 0;
  double usual_ = 0.0;  // robust standard deviation of a distance
};

// Marks readings that their neighbours contradict, in value or in the time of the device's clock,
// by an event "implausible" with the index of the reading. A marked reading stays in the record as
// it was received.
class ReadingMarks {
 public:
  ReadingMarks(const RigClock& clock, const RecordSink& sink) : clock_(clock), sink_(sink) {}

  // value: counts or force of the reading, nothing if it is doubtful; period_s: time between
  // readings.
  void take(const LoadSample& sample, std::optional<double> value, double period_s);
  // A step of the stage in contact changes the values by so much.
  void expect_step(double step) { values_.expect_step(step); }
  // Call after the last reading: judges the ones that have too few neighbours after them.
  void finish();

  int n_marked() const { return static_cast<int>(marked_.size()); }

 private:
  void mark_all(const std::vector<std::int64_t>& values, const std::vector<std::int64_t>& times);
  void mark(std::int64_t index, const std::string& why);

  const RigClock& clock_;
  const RecordSink& sink_;
  SpikeWatch values_;
  std::optional<SpikeWatch> times_;  // only if the device sends its own time
  double first_period_s_ = 0.0;      // period at the first reading
  std::set<std::int64_t> marked_;    // indices
};

}  // namespace viscard
