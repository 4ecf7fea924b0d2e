#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// The average of samples over a short stretch of log time, with the moments needed to average a
// smooth function over the same samples: sum f(t_k)/n = f(m) + f''(m) m2/2 + f'''(m) m3/6 + ...
struct LogBin {
  std::size_t begin = 0, end = 0;  // range of samples
  double count = 0.0;
  double time_s = 0.0;                                      // mean
  double m2 = 0.0, m3 = 0.0, m4 = 0.0, m5 = 0.0, m6 = 0.0;  // mean powers of t - mean
  double value = 0.0;                                       // mean
  double c1 = 0.0, c2 = 0.0, c3 = 0.0;                      // mean of (value - mean)(t - mean)^k
  double value_m2 = 0.0;                                    // mean of (value - mean)^2
  double sigma = 1.0;  // standard deviation of one sample, relative to that of all
};

// At this many bins per decade the neglected orders are below 3e-10 of an exponential's initial
// value (fit/samples/README.md).
inline constexpr double kBinsPerDecade = 60.0;
// A record of up to this many samples is fitted sample by sample.
inline constexpr std::size_t kSmallRecord = 2000;

// Bins of sorted times. Samples at t <= 0 get a bin each; with per_decade <= 0 all samples do.
std::vector<LogBin> log_bins(std::span<const double> time_s, std::span<const double> value,
                             double per_decade);

// Merges neighbouring bins up to the given width; the moments remain exact.
std::vector<LogBin> merged_bins(const std::vector<LogBin>& bins, double per_decade);

}  // namespace viscard
