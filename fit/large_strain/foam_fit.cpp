#include "fit/large_strain/foam_fit.h"

#include "fit/large_strain/foam_search.h"
#include "fit/large_strain/inverse_normal.h"
#include "fit/large_strain/rubber_checks.h"
#include "fit/samples/noise_model.h"
#include "models/maths/distributions.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

bool shows_volume(FoamTest test) {
  return test == FoamTest::kConfined || test == FoamTest::kVolumetric;
}

// Throws unless the tests show nu, or it is given.
void require_ratio_shown(const std::vector<LargeStrainTest>& tests,
                         const LargeStrainOptions& options) {
  bool has_volume = false, has_other = false;
  for (const LargeStrainTest& test : tests) {
    if (!test.lateral_stretch.empty()) return;
    (shows_volume(test.foam_test) ? has_volume : has_other) = true;
  }
  if (options.poisson_ratio || (has_volume && has_other)) return;
  throw std::runtime_error(
      "the tests do not show the Poisson ratio of the foam. Add a column lateral_stretch, or a "
      "confined or volumetric test beside another one, or state --poisson-ratio (0 for open cells "
      "in compression is a usual guess, not a measurement)");
}

// By the memory of the residuals, in the order of the rows.
double foam_inflation(const VectorXd& residual) {
  return std::max(1.0, autoregression(residual).inflation());
}

// BIC over independent rows; the variance is one more parameter.
double foam_bic(const FoamPoint& point, double n_rows, double inflation) {
  constexpr double kRounding = 1e-18;
  const double n = n_rows / inflation;
  return n * std::log(std::max(point.rss / n_rows, kRounding)) +
         (static_cast<double>(point.size()) + 1.0) * std::log(n);
}

// One nu for all terms, or one for each if that is better by BIC.
FoamPoint best_with_nu(const FoamPoint& one_nu, const FoamRows& rows) {
  if (one_nu.law.mu_Pa.size() < 2 || !one_nu.fits_nu) return one_nu;
  constexpr double kBetter = 2.0;
  const FoamPoint own = with_own_nu(rows, one_nu);
  const auto n_rows = static_cast<double>(rows.data().size());
  const double inflation = foam_inflation(rows.model(own.law) - rows.data());
  const bool is_better =
      foam_bic(own, n_rows, inflation) < foam_bic(one_nu, n_rows, inflation) - kBetter;
  return own.is_converged && is_better ? own : one_nu;
}

std::vector<std::string> foam_parameter_names(const FoamPoint& point) {
  std::vector<std::string> names;
  const Index n = point.law.mu_Pa.size();
  for (const char* name : {"mu_", "alpha_"}) {
    for (Index i = 1; i <= n; ++i)
      names.push_back(name + std::to_string(i) + (*name == 'm' ? "_Pa" : ""));
  }
  if (point.has_one_nu) names.emplace_back("nu");
  for (Index i = 1; i <= n && !point.has_one_nu; ++i) names.push_back("nu_" + std::to_string(i));
  return names;
}

// Values of the parameters in the order of their names.
VectorXd foam_values(const FoamPoint& point) {
  const Index n = point.law.mu_Pa.size(), n_nu = point.has_one_nu ? 1 : n;
  VectorXd values(2 * n + n_nu);
  values << point.law.mu_Pa, point.law.alpha, point.law.nu.head(n_nu);
  return values;
}

FoamLaw foam_of_values(const FoamPoint& point, const VectorXd& values) {
  const Index n = point.law.mu_Pa.size();
  FoamLaw law{values.head(n), values.segment(n, n), VectorXd::Constant(n, values[2 * n])};
  if (!point.has_one_nu) law.nu = values.tail(n);
  return law;
}

// Parameters that did not end at a bound.
std::vector<Index> free_of(const FoamPoint& point) {
  constexpr double kTouch = 1e-6;
  const Index n = point.law.mu_Pa.size();
  std::vector<Index> free;
  for (Index i = 0; i < n; ++i) {
    if (point.law.mu_Pa[i] > 0.0) free.push_back(i);
  }
  for (Index i = 0; i < n; ++i) {
    const bool is_inside = std::abs(point.law.alpha[i]) < kMostAlpha * (1.0 - kTouch);
    if (is_inside && point.law.mu_Pa[i] > 0.0) free.push_back(n + i);
  }
  for (Index k = 2 * n; k < point.size(); ++k) {
    const double nu = point.law.nu[k - 2 * n];
    if (nu > kLeastNu + kTouch && nu < kMostNu - kTouch) free.push_back(k);
  }
  return free;
}

