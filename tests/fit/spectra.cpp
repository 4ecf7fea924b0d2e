#include "tests/fit/spectra.h"

#include "models/material/hereditary.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace viscard::test {

PronySeries s2() {
  return {1.6, {{0.12, 0.8}, {0.08, 40.0}}};
}

PronySeries s6() {
  return {1.0,
          {{0.30, 0.03}, {0.25, 0.3}, {0.20, 3.0}, {0.15, 30.0}, {0.12, 300.0}, {0.10, 3000.0}}};
}

RelaxationData relaxation_of(const PronySeries& series, std::size_t n, double window_s,
                             double relative_noise, std::uint64_t seed, double rho) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double sigma = relative_noise * instantaneous_modulus_Pa(series);
  RelaxationData data;
  double noise = sigma * normal(random);  // stationary from the first sample on
  for (std::size_t i = 0; i < n; ++i) {
    const double t = window_s * static_cast<double>(i) / static_cast<double>(n - 1);
    data.time_s.push_back(t);
    data.value.push_back(relaxation_modulus_Pa(series, t) + noise);
    noise = rho * noise + std::sqrt(1.0 - rho * rho) * sigma * normal(random);
  }
  return data;
}

IndentationData indentation_of(const PronySeries& series, const std::vector<double>& time_s,
                               const std::function<double(double)>& depth_m, double relative_noise,
                               std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  IndentationData data;
  data.time_s = time_s;
  HereditaryStress stress(series);
  double last_s = time_s.front();
  for (const double t : time_s) {
    data.depth_m.push_back(depth_m(t));
    data.force_N.push_back(stress.advance(t - last_s, std::max(0.0, depth_m(t))));
    last_s = t;
  }
  const double sigma = relative_noise * *std::max_element(data.force_N.begin(), data.force_N.end());
  for (double& force : data.force_N) force += sigma * normal(random);
  return data;
}

std::function<double(double)> ramp_and_hold(double ramp_s) {
  return [ramp_s](double t) { return 1e-4 * std::clamp(t / ramp_s, 0.0, 1.0); };
}

std::vector<double> even_times(double to_s, double step_s) {
  std::vector<double> times;
  const auto count = static_cast<int>(std::lround(to_s / step_s));
  for (int i = 0; i <= count; ++i) times.push_back(step_s * i);
  return times;
}

}  // namespace viscard::test
