#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace viscard {

// What the export of a table did to its times.
struct TimeRounding {
  double step_s = 0.0;  // of the coarse times
  // All times may be early or late together by this: rounded times by what the spread rows leave open, times that
  // were cut off by half a step more.
  double unsure_s = 0.0;
  std::vector<double> time_s;  // spread evenly again; empty: the times stand as they are
};

// Times of an evenly sampled record are spread evenly again if every time is repeated about equally often (0, 0,
// 0, 1, 1, 1, 1, ...; the first and the last may have fewer), or if they lie within one coarse step about a
// straight line. Others that rounding_step_s() recognises stand as they are. So do even times that lack a row
// at equal distances: their export cut them off to a step a little shorter than that of the sampling, or rows
// are missing, which makes them unsure by a whole step.
//   n_missing: rows that are known to be missing
std::optional<TimeRounding> time_rounding(std::span<const double> time_s,
                                          std::size_t n_missing = 0);

// The step to which times were rounded, if that shows: all times lie on a grid no finer than a third
// of the shortest distance of two rows, and rows of about equal distances stand now one, now two
// steps apart, or share a time. Nothing for even times, also if rows are missing here and there.
std::optional<double> rounding_step_s(std::span<const double> time_s, std::size_t n_missing = 0);

}  // namespace viscard