void add_foam_intervals(const FoamPoint& point, FittedRubber& fitted) {
  const VectorXd values = foam_values(point);
  const std::vector<std::string> names = foam_parameter_names(point);
  const auto error_of = [&](const VectorXd& gradient) {
    if (fitted.unseen.change(gradient)) return std::numeric_limits<double>::infinity();
    return std::sqrt(std::max(0.0, gradient.dot(fitted.covariance * gradient)));
  };
  for (Index k = 0; k < values.size(); ++k) {
    const double se = error_of(VectorXd::Unit(values.size(), k)), half = kNormal95 * se;
    fitted.parameters.push_back(
        {names[static_cast<std::size_t>(k)], values[k], se, {values[k] - half, values[k] + half}});
  }
  VectorXd slope(values.size());
  for (Index k = 0; k < values.size(); ++k) {
    const double step = 1e-6 * std::max(1e-3, std::abs(values[k]));
    VectorXd up = values, down = values;
    up[k] += step;
    down[k] -= step;
    slope[k] = (youngs_modulus_Pa(foam_of_values(point, up)) -
                youngs_modulus_Pa(foam_of_values(point, down))) /
               (2.0 * step);
  }
  fitted.E0_Pa = fitted.E_inf_Pa = youngs_modulus_Pa(point.law);
  fitted.E0_se_Pa = fitted.E_inf_se_Pa = error_of(slope);
  const double half = kNormal95 * fitted.E0_se_Pa;
  fitted.E0_interval_95 = fitted.E_inf_interval_95 = {fitted.E0_Pa - half, fitted.E0_Pa + half};
}

// Covariance of all parameters with names; rows of those that are held are zero.
void add_foam_covariance(const FoamRows& rows, const FoamPoint& point,
                         const std::vector<Index>& free, FittedRubber& fitted) {
  const VectorXd residual = rows.model(point.law) - rows.data();
  fitted.inflation = foam_inflation(residual);
  const Eigen::MatrixXd slopes = foam_jacobian(rows, point);
  const double freedom =
      std::max(1.0, static_cast<double>(residual.size()) - static_cast<double>(point.size()));
  constexpr double kLeastFreedom = 4.0;
  const double own =
      std::max(kLeastFreedom, static_cast<double>(residual.size()) / fitted.inflation -
                                  static_cast<double>(point.size()));
  const double variance = residual.squaredNorm() / freedom * fitted.inflation *
                          std::pow(student_t_975(own) / kNormal95, 2);
  const Eigen::MatrixXd fitted_part = variance * inverse_normal(slopes, free, fitted.unseen);
  const Index n_all = foam_values(point).size(), n_fitted = point.size();
  fitted.covariance = Eigen::MatrixXd::Zero(n_all, n_all);
  fitted.covariance.topLeftCorner(n_fitted, n_fitted) = fitted_part;
  if (fitted.unseen.columns.size() == 0 || n_all == n_fitted) return;
  fitted.unseen.columns.conservativeResizeLike(
      Eigen::MatrixXd::Zero(n_all, fitted.unseen.columns.cols()));
  fitted.unseen.step.conservativeResizeLike(VectorXd::Zero(n_all));
}

std::string held_text(const FoamPoint& point, const std::vector<Index>& free) {
  std::string text;
  const VectorXd values = foam_values(point);
  const auto names = foam_parameter_names(point);
  for (Index k = 0; k < point.size(); ++k) {
    if (std::find(free.begin(), free.end(), k) != free.end()) continue;
    text += (text.empty() ? "" : ", ") + names[static_cast<std::size_t>(k)] + " at " +
            text_of(values[k], 4);
  }
  return text;
}

