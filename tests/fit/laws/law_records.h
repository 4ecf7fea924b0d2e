#pragma once

#include "fit/fit_relaxation.h"

#include <cmath>
#include <functional>
#include <random>
#include <vector>

// Records of a curve, to be fitted with laws.
namespace viscard::test {

using Curve = std::function<double(double)>;

inline FitOptions with_laws() {
  FitOptions options;
  options.with_laws = true;
  return options;
}

inline std::vector<double> log_times(double from, double to, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(from * std::pow(to / from, i / (count - 1.0)));
  return times;
}

// The curve with a relative noise.
inline std::vector<double> values_of(const Curve& curve, const std::vector<double>& at,
                                     double noise, unsigned seed) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (const double x : at) values.push_back(curve(x) * (1.0 + noise * normal(dice)));
  return values;
}

inline FitResult relaxation_fit(const Curve& curve, double noise = 0.0, unsigned seed = 1) {
  const std::vector<double> time_s = log_times(1e-2, 1e3, 200);
  return fit_relaxation({time_s, values_of(curve, time_s, noise, seed), {}}, with_laws());
}

}  // namespace viscard::test
