#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace viscard {

// Finds readings that their neighbours contradict: a digit garbled on the wire that still makes a
// number, which nothing else in a stream of bare counts can show.
//
// A straight line is laid through the five readings before and another through the five behind
// (median of slopes: Theil 1950, Sen, J. Am. Stat. Assoc. 63 (1968) 1379), so that one spoilt
// reading on either side does not move it; a reading is a spike if it lies outside of what the two
// lines foretell for it. A corner, a step and every reading on the way of a quick move lie between
// the two. Where the lines agree, the mean of all ten is foretold, and 6.3 robust standard
// deviations are allowed, 8 at the beginning; where they do not, a line's own uncertainty, half of
// their difference in slope (a corner may be rounded), and a quarter of the slope itself (a reading
// may have been made that much early or late), besides, and twice what neighbours lie off their
// line beyond noise: a coarse stage makes a staircase of a ramp, on which a reading between the two
// beside it is never a spike. The noise is the median distance of the
// last 256 readings. Judged five readings later; the first 32 together.
class SpikeWatch {
 public:
  // An error of a reading this many times the noise is surely found at rest; at 10 times, 99 of
  // 100.
  static constexpr double kSurelyFound = 12.0;

  // least: what noise counts as at least; without it half of the smallest step between readings.
  explicit SpikeWatch(double least = 0.0) : least_(least) {}

  // Takes a reading in any unit at a place (its number, or its time in periods) that only grows;
  // returns the indices of earlier ones that were spikes.
  std::vector<std::int64_t> take(std::int64_t index, double place, double value);
  // No reading follows: judges what is left, by fewer neighbours.
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
  Line foretold(std::size_t at, int direction) const;
  double mean_around(std::size_t at, double middle, double slope) const;
  bool lies_between(std::size_t at, double slack) const;
  bool judge(std::size_t at);
  std::vector<std::int64_t> judge_until(std::size_t end);
  void learn(double distance);
  void learn_first();
  double noise() const;

  double least_;
  double least_step_ = 0.0;          // smallest between two readings that is not 0
  std::deque<Reading> readings_;     // oldest first
  std::size_t next_ = 0;             // of them: not yet judged
  std::vector<double> distances_{};  // the last of them, as a ring
  std::size_t ring_at_ = 0;
  std::size_t n_learnt_ = 0;
  double usual_ = 0.0;  // standard deviation of a distance, robust
};

}  // namespace viscard
