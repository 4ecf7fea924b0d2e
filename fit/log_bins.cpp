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
