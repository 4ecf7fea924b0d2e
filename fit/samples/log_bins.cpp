#include "fit/samples/log_bins.h"

#include "fit/samples/sample_passes.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

LogBin make_bin(std::span<const double> time_s, std::span<const double> value, std::size_t begin,
                std::size_t end) {
  LogBin bin;
  bin.begin = begin;
  bin.end = end;
  bin.count = static_cast<double>(end - begin);
  if (end - begin == 1) {
    bin.time_s = time_s[begin];
    bin.value = value[begin];
    return bin;
  }
  // Sums are taken about the middle of the bin and its first value, to keep all digits on a long
  // record, and then moved to the means.
  const double centre = 0.5 * (time_s[begin] + time_s[end - 1]);
  const double level = value[begin];
  const double n = bin.count;
  const PowerSums s = power_sums(time_s.subspan(begin, end - begin),
                                 value.subspan(begin, end - begin), centre, level);
  const double u = s.d1 / n, uu = u * u, v = s.y / n;
  const double d2 = s.d2 / n, d3 = s.d3 / n, d4 = s.d4 / n, d5 = s.d5 / n;
  bin.time_s = centre + u;
  bin.value = level + v;
  bin.m2 = d2 - uu;
  bin.m3 = d3 - 3.0 * u * d2 + 2.0 * u * uu;
  bin.m4 = d4 - 4.0 * u * d3 + 6.0 * uu * d2 - 3.0 * uu * uu;
  bin.m5 = d5 - 5.0 * u * d4 + 10.0 * uu * d3 - 10.0 * u * uu * d2 + 4.0 * u * uu * uu;
  bin.m6 = s.d6 / n - 6.0 * u * d5 + 15.0 * uu * d4 - 20.0 * u * uu * d3 + 15.0 * uu * uu * d2 -
           5.0 * uu * uu * uu;
  bin.c1 = s.yd1 / n - v * u;
  bin.c2 = (s.yd2 - 2.0 * u * s.yd1) / n + 2.0 * uu * v - v * d2;
  bin.c3 = (s.yd3 - 3.0 * u * s.yd2 + 3.0 * uu * s.yd1) / n - v * (d3 - 3.0 * u * (d2 - uu));
  bin.value_m2 = s.yy / n - v * v;
  return bin;
}

// Moments about the common mean from the moments about each bin's own mean.
LogBin put_together(std::span<const LogBin> parts) {
  LogBin sum;
  sum.begin = parts.front().begin;
  sum.end = parts.back().end;
  for (const LogBin& part : parts) sum.count += part.count;
  sum.time_s = parts.front().time_s;
  sum.value = parts.front().value;
  double time = 0.0, value = 0.0, precision = 0.0;
  for (const LogBin& part : parts) {
    precision += part.count / sum.count / (part.sigma * part.sigma);
    time += part.count / sum.count * (part.time_s - parts.front().time_s);
    value += part.count / sum.count * (part.value - parts.front().value);
  }
  sum.sigma = 1.0 / std::sqrt(precision);
  sum.time_s += time;
  sum.value += value;
  for (const LogBin& part : parts) {
    const double share = part.count / sum.count;
    const double d = part.time_s - sum.time_s;
    const double y = part.value - sum.value;
    sum.m2 += share * (part.m2 + d * d);
    sum.m3 += share * (part.m3 + 3.0 * d * part.m2 + d * d * d);
    sum.m4 += share * (part.m4 + 4.0 * d * part.m3 + 6.0 * d * d * part.m2 + d * d * d * d);
    sum.m5 += share *
              (part.m5 + d * (5.0 * part.m4 + d * (10.0 * part.m3 + d * (10.0 * part.m2 + d * d))));
    sum.m6 +=
        share * (part.m6 +
                 d * (6.0 * part.m5 +
                      d * (15.0 * part.m4 + d * (20.0 * part.m3 + d * (15.0 * part.m2 + d * d)))));
    sum.c1 += share * (part.c1 + y * d);
    sum.c2 += share * (part.c2 + 2.0 * d * part.c1 + y * (part.m2 + d * d));
    sum.c3 += share * (part.c3 + 3.0 * d * part.c2 + 3.0 * d * d * part.c1 +
                       y * (part.m3 + 3.0 * d * part.m2 + d * d * d));
    sum.value_m2 += share * (part.value_m2 + y * y);
  }
  return sum;
}

// First sample from `begin` on that is not before `limit`: steps that double, then bisection.
std::size_t first_not_below(std::span<const double> time_s, std::size_t begin, double limit) {
  std::size_t step = 1, end = begin;
  while (end < time_s.size() && time_s[end] < limit) {
    begin = end;
    end += step;
    step *= 2;
  }
  const auto first = time_s.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = time_s.begin() + static_cast<std::ptrdiff_t>(std::min(end, time_s.size()));
  return static_cast<std::size_t>(std::lower_bound(first, last, limit) - time_s.begin());
}

}  // namespace

std::vector<LogBin> log_bins(std::span<const double> time_s, std::span<const double> value,
                             double per_decade) {
  std::vector<LogBin> bins;
  const double ratio = per_decade > 0.0 ? std::pow(10.0, 1.0 / per_decade) : 1.0;
  for (std::size_t begin = 0; begin < time_s.size();) {
    std::size_t end = begin + 1;
    if (per_decade > 0.0 && time_s[begin] > 0.0) {
      const double limit = time_s[begin] * ratio;
      end = first_not_below(time_s, end, limit);
    }
    bins.push_back(make_bin(time_s, value, begin, end));
    begin = end;
  }
  return bins;
}

std::vector<LogBin> merged_bins(const std::vector<LogBin>& bins, double per_decade) {
  const double ratio = std::pow(10.0, 1.0 / per_decade);
  std::vector<LogBin> merged;
  for (std::size_t begin = 0; begin < bins.size();) {
    std::size_t end = begin + 1;
    if (bins[begin].time_s > 0.0) {
      const double limit = bins[begin].time_s * ratio;
      while (end < bins.size() && bins[end].time_s < limit) ++end;
    }
    merged.push_back(put_together({bins.data() + begin, end - begin}));
    begin = end;
  }
  return merged;
}

}  // namespace viscard
