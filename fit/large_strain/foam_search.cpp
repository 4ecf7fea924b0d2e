#include "fit/large_strain/foam_search.h"

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
using Indices = std::vector<std::size_t>;

// mu in units of scale_Pa, alpha, nu.
VectorXd foam_theta(const FoamPoint& point, double scale_Pa) {
  const Index n = point.law.mu_Pa.size();
  VectorXd theta(point.size());
  theta.head(n) = point.law.mu_Pa / scale_Pa;
  theta.segment(n, n) = point.law.alpha;
  if (point.fits_nu) theta.tail(theta.size() - 2 * n) = point.law.nu.head(theta.size() - 2 * n);
  return theta;
}

FoamLaw law_of_theta(const FoamPoint& point, const VectorXd& theta, double scale_Pa) {
  const Index n = point.law.mu_Pa.size();
  FoamLaw law{scale_Pa * theta.head(n), theta.segment(n, n), point.law.nu};
  if (!point.fits_nu) return law;
  if (point.has_one_nu) law.nu.setConstant(theta[2 * n]);
  if (!point.has_one_nu) law.nu = theta.tail(n);
  return law;
}

// By central differences; at a modulus of 0 by those to one side, because a law with a negative one may have
// no free side.
Eigen::MatrixXd slopes_of(const FoamRows& rows, const FoamPoint& point, const VectorXd& theta,
                          double scale_Pa) {
  Eigen::MatrixXd slopes(rows.data().size(), theta.size());
  for (Index k = 0; k < theta.size(); ++k) {
    const double step = 1e-6 * std::max(1e-2, std::abs(theta[k]));
    VectorXd up = theta, down = theta;
    const bool is_at_zero = k < point.law.mu_Pa.size() && theta[k] < step;
    up[k] += step;
    if (!is_at_zero) down[k] -= step;
    slopes.col(k) = (rows.model(law_of_theta(point, up, scale_Pa)) -
                     rows.model(law_of_theta(point, down, scale_Pa))) /
                    (up[k] - down[k]);
  }
  return slopes;
}

class FoamCost : public ceres::CostFunction {
 public:
  FoamCost(const FoamRows& rows, const FoamPoint& shape) : rows_(rows), shape_(shape) {
    set_num_residuals(static_cast<int>(rows.data().size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shape.size()));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const VectorXd theta = Eigen::Map<const VectorXd>(parameters[0], shape_.size());
    const double scale_Pa = rows_.stress_scale_Pa();
    Eigen::Map<VectorXd> left(residuals, rows_.data().size());
    left = rows_.model(law_of_theta(shape_, theta, scale_Pa)) - rows_.data();
    if (!left.allFinite()) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> slopes(jacobians[0], left.size(), theta.size());
    slopes = slopes_of(rows_, shape_, theta, scale_Pa);
    return slopes.allFinite();
  }

 private:
  const FoamRows& rows_;
  FoamPoint shape_;
};

FoamPoint refined_foam(const FoamRows& rows, const FoamPoint& start) {
  const double scale_Pa = rows.stress_scale_Pa();
  VectorXd theta = foam_theta(start, scale_Pa);
  const Index n = start.law.mu_Pa.size();
  ceres::Problem problem;
  problem.AddResidualBlock(new FoamCost(rows, start), nullptr, theta.data());
  for (Index k = 0; k < theta.size(); ++k) {
    const int at = static_cast<int>(k);
    const double low = k < n ? 0.0 : k < 2 * n ? -kMostAlpha : kLeastNu;
    problem.SetParameterLowerBound(theta.data(), at, low);
    if (k >= n) problem.SetParameterUpperBound(theta.data(), at, k < 2 * n ? kMostAlpha : kMostNu);
  }
  const SearchSummary summary =
      solve_dense(problem, {.max_iterations = 100, .function_tolerance = 1e-12});
  FoamPoint point = start;
  point.law = law_of_theta(start, theta, scale_Pa);
  point.rss = (rows.model(point.law) - rows.data()).squaredNorm();
  point.is_converged = summary.is_usable && std::isfinite(point.rss);
  return point;
}

// All choices of n ascending indices below `count`.
std::vector<Indices> choices(std::size_t count, Index n) {
  std::vector<Indices> all{{}};
  for (Index k = 0; k < n; ++k) {
    std::vector<Indices> longer;
    for (const Indices& chosen : all) {
      for (std::size_t i = chosen.empty() ? 0 : chosen.back() + 1; i < count; ++i) {
        longer.push_back(chosen);
        longer.back().push_back(i);
      }
    }
    all = std::move(longer);
  }
  return all;
}

constexpr double kAlphas[] = {-12.0, -6.0, -3.0, -1.5, 1.5, 3.0, 5.0, 8.0, 12.0, 18.0, 25.0};
constexpr double kRatios[] = {-0.1, 0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.45, 0.48};

