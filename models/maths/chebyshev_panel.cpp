#include "models/maths/chebyshev_panel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

// Over (-1, 1), ascending.
double chebyshev_point(int i, int count) {
  return -std::cos(std::numbers::pi * (i + 0.5) / count);
}

// Weights of the values there in the polynomial through them, at x.
Eigen::RowVectorXd chebyshev_weights(double x, int count) {
  Eigen::RowVectorXd weights(count);
  for (int i = 0; i < count; ++i) {
    const double distance = x - chebyshev_point(i, count);
    if (distance == 0.0) return Eigen::RowVectorXd::Unit(count, i);
    weights[i] =
        (i % 2 == 0 ? 1.0 : -1.0) * std::sin(std::numbers::pi * (i + 0.5) / count) / distance;
  }
  return weights / weights.sum();
}

}  // namespace

ChebyshevPanels::ChebyshevPanels(std::vector<double> breaks, int points,
                                 const std::function<Eigen::RowVectorXd(double x)>& values_at)
    : breaks_(std::move(breaks)) {
  for (std::size_t panel = 0; panel + 1 < breaks_.size(); ++panel) {
    const double low = breaks_[panel], high = breaks_[panel + 1];
    Eigen::MatrixXd& values = values_.emplace_back();
    for (int i = 0; i < points; ++i) {
      const Eigen::RowVectorXd row =
          values_at(0.5 * (low + high + (high - low) * chebyshev_point(i, points)));
      if (i == 0) values.resize(points, row.size());
      values.row(i) = row;
    }
  }
}

Eigen::RowVectorXd ChebyshevPanels::at(double x) const {
  const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, x);
  const auto panel = static_cast<std::size_t>(above - breaks_.begin() - 1);
  const double low = breaks_[panel], high = breaks_[panel + 1];
  const Eigen::MatrixXd& values = values_[panel];
  return chebyshev_weights((2.0 * x - low - high) / (high - low), static_cast<int>(values.rows())) *
         values;
}

}  // namespace viscard
