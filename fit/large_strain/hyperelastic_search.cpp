#include "fit/large_strain/hyperelastic_search.h"

#include "fit/search/dense_least_squares.h"
#include "fit/search/nnls.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Moduli, then shapes.
VectorXd theta_of(const HyperelasticPoint& point) {
  VectorXd theta(point.moduli.size() + point.shapes.size());
  theta << point.moduli, point.shapes;
  return theta;
}

class RubberCost : public ceres::CostFunction {
 public:
  RubberCost(HyperelasticForm form, const LargeStrainRows& rows) : form_(form), rows_(rows) {
    set_num_residuals(static_cast<int>(rows.data().size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(n_moduli(form) + n_shapes(form)));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Index n = n_moduli(form_), m = n_shapes(form_);
    HyperelasticPoint point;
    point.moduli = Eigen::Map<const VectorXd>(parameters[0], n);
    point.shapes = Eigen::Map<const VectorXd>(parameters[0] + n, m);
    const bool with_slopes = jacobians != nullptr && jacobians[0] != nullptr;
    const auto columns = rows_.columns(form_, point.shapes, with_slopes);
    Eigen::Map<VectorXd> left(residuals, rows_.data().size());
    left = columns.values * point.moduli - rows_.data();
    if (!left.allFinite()) return false;
    if (!with_slopes) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> slopes(jacobians[0], rows_.data().size(), n + m);
    slopes.leftCols(n) = columns.values;
    for (Index k = 0; k < m; ++k) {
      slopes.col(n + k) = columns.slopes[static_cast<std::size_t>(k)] * point.moduli;
    }
    return slopes.allFinite();
  }

 private:
  HyperelasticForm form_;
  const LargeStrainRows& rows_;
};

// The best moduli for these columns; an infinite rss if they are not finite.
void solve_moduli(HyperelasticForm form, const LargeStrainRows& rows,
                  const Eigen::MatrixXd& columns, ModulusSigns signs, HyperelasticPoint& point) {
  if (!columns.allFinite()) return;
  const bool any = signs == ModulusSigns::kAny || is_sign_free(form);
  const std::vector<bool> is_free(static_cast<std::size_t>(n_moduli(form)), any);
  point.moduli = least_squares_with_signs(columns, rows.data(), is_free);
  point.rss = (columns * point.moduli - rows.data()).squaredNorm();
}

HyperelasticPoint refined(HyperelasticForm form, const LargeStrainRows& rows, ModulusSigns signs,
                          const HyperelasticPoint& start) {
  VectorXd theta = theta_of(start);
  const Index n = n_moduli(form);
  ceres::Problem problem;
  problem.AddParameterBlock(theta.data(), static_cast<int>(theta.size()));
  const ShapeBounds bounds = shape_bounds(form, rows);
  for (Index i = 0; i < theta.size(); ++i) {
    const int at = static_cast<int>(i);
    if (i >= n) {
      problem.SetParameterLowerBound(theta.data(), at, bounds.low);
      problem.SetParameterUpperBound(theta.data(), at, bounds.high);
    } else if (signs == ModulusSigns::kOfForm && !is_sign_free(form)) {
      problem.SetParameterLowerBound(theta.data(), at, 0.0);
    }
  }
  problem.AddResidualBlock(new RubberCost(form, rows), nullptr, theta.data());
  const SearchSummary summary =
      solve_dense(problem, {.max_iterations = 300, .function_tolerance = 1e-14});
  // The moduli are solved exactly at the shapes that were found.
  HyperelasticPoint point = at_shapes(form, rows, theta.tail(theta.size() - n), signs);
  point.is_converged = summary.is_usable;
  return point;
}

// Values of one shape to begin with.
std::vector<double> shape_grid(HyperelasticForm form, const LargeStrainRows& rows) {
  if (form == HyperelasticForm::kGent) {
    std::vector<double> grid;
    for (double power = -4.0; power <= 4.0; power += 0.2) {
      grid.push_back(rows.largest_excess() * (1.0 + std::pow(10.0, power)));
    }
    return grid;
  }
  if (form == HyperelasticForm::kArrudaBoyce) {
    std::vector<double> grid;
    const double chain = std::sqrt(1.0 + rows.largest_excess() / 3.0);  // its largest stretch
    for (double power = -0.5; power <= 2.0; power += 0.1) {
      grid.push_back(chain * std::pow(10.0, power));
    }
    return grid;
  }
  return {-15.0, -10.0, -7.0, -5.0, -3.5, -2.5, -1.5, -0.7, 0.5, 1.0,
          1.5,   2.0,   3.0,  4.0,  5.5,  7.0,  9.0,  12.0, 16.0};
}

// The form with one term, whose shape is the first.
HyperelasticForm one_term(HyperelasticForm form) {
  return n_shapes(form) > 1 ? HyperelasticForm::kOgden1 : form;
}

// All choices of n ascending indices below `count`.
std::vector<std::vector<std::size_t>> combinations(std::size_t count, Index n) {
  std::vector<std::vector<std::size_t>> all{{}};
  for (Index k = 0; k < n; ++k) {
    std::vector<std::vector<std::size_t>> longer;
    for (const auto& chosen : all) {
      for (std::size_t i = chosen.empty() ? 0 : chosen.back() + 1; i < count; ++i) {
        longer.push_back(chosen);
        longer.back().push_back(i);
      }
    }
    all = std::move(longer);
  }
  return all;
}

bool is_close(const VectorXd& a, const VectorXd& b) {
  return ((a - b).array().abs() <= 0.3 * b.array().abs() + 0.3).all();
}

// The best grid points, far enough from each other to lead to different minima.
std::vector<HyperelasticPoint> starts_of(HyperelasticForm form, const LargeStrainRows& rows,
                                         ModulusSigns signs) {
  constexpr std::size_t kFew = 200, kMost = 6;
  const LargeStrainRows few = rows.thinned(kFew);
  const std::vector<double> grid = shape_grid(form, rows);
  // A term has one shape of its own, so that its column serves all combinations.
  std::vector<VectorXd> columns;
  for (const double shape : grid) {
    columns.push_back(few.columns(one_term(form), VectorXd::Constant(1, shape), false).values);
  }
  std::vector<HyperelasticPoint> points;
  for (const std::vector<std::size_t>& chosen : combinations(grid.size(), n_shapes(form))) {
    HyperelasticPoint point;
    point.shapes.resize(n_shapes(form));
    Eigen::MatrixXd used(few.data().size(), n_shapes(form));
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      point.shapes[static_cast<Index>(k)] = grid[chosen[k]];
      used.col(static_cast<Index>(k)) = columns[chosen[k]];
    }
    solve_moduli(form, few, used, signs, point);
    if (std::isfinite(point.rss)) points.push_back(std::move(point));
  }
  std::sort(points.begin(), points.end(),
            [](const HyperelasticPoint& a, const HyperelasticPoint& b) { return a.rss < b.rss; });
  std::vector<HyperelasticPoint> starts;
  for (const HyperelasticPoint& point : points) {
    const bool is_new = std::none_of(starts.begin(), starts.end(), [&](const auto& other) {
      return is_close(other.shapes, point.shapes);
    });
    if (is_new) starts.push_back(point);
    if (starts.size() == kMost) break;
  }
  return starts;
}

}  // namespace

