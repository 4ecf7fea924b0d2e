#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// Samples averaged over a short stretch of log time, with the moments that let a smooth function be
// averaged over exactly the same samples: sum f(t_k)/n = f(m) + f''(m) m2/2 + f'''(m) m3/6 + ...
// With 60 bins a decade the terms left out are below 3e-10 of an exponential's start
// (fit/README.md, sect. 2).
struct LogBin {
  std::size_t begin = 0, end = 0;  // samples
  double count = 0.0;
  double time_s = 0.0;                                      // mean
  double m2 = 0.0, m3 = 0.0, m4 = 0.0, m5 = 0.0, m6 = 0.0;  // mean powers of t - mean
  double value = 0.0;                                       // mean
  double c1 = 0.0, c2 = 0.0, c3 = 0.0;                      // mean of (value - mean)(t - mean)^k
  double value_m2 = 0.0;                                    // mean of (value - mean)^2
};

// With this many bins per decade the neglected orders are below 3e-10 of an exponential's initial
// value (fit/README.md, sect. 2).
inline constexpr double kBinsPerDecade = 60.0;
// A record of up to this many samples is fitted sample by sample.
inline constexpr std::size_t kSmallRecord = 2000;

// Bins of sorted times; per_decade <= 0: every sample for itself. Times up to 0 stay alone.
std::vector<LogBin> log_bins(std::span<const double> time_s, std::span<const double> value,
                             double per_decade);

// Neighbouring bins put together until they are so wide; their moments stay exact.
std::vector<LogBin> merged_bins(const std::vector<LogBin>& bins, double per_decade);

}  // namespace viscard