// The best moduli of every choice of n exponents of the grid, with one nu.
void add_foam_starts(Index n, const FoamRows& rows, const FoamPoint& shape, double nu,
                     std::vector<FoamPoint>& points) {
  const auto law_with = [&](const VectorXd& mu_Pa, const VectorXd& alpha) {
    return FoamLaw{mu_Pa, alpha, VectorXd::Constant(alpha.size(), nu)};
  };
  // The sides do not depend on modulus and exponent, so that the difference of two moduli is linear.
  std::vector<VectorXd> columns;
  VectorXd fixed;  // the lateral rows
  for (const double alpha : kAlphas) {
    const double scale_Pa = rows.stress_scale_Pa();
    const VectorXd exponent = VectorXd::Constant(1, alpha);
    const VectorXd one = rows.model(law_with(VectorXd::Constant(1, scale_Pa), exponent));
    const VectorXd two = rows.model(law_with(VectorXd::Constant(1, 2.0 * scale_Pa), exponent));
    columns.push_back((two - one) / scale_Pa);
    if (fixed.size() == 0) fixed = 2.0 * one - two;
  }
  const VectorXd target = rows.data() - fixed;
  for (const Indices& chosen : choices(std::size(kAlphas), n)) {
    FoamPoint point = shape;
    VectorXd alpha(n);
    Eigen::MatrixXd used(target.size(), n);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      alpha[static_cast<Index>(k)] = kAlphas[chosen[k]];
      used.col(static_cast<Index>(k)) = columns[chosen[k]];
    }
    if (!used.allFinite()) continue;
    const std::vector<bool> is_free(static_cast<std::size_t>(n), false);
    const VectorXd mu_Pa = least_squares_with_signs(used, target, is_free);
    if (!(mu_Pa.array() > 0.0).any()) continue;
    point.law = law_with(mu_Pa, alpha);
    point.rss = (used * mu_Pa - target).squaredNorm();
    points.push_back(std::move(point));
  }
}

// The best of the points, each unlike those before.
std::vector<FoamPoint> best_few(std::vector<FoamPoint> points, std::size_t most) {
  std::sort(points.begin(), points.end(),
            [](const FoamPoint& a, const FoamPoint& b) { return a.rss < b.rss; });
  std::vector<FoamPoint> out;
  for (const FoamPoint& point : points) {
    const bool is_new = std::none_of(out.begin(), out.end(), [&](const FoamPoint& other) {
      return (other.law.alpha - point.law.alpha).norm() < 1.0 &&
             std::abs(other.law.nu[0] - point.law.nu[0]) < 0.06;
    });
    if (is_new) out.push_back(point);
    if (out.size() == most) break;
  }
  return out;
}

}  // namespace

Index FoamPoint::size() const {
  const Index n = law.mu_Pa.size();
  return 2 * n + (!fits_nu ? 0 : has_one_nu ? 1 : n);
}

FoamPoint best_foam(Index n_terms, const FoamRows& rows, std::optional<double> nu) {
  constexpr std::size_t kStarts = 5;
  const FoamRows few = rows.thinned(kSearchedReadings);
  FoamPoint shape;
  shape.fits_nu = !nu;
  std::vector<FoamPoint> points;
  if (nu) {
    add_foam_starts(n_terms, few, shape, *nu, points);
  } else {
    for (const double ratio : kRatios) add_foam_starts(n_terms, few, shape, ratio, points);
  }
  FoamPoint best;
  best.law = {VectorXd::Zero(n_terms), VectorXd::Ones(n_terms), VectorXd::Zero(n_terms)};
  best.fits_nu = shape.fits_nu;
  for (const FoamPoint& start : best_few(std::move(points), kStarts)) {
    FoamPoint point = refined_foam(few, start);
    if (point.rss < best.rss) best = std::move(point);
  }
  const bool is_all = few.data().size() == rows.data().size();
  return is_all || !best.is_converged ? best : refined_foam(rows, best);
}

FoamPoint with_own_nu(const FoamRows& rows, const FoamPoint& start) {
  const FoamRows few = rows.thinned(kSearchedReadings);
  FoamPoint best;
  // Apart from each other in both directions, because terms may not part from one nu by themselves.
  for (const double apart : {0.05, -0.05}) {
    FoamPoint point = start;
    point.has_one_nu = false;
    for (Index i = 0; i < point.law.nu.size(); ++i)
      point.law.nu[i] = std::clamp(point.law.nu[i] + (i == 0 ? apart : -apart), kLeastNu, kMostNu);
    point = refined_foam(few, point);
    if (point.rss < best.rss) best = std::move(point);
  }
  const bool is_all = few.data().size() == rows.data().size();
  return is_all || !best.is_converged ? best : refined_foam(rows, best);
}

Eigen::MatrixXd foam_jacobian(const FoamRows& rows, const FoamPoint& point) {
  const double scale_Pa = rows.stress_scale_Pa();
  Eigen::MatrixXd slopes = slopes_of(rows, point, foam_theta(point, scale_Pa), scale_Pa);
  slopes.leftCols(point.law.mu_Pa.size()) /= scale_Pa;
  return slopes;
}

}  // namespace viscard
