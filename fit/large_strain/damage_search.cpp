#include "fit/large_strain/damage_search.h"

#include "fit/search/dense_least_squares.h"
#include "models/maths/text_of_number.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Blocks: moduli and shapes; r; m; beta.
class DamageCost : public ceres::CostFunction {
 public:
  DamageCost(HyperelasticForm form, const DamageRows& rows) : form_(form), rows_(rows) {
    set_num_residuals(static_cast<int>(rows.undamaged().data().size()));
    const auto n_law = static_cast<int>(n_moduli(form) + n_shapes(form));
    for (const int size : {n_law, 1, 1, 1}) mutable_parameter_block_sizes()->push_back(size);
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Index n = n_moduli(form_), m = n_shapes(form_);
    HyperelasticPoint point;
    point.moduli = Eigen::Map<const VectorXd>(parameters[0], n);
    point.shapes = Eigen::Map<const VectorXd>(parameters[0] + n, m);
    point.damage = FoundDamage{{parameters[1][0], parameters[2][0], parameters[3][0]}};
    const auto model = rows_.model(form_, point, jacobians != nullptr);
    Eigen::Map<VectorXd> left(residuals, model.values.size());
    left = model.values - rows_.undamaged().data();
    if (!left.allFinite()) return false;
    if (jacobians == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[0], left.size(), n + m) = model.slopes.leftCols(n + m);
    }
    for (Index k = 0; k < 3; ++k) {
      double* const out = jacobians[k + 1];
      if (out != nullptr) Eigen::Map<VectorXd>(out, left.size()) = model.slopes.col(n + m + k);
    }
    return model.slopes.allFinite();
  }

 private:
  HyperelasticForm form_;
  const DamageRows& rows_;
};

double rss_of(HyperelasticForm form, const DamageRows& rows, const HyperelasticPoint& point) {
  return (rows.model(form, point, false).values - rows.undamaged().data()).squaredNorm();
}

HyperelasticPoint refined(HyperelasticForm form, const DamageRows& rows,
                          const HyperelasticPoint& start) {
  VectorXd theta(start.moduli.size() + start.shapes.size());
  theta << start.moduli, start.shapes;
  FoundDamage found = *start.damage;
  MullinsDamage& constants = found.constants;
  ceres::Problem problem;
  problem.AddResidualBlock(new DamageCost(form, rows), nullptr, theta.data(), &constants.r,
                           &constants.m_Pa, &constants.beta);
  const ShapeBounds bounds = shape_bounds(form, rows.undamaged());
  for (Index i = 0; i < theta.size(); ++i) {
    const int at = static_cast<int>(i);
    if (i >= start.moduli.size()) {
      problem.SetParameterLowerBound(theta.data(), at, bounds.low);
      problem.SetParameterUpperBound(theta.data(), at, bounds.high);
    } else if (!is_sign_free(form)) {
      problem.SetParameterLowerBound(theta.data(), at, 0.0);
    }
  }
  problem.SetParameterLowerBound(&constants.r, 0, kLeastR);
  problem.SetParameterUpperBound(&constants.r, 0, kMostR);
  const auto bound = [&](double& constant, bool is_free) {
    if (is_free) problem.SetParameterLowerBound(&constant, 0, 0.0);
    if (!is_free) problem.SetParameterBlockConstant(&constant);
  };
  bound(constants.m_Pa, found.fits_m);
  bound(constants.beta, found.fits_beta);
  const SearchSummary summary =
      solve_dense(problem, {.max_iterations = 300, .function_tolerance = 1e-14});
  HyperelasticPoint point = start;
  point.moduli = theta.head(start.moduli.size());
  point.shapes = theta.tail(start.shapes.size());
  point.damage = found;
  point.rss = rss_of(form, rows, point);
  point.is_converged = summary.is_usable && std::isfinite(point.rss);
  return point;
}

// Energies from which readings unloaded: the least and the largest.
struct Maxima {
  double least = 0.0, largest = 0.0;
};

Maxima maxima_of(const EnergyHistory& history) {
  Maxima out;
  for (Index i = 0; i < history.now.size(); ++i) {
    if (!history.is_damaged(i)) continue;
    const double top = history.largest[i];
    out.least = out.largest > 0.0 ? std::min(out.least, top) : top;
    out.largest = std::max(out.largest, top);
  }
  return out;
}

// The best r for m and beta: P = P_0 - P_0 erf(x)/r is linear in 1/r.
HyperelasticPoint with_best_r(HyperelasticForm form, const DamageRows& rows,
                              HyperelasticPoint point) {
  MullinsDamage& damage = point.damage->constants;
  const Index by_r = point.moduli.size() + point.shapes.size();
  damage.r = 1.0;
  const auto model = rows.model(form, point, true);
  const VectorXd softening = model.slopes.col(by_r);  // P_0 erf(x) at r = 1
  const VectorXd left = model.values + softening - rows.undamaged().data();
  const double inverse = softening.dot(left) / softening.squaredNorm();
  damage.r = inverse > 0.0 ? std::clamp(1.0 / inverse, kLeastR, kMostR) : kMostR;
  point.rss = rss_of(form, rows, point);
  return point;
}

