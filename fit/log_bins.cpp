#include "fit/log_bins.h"

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
  // Differences from the first sample, so that no digit is lost on a long record.
  double time = 0.0;
  double mean = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    time += time_s[i] - time_s[begin];
    mean += value[i] - value[begin];
  }
  bin.time_s = time_s[begin] + time / bin.count;
  bin.value = value[begin] + mean / bin.count;
  for (std::size_t i = begin; i < end; ++i) {
    const double t = time_s[i] - bin.time_s;
    const double y = value[i] - bin.value;
    const double tt = t * t;
    bin.m2 += tt;
    bin.m3 += tt * t;
    bin.m4 += tt * tt;
    bin.c1 += y * t;
    bin.c2 += y * tt;
    bin.value_m2 += y * y;
  }
  for (double* moment : {&bin.m2, &bin.m3, &bin.m4, &bin.c1, &bin.c2, &bin.value_m2}) {
    *moment /= bin.count;
  }
  return bin;
}

// Moments about the common mean from those about each bin's own.
LogBin put_together(std::span<const LogBin> parts) {
  LogBin sum;
  sum.begin = parts.front().begin;
  sum.end = parts.back().end;
  for (const LogBin& part : parts) sum.count += part.count;
  sum.time_s = parts.front().time_s;
  sum.value = parts.front().value;
  double time = 0.0, value = 0.0;
  for (const LogBin& part : parts) {
    time += part.count / sum.count * (part.time_s - parts.front().time_s);
    value += part.count / sum.count * (part.value - parts.front().value);
  }
  sum.time_s += time;
  sum.value += value;
  for (const LogBin& part : parts) {
    const double share = part.count / sum.count;
    const double d = part.time_s - sum.time_s;
    const double y = part.value - sum.value;
    sum.m2 += share * (part.m2 + d * d);
    sum.m3 += share * (part.m3 + 3.0 * d * part.m2 + d * d * d);
    sum.m4 += share * (part.m4 + 4.0 * d * part.m3 + 6.0 * d * d * part.m2 + d * d * d * d);
    sum.c1 += share * (part.c1 + y * d);
    sum.c2 += share * (part.c2 + 2.0 * d * part.c1 + y * (part.m2 + d * d));
    sum.value_m2 += share * (part.value_m2 + y * y);
  }
  return sum;
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
      while (end < time_s.size() && time_s[end] < limit) ++end;
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

BinExponential average_exponential(const LogBin& bin, double tau_s) {
  const double u = 1.0 / tau_s;
  const double x = bin.time_s * u;
  const double at_mean = std::exp(-x);
  if (at_mean == 0.0) return {};
  if (bin.count == 1.0) return {at_mean, x * at_mean};
  const double a = bin.m2 * u * u;
  const double b = bin.m3 * u * u * u;
  const double c = bin.m4 * u * u * u * u;
  const double series = 1.0 + a / 2.0 - b / 6.0 + c / 24.0;
  return {at_mean * series, at_mean * (x * series - (a - b / 2.0 + c / 6.0))};
}

}  // namespace viscard