// The terms by falling modulus.
void sort_terms(FoamLaw& law) {
  std::vector<Index> order;
  for (Index i = 0; i < law.mu_Pa.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return law.mu_Pa[a] > law.mu_Pa[b]; });
  const FoamLaw before = law;
  for (Index i = 0; i < law.mu_Pa.size(); ++i) {
    const Index from = order[static_cast<std::size_t>(i)];
    law.mu_Pa[i] = before.mu_Pa[from];
    law.alpha[i] = before.alpha[from];
    law.nu[i] = before.nu[from];
  }
}

FittedRubber fit_foam_terms(Index n_terms, const FoamRows& rows,
                            const std::vector<LargeStrainTest>& tests,
                            const LargeStrainOptions& options) {
  FoamPoint point = best_with_nu(best_foam(n_terms, rows, options.poisson_ratio), rows);
  if (!std::isfinite(point.rss)) {
    throw std::runtime_error("no " + foam_name(n_terms) +
                             " with positive moduli comes near the tests; see that stresses and "
                             "strains have the same sign, and that strains are not in per cent");
  }
  sort_terms(point.law);
  FittedRubber fitted;
  fitted.foam = FittedFoam{point.law, point.has_one_nu, !point.fits_nu};
  const std::vector<Index> free = free_of(point);
  fitted.n_parameters = static_cast<int>(point.size());
  add_foam_covariance(rows, point, free, fitted);
  add_foam_intervals(point, fitted);
  add_residuals(tests, fitted);
  for (std::size_t d = 0; d < fitted.stable.size(); ++d)
    fitted.stable[d] = stable_range(point.law, static_cast<FoamTest>(d));
  const bool is_on_bound = static_cast<Index>(free.size()) < point.size();
  add_rubber_flags(tests, options, point.is_converged, is_on_bound, held_text(point, free), fitted);
  if (!point.fits_nu) {
    fitted.flags.push_back(
        {"poisson-ratio-given", 0,
         "the Poisson ratio " + text_of(point.law.nu[0], 4) + " was given, not measured"});
  } else if (point.has_one_nu && n_terms > 1) {
    fitted.flags.push_back({"one-poisson-ratio", 0,
                            "all terms have one Poisson ratio; one of each is no better by BIC"});
  }
  return fitted;
}

// The criteria of all laws, with the inflation of the one that leaves the least structure.
void add_foam_criteria(const FoamRows& rows, std::vector<FittedRubber>& laws) {
  double inflation = laws.front().inflation;
  for (const FittedRubber& law : laws) inflation = std::min(inflation, law.inflation);
  const auto n_rows = static_cast<double>(rows.data().size());
  for (FittedRubber& law : laws) {
    FoamPoint point;
    point.law = law.foam->law;
    point.has_one_nu = law.foam->has_one_nu;
    point.fits_nu = !law.foam->nu_is_given;
    point.rss = (rows.model(point.law) - rows.data()).squaredNorm();
    law.bic = foam_bic(point, n_rows, inflation);
    const double n = n_rows / inflation, p = law.n_parameters + 1.0;
    law.aicc = law.bic - p * std::log(n) + 2.0 * p * (n > p + 1.0 ? n / (n - p - 1.0) : 1e6);
  }
}

void add_foam_notes(const std::vector<LargeStrainTest>& tests, LargeStrainResult& result) {
  const bool has_platens = std::any_of(tests.begin(), tests.end(), [](const LargeStrainTest& test) {
    return test.foam_test == FoamTest::kUniaxial && test.lateral_stretch.empty() &&
           *std::min_element(test.stretch.begin(), test.stretch.end()) < 0.95;
  });
  if (has_platens) {
    result.notes.push_back(
        {"platens", 0,
         "uniaxial compression without its lateral stretch: friction at the platens makes the test "
         "of "
         "a flat specimen nearly confined, so compare its height with its width"});
  }
}

}  // namespace

LargeStrainResult fit_foam(const std::vector<LargeStrainTest>& tests,
                           const LargeStrainOptions& options) {
  require_ratio_shown(tests, options);
  const FoamRows rows(tests);
  LargeStrainResult result;
  for (const Index n_terms : options.foam_terms)
    result.laws.push_back(fit_foam_terms(n_terms, rows, tests, options));
  add_foam_criteria(rows, result.laws);
  result.chosen = best_law(result.laws);
  result.tests = summaries_of(tests, result.best());
  add_foam_notes(tests, result);
  return result;
}

}  // namespace viscard
