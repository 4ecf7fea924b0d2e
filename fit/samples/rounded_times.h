#pragma once

#include <optional>
#include <span>
#include <vector>

namespace viscard {

// Times of an evenly sampled record whose export rounded them (0, 0, 0, 1, 1, 1, 1, 1, 2, ...).
struct RoundedTimes {
  double step_s = 0.0;         // between the rounded times
  std::vector<double> time_s;  // spread evenly within each step, about the rounded time
};

// Also of an evenly sampled record whose times stand on a coarser grid, now one, now two of its steps apart:
// a straight line through them.
// Otherwise nothing unless every time is repeated about equally often, two or more rows each (the first and the
// last may have fewer), in rising order and at equal distances.
std::optional<RoundedTimes> rounded_times(std::span<const double> time_s);

// The step to which times were rounded, if that shows: all times lie on a grid no finer than a third
// of the shortest distance of two rows, and rows of about equal distances stand now one, now two
// steps apart, or share a time. Nothing for even times, also if rows are missing here and there.
std::optional<double> rounding_step_s(std::span<const double> time_s);

}  // namespace viscard
