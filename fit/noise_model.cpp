#include "fit/noise_model.h"

#include <algorithm>
#include <cmath>

namespace viscard {

double integrated_autocorrelation(const Eigen::VectorXd& series) {
  const Eigen::Index count = series.size();
  if (count < 8) return 1.0;
  const double mean = series.mean();
  const Eigen::ArrayXd centred = series.array() - mean;
  const double variance = centred.square().sum();
  if (!(variance > 0.0)) return 1.0;
  constexpr double kWindow = 6.0;
  double sum = 1.0;
  for (Eigen::Index lag = 1; lag < count / 2; ++lag) {
    sum += 2.0 * (centred.head(count - lag) * centred.tail(count - lag)).sum() / variance;
    if (static_cast<double>(lag) >= kWindow * sum) break;
  }
  return std::max(1.0, sum);
}

double sigma_from_differences(const std::vector<double>& values) {
  if (values.size() < 5) return 0.0;
  std::vector<double> differences;
  for (std::size_t i = 3; i < values.size(); ++i) {
    differences.push_back(
        std::abs(values[i] - 3.0 * values[i - 1] + 3.0 * values[i - 2] - values[i - 3]));
  }
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  // Variance of a third difference of white noise is 1 + 9 + 9 + 1; median |N(0,1)| is 0.6745.
  return *middle / (0.6744897501960817 * std::sqrt(20.0));
}

}  // namespace viscard