bool is_sign_free(HyperelasticForm form) {
  return form == HyperelasticForm::kMooneyRivlin || form == HyperelasticForm::kYeoh;
}

ShapeBounds shape_bounds(HyperelasticForm form, const LargeStrainRows& rows) {
  constexpr double kNearLimit = 1e-9, kFar = 1e6;
  if (form == HyperelasticForm::kGent) {
    return {rows.largest_excess() * (1.0 + kNearLimit), rows.largest_excess() * kFar};
  }
  if (form == HyperelasticForm::kArrudaBoyce) return {0.1, 1e3};
  return {-40.0, 40.0};
}

HyperelasticPoint at_shapes(HyperelasticForm form, const LargeStrainRows& rows,
                            const VectorXd& shapes, ModulusSigns signs) {
  HyperelasticPoint point;
  point.shapes = shapes;
  solve_moduli(form, rows, rows.columns(form, shapes, false).values, signs, point);
  return point;
}

HyperelasticPoint best_point(HyperelasticForm form, const LargeStrainRows& rows,
                             ModulusSigns signs) {
  if (n_shapes(form) == 0) {
    HyperelasticPoint point = at_shapes(form, rows, VectorXd(0), signs);
    point.is_converged = true;
    return point;
  }
  HyperelasticPoint best;
  for (const HyperelasticPoint& start : starts_of(form, rows, signs)) {
    HyperelasticPoint point = refined(form, rows, signs, start);
    if (point.rss < best.rss) best = std::move(point);
  }
  return best;
}

Eigen::MatrixXd jacobian(HyperelasticForm form, const LargeStrainRows& rows,
                         const HyperelasticPoint& point) {
  const auto columns = rows.columns(form, point.shapes, true);
  Eigen::MatrixXd slopes(rows.data().size(), n_moduli(form) + n_shapes(form));
  slopes.leftCols(n_moduli(form)) = columns.values;
  for (Index k = 0; k < n_shapes(form); ++k) {
    slopes.col(n_moduli(form) + k) = columns.slopes[static_cast<std::size_t>(k)] * point.moduli;
  }
  return slopes;
}

}  // namespace viscard
