// The refinement of all parameters of a law with terms together.
#include "fit/large_strain/series_refine.h"

#include "fit/search/dense_least_squares.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;

// Moduli, shapes, g, ln tau.
Vector all_parameters(const HyperelasticPoint& point) {
  const Index n = point.moduli.size(), m = point.shapes.size();
  const auto k = static_cast<Index>(point.terms.size());
  Vector theta(n + m + 2 * k);
  theta.head(n + m) << point.moduli, point.shapes;
  for (Index i = 0; i < k; ++i) {
    const RubberTerm& term = point.terms[static_cast<std::size_t>(i)];
    theta[n + m + i] = term.g;
    theta[n + m + k + i] = std::log(term.tau_s);
  }
  return theta;
}

HyperelasticPoint point_from(HyperelasticForm form, const Vector& theta) {
  const Index n = n_moduli(form), m = n_shapes(form), k = (theta.size() - n - m) / 2;
  HyperelasticPoint point;
  point.moduli = theta.head(n);
  point.shapes = theta.segment(n, m);
  for (Index i = 0; i < k; ++i) {
    point.terms.push_back({theta[n + m + i], std::exp(theta[n + m + k + i])});
  }
  return point;
}

class SeriesCost : public ceres::CostFunction {
 public:
  SeriesCost(HyperelasticForm form, const LargeStrainRows& rows, int n_parameters)
      : form_(form), rows_(rows), n_parameters_(n_parameters) {
    set_num_residuals(static_cast<int>(rows.data().size()));
    mutable_parameter_block_sizes()->push_back(n_parameters);
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Vector theta = Eigen::Map<const Vector>(parameters[0], n_parameters_);
    const HyperelasticPoint point = point_from(form_, theta);
    const auto parts =
        rows_.parts({form_, point.moduli, point.shapes}, times_of(point.terms), false);
    Eigen::Map<Vector> left(residuals, rows_.data().size());
    left = parts.at_once - rows_.data();
    for (Index i = 0; i < parts.relaxed.cols(); ++i) {
      left += point.terms[static_cast<std::size_t>(i)].g * (parts.relaxed.col(i) - parts.at_once);
    }
    if (!left.allFinite()) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> slopes(jacobians[0], rows_.data().size(), n_parameters_);
    slopes = series_jacobian(form_, rows_, point);
    return slopes.allFinite();
  }

 private:
  HyperelasticForm form_;
  const LargeStrainRows& rows_;
  int n_parameters_ = 0;
};

}  // namespace

std::vector<double> times_of(const std::vector<RubberTerm>& terms) {
  std::vector<double> tau_s;
  for (const RubberTerm& term : terms) tau_s.push_back(term.tau_s);
  return tau_s;
}

TimeRange time_range(const LargeStrainRows& rows) {
  return {rows.least_step_s() / 3.0, 3.0 * rows.longest_test_s()};
}

Eigen::MatrixXd series_jacobian(HyperelasticForm form, LargeStrainRows rows,
                                const HyperelasticPoint& point) {
  rows.set_terms(point.terms);
  const Index n = n_moduli(form) + n_shapes(form), k = static_cast<Index>(point.terms.size());
  Eigen::MatrixXd slopes(rows.data().size(), n + 2 * k);
  slopes.leftCols(n) = jacobian(form, rows, point);
  const auto parts = rows.parts({form, point.moduli, point.shapes}, times_of(point.terms), true);
  for (Index i = 0; i < k; ++i) {
    slopes.col(n + i) = parts.relaxed.col(i) - parts.at_once;
    slopes.col(n + k + i) = point.terms[static_cast<std::size_t>(i)].g * parts.by_ln_tau.col(i);
  }
  return slopes;
}

HyperelasticPoint refined_series(HyperelasticForm form, const LargeStrainRows& rows,
                                 const HyperelasticPoint& start) {
  Vector theta = all_parameters(start);
  const Index n = n_moduli(form), m = n_shapes(form);
  const auto k = static_cast<Index>(start.terms.size());
  ceres::Problem problem;
  problem.AddParameterBlock(theta.data(), static_cast<int>(theta.size()));
  const auto hold_within = [&](Index i, double low, double high) {
    theta[i] = std::clamp(theta[i], low, high);
    problem.SetParameterLowerBound(theta.data(), static_cast<int>(i), low);
    problem.SetParameterUpperBound(theta.data(), static_cast<int>(i), high);
  };
  const ShapeBounds bounds = shape_bounds(form, rows);
  const TimeRange range = time_range(rows);
  constexpr double kLarge = 1e12;
  for (Index i = 0; i < n && !is_sign_free(form); ++i) hold_within(i, 0.0, kLarge);
  for (Index i = n; i < n + m; ++i) hold_within(i, bounds.low, bounds.high);
  for (Index i = n + m; i < n + m + k; ++i) {
    hold_within(i, 0.0, 2.0);
    hold_within(i + k, std::log(range.low_s), std::log(range.high_s));
  }
  problem.AddResidualBlock(new SeriesCost(form, rows, static_cast<int>(theta.size())), nullptr,
                           theta.data());
  const SearchSummary summary = solve_dense(
      problem, {.max_iterations = 100, .function_tolerance = 1e-11, .parameter_tolerance = 1e-9});
  HyperelasticPoint point = point_from(form, theta);
  point.rss = summary.rss;
  point.is_converged = summary.is_usable;
  std::sort(point.terms.begin(), point.terms.end(),
            [](const RubberTerm& a, const RubberTerm& b) { return a.tau_s < b.tau_s; });
  return point;
}

}  // namespace viscard