// The best of a grid of m and beta, far enough from each other to lead to different minima.
std::vector<HyperelasticPoint> damage_starts(HyperelasticForm form, const DamageRows& rows,
                                             const HyperelasticPoint& law, const Maxima& maxima,
                                             bool fits_beta) {
  constexpr std::size_t kMostStarts = 3;
  const std::vector<double> betas =
      fits_beta ? std::vector<double>{0.01, 0.05, 0.2, 0.6} : std::vector<double>{0.0};
  std::vector<HyperelasticPoint> points;
  for (const double beta : betas) {
    for (double power = -2.5; power <= 1.0; power += 0.25) {
      HyperelasticPoint point = law;
      point.damage = FoundDamage{
          {1.0, maxima.largest * std::pow(10.0, power), beta}, true, fits_beta, !fits_beta};
      point = with_best_r(form, rows, std::move(point));
      if (std::isfinite(point.rss)) points.push_back(std::move(point));
    }
  }
  std::sort(points.begin(), points.end(),
            [](const HyperelasticPoint& a, const HyperelasticPoint& b) { return a.rss < b.rss; });
  points.resize(std::min(points.size(), kMostStarts));
  return points;
}

HyperelasticPoint best_of(HyperelasticForm form, const DamageRows& rows,
                          const std::vector<HyperelasticPoint>& starts) {
  HyperelasticPoint best = starts.front();
  best.rss = std::numeric_limits<double>::infinity();
  for (const HyperelasticPoint& start : starts) {
    HyperelasticPoint point = refined(form, rows, start);
    if (point.rss < best.rss) best = std::move(point);
  }
  return best;
}

// Holds a constant that ended at 0, and refines the others once more.
HyperelasticPoint with_zero_held(HyperelasticForm form, const DamageRows& rows,
                                 const HyperelasticPoint& point, double largest) {
  constexpr double kNothing = 1e-6;  // of m + beta W_m
  const MullinsDamage& constants = point.damage->constants;
  const double width = constants.m_Pa + constants.beta * largest;
  HyperelasticPoint held = point;
  if (point.damage->fits_beta && constants.beta * largest < kNothing * width) {
    held.damage->constants.beta = 0.0;
    held.damage->fits_beta = false;
  } else if (point.damage->fits_beta && constants.m_Pa < kNothing * width) {
    held.damage->constants.m_Pa = 0.0;
    held.damage->fits_m = false;
  } else {
    return point;
  }
  return refined(form, rows, held);
}

}  // namespace

std::vector<LargeStrainTest> first_loading_of(const std::vector<LargeStrainTest>& tests) {
  constexpr std::size_t kLeast = 3;
  std::vector<LargeStrainTest> out;
  std::size_t n_first = 0, n_others = 0;
  for (const LargeStrainTest& test : tests) {
    LargeStrainTest first{test.name, test.deformation, {}, {}};
    double largest = 0.0;
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      const double strain = std::abs(std::log(test.stretch[i]));
      if (strain < largest) continue;
      largest = strain;
      first.stretch.push_back(test.stretch[i]);
      first.nominal_stress_Pa.push_back(test.nominal_stress_Pa[i]);
    }
    n_first += first.stretch.size();
    n_others += test.stretch.size() - first.stretch.size();
    out.push_back(std::move(first));
  }
  if (n_first >= kLeast && n_others >= kLeast) return out;
  throw std::runtime_error(
      "the damage " + std::string(kMullinsName) +
      " needs 3 readings or more of a first loading and 3 or more of unloading or reloading, and "
      "the tests have " +
      std::to_string(n_first) + " and " + std::to_string(n_others) +
      "; give records of cycles with their rows in the order of time, or leave " + kMullinsName +
      " out of --model");
}

HyperelasticPoint best_damaged_point(HyperelasticForm form, const DamageRows& rows,
                                     const HyperelasticPoint& first_loading) {
  constexpr double kOneMaximum = 1.1;
  const Maxima maxima = maxima_of(rows.history(form, first_loading));
  const bool fits_beta = maxima.largest > kOneMaximum * maxima.least;
  const auto starts = damage_starts(form, rows, first_loading, maxima, fits_beta);
  HyperelasticPoint best = first_loading;
  if (starts.empty()) {
    best.damage = FoundDamage{{kMostR, 1.0, 0.0}, true, false, !fits_beta};
    best.is_converged = false;
    return best;
  }
  return with_zero_held(form, rows, best_of(form, rows, starts), maxima.largest);
}

}  // namespace viscard
