#include "fit/large_strain/fit_large_strain.h"

#include "fit/large_strain/damage_checks.h"
#include "fit/large_strain/damage_search.h"
#include "fit/large_strain/foam_fit.h"
#include "fit/large_strain/hyperelastic_search.h"
#include "fit/large_strain/inverse_normal.h"
#include "fit/large_strain/rubber_band.h"
#include "fit/large_strain/rubber_bounds.h"
#include "fit/large_strain/rubber_checks.h"
#include "fit/large_strain/rubber_intervals.h"
#include "fit/large_strain/rubber_series.h"
#include "fit/large_strain/rubber_term_checks.h"
#include "fit/large_strain/series_choice.h"
#include "fit/large_strain/series_refine.h"
#include "fit/samples/noise_model.h"
#include "models/maths/distributions.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Factor on variances by the memory of the residuals along each test.
double inflation_of(const std::vector<LargeStrainTest>& tests, const VectorXd& residual) {
  double largest = 1.0;
  Index first = 0;
  for (const LargeStrainTest& test : tests) {
    const auto count = static_cast<Index>(test.stretch.size());
    largest = std::max(largest, autoregression(residual.segment(first, count)).inflation());
    first += count;
  }
  return largest;
}

// Weighted residuals of the readings, without the row of a known modulus.
VectorXd residuals_of(HyperelasticForm form, const LargeStrainRows& rows,
                      const HyperelasticPoint& point) {
  const auto columns = rows.columns(form, point.shapes, false);
  return (columns.values * point.moduli - rows.data()).head(rows.n_readings());
}

// Scatter of the readings about a law, with the memory of that scatter.
double scatter_about(HyperelasticForm form, const LargeStrainRows& rows,
                     const std::vector<LargeStrainTest>& tests, const HyperelasticPoint& point) {
  const VectorXd residual = residuals_of(form, rows, point);
  const double variance = residual.squaredNorm() / static_cast<double>(residual.size());
  return std::sqrt(variance * inflation_of(tests, residual));
}

bool has_uncertain_modulus(const LargeStrainOptions& options) {
  return options.modulus && options.modulus->se_Pa > 0.0;
}

// The best point. A modulus that is known with an error counts by the scatter of the readings about
// the law that has it exactly.
HyperelasticPoint point_of_form(HyperelasticForm form, LargeStrainRows& rows,
                                const std::vector<LargeStrainTest>& tests,
                                const LargeStrainOptions& options) {
  HyperelasticPoint point = best_point(form, rows);
  if (!has_uncertain_modulus(options)) return point;
  rows.set_scatter(scatter_about(form, rows, tests, point));
  return best_point(form, rows);
}

// The best point with damage: the law of the first loading, then all readings.
HyperelasticPoint point_with_damage(HyperelasticForm form, LargeStrainRows& rows,
                                    const std::vector<LargeStrainTest>& tests,
                                    const LargeStrainOptions& options) {
  const std::vector<LargeStrainTest> first = first_loading_of(tests);
  LargeStrainRows of_first(first, options);
  HyperelasticPoint law = point_of_form(form, of_first, first, options);
  const double change = of_first.stress_scale_Pa() / rows.stress_scale_Pa();
  if (has_uncertain_modulus(options)) {
    rows.set_scatter(change * scatter_about(form, of_first, first, law));
  }
  law.moduli *= change;
  return best_damaged_point(form, DamageRows(rows, tests), law);
}

// Independent readings, by the memory of the residuals of the point.
double n_effective_at(HyperelasticForm form, LargeStrainRows rows,
                      const std::vector<LargeStrainTest>& tests, const HyperelasticPoint& point) {
  rows.set_terms(point.terms);
  const VectorXd residual = residuals_of(form, rows, point);
  return static_cast<double>(residual.size()) / inflation_of(tests, residual);
}

// The best point with terms, whose number is chosen by BIC or given.
HyperelasticPoint point_of_series(HyperelasticForm form, LargeStrainRows& rows,
                                  const std::vector<LargeStrainTest>& tests,
                                  const LargeStrainOptions& options, int most_terms,
                                  std::vector<RubberOrder>& orders) {
  std::vector<HyperelasticPoint> path = series_path(form, rows, options.n_terms, most_terms);
  if (has_uncertain_modulus(options)) {
    rows.set_terms(path.back().terms);
    rows.set_scatter(scatter_about(form, rows, tests, path.back()));
    rows.set_terms({});
    path = series_path(form, rows, options.n_terms, most_terms);
  }
  const double n_effective = n_effective_at(form, rows, tests, path.back());
  return path[choose_series(path, rows, n_effective, orders)];
}

// Takes the covariance of moduli, shapes, g and ln tau apart.
void add_covariance(const Eigen::MatrixXd& all, FittedRubber& fitted) {
  const Index n = fitted.law.moduli_Pa.size() + fitted.law.shapes.size();
  fitted.covariance = all.topLeftCorner(n, n);
  if (!fitted.terms.empty()) fitted.series_covariance = all;
}

// The derivative of the rows' model at a point by all its parameters, and what it leaves of the readings.
struct Linearised {
  Eigen::MatrixXd slopes;
  VectorXd residual;
};
Linearised linearised(HyperelasticForm form, const LargeStrainRows& rows,
                      const std::vector<LargeStrainTest>& tests, const HyperelasticPoint& point) {
  if (point.damage) {
    const auto model = DamageRows(rows, tests).model(form, point, true);
    return {model.slopes, (model.values - rows.data()).head(rows.n_readings())};
  }
  return {point.terms.empty() ? jacobian(form, rows, point) : series_jacobian(form, rows, point),
          residuals_of(form, rows, point)};
}

FittedRubber fit_form(HyperelasticForm form, LargeStrainRows rows,
                      const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options,
                      int most_terms) {
  FittedRubber fitted;
  const HyperelasticPoint point =
      options.with_damage ? point_with_damage(form, rows, tests, options)
      : most_terms > 0    ? point_of_series(form, rows, tests, options, most_terms, fitted.orders)
                          : point_of_form(form, rows, tests, options);
  const double scale_Pa = rows.stress_scale_Pa();
  fitted.law = {form, scale_Pa * point.moduli, point.shapes};
  for (const RubberTerm& term : point.terms) fitted.terms.push_back({term});
  rows.set_terms(point.terms);
  const auto [slopes, residual] = linearised(form, rows, tests, point);
  fitted.inflation = inflation_of(tests, residual);
  const std::vector<Index> free = free_parameters(form, rows, point);
  fitted.n_parameters = static_cast<int>(slopes.cols());
  if (point.damage) {
    fitted.n_parameters -= (point.damage->fits_m ? 0 : 1) + (point.damage->fits_beta ? 0 : 1);
  }
  const double freedom = static_cast<double>(rows.data().size()) - fitted.n_parameters;
  const double variance = freedom > 0.0 ? residual.squaredNorm() / freedom : 0.0;
  Eigen::MatrixXd covariance =
      variance * fitted.inflation * inverse_normal(slopes, free, fitted.unseen);
  // So few independent readings determine their own variance only with the error of Student's t.
  constexpr double kLeastFreedom = 4.0;
  const double independent = static_cast<double>(residual.size()) / fitted.inflation;
  const double own = std::max(kLeastFreedom, independent - fitted.n_parameters);
  covariance *= std::pow(student_t_975(own) / kNormal95, 2);
  const Index n = n_moduli(form);
  const auto to_Pa = [&](auto&& rows_of) { rows_of *= scale_Pa; };
  to_Pa(covariance.topRows(n));
  to_Pa(covariance.leftCols(n));
  if (fitted.unseen.columns.size() > 0) {
    to_Pa(fitted.unseen.columns.topRows(n));
    to_Pa(fitted.unseen.step.head(n));
  }
  if (point.damage) {
    const Index m = n + n_shapes(form) + 1;
    to_Pa(covariance.row(m));
    to_Pa(covariance.col(m));
    if (fitted.unseen.columns.size() > 0) {
      to_Pa(fitted.unseen.columns.row(m));
      fitted.unseen.step[m] *= scale_Pa;
    }
  }
  add_covariance(covariance, fitted);
  add_intervals(fitted);
  if (point.damage) add_damage(tests, *point.damage, scale_Pa, covariance, fitted);
  add_residuals(tests, fitted);
  for (std::size_t d = 0; d < fitted.stable.size(); ++d) {
    fitted.stable[d] = stable_range(fitted.law, static_cast<Deformation>(d));
  }
  const bool is_on_bound = static_cast<int>(free.size()) < fitted.n_parameters;
  rows.set_terms({});
  add_rubber_flags(tests, options, point.is_converged, is_on_bound,
                   is_on_bound ? bound_text(form, rows, point, free) : "", fitted);
  add_term_flags(tests, options, fitted);
  return fitted;
}

// The criteria count readings that are independent of each other: the least inflation is that of the
// law that leaves the least structure in its residuals.
void add_criteria(const std::vector<LargeStrainTest>& tests, double least_inflation,
                  std::vector<FittedRubber>& laws) {
  double n_readings = 0.0, inflation = std::min(least_inflation, laws.front().inflation);
  for (const LargeStrainTest& test : tests) n_readings += static_cast<double>(test.stretch.size());
  for (const FittedRubber& law : laws) inflation = std::min(inflation, law.inflation);
  const double n = n_readings / inflation;
  for (FittedRubber& law : laws) {
    const double p = law.n_parameters + 1.0;  // the variance is one more
    // Below this share of the stresses residuals are rounding, and no evidence.
    constexpr double kRounding = 1e-9;
    const double of_stress = law.rss / std::pow(std::max(law.rms_relative, 1e-300), 2);
    const double rss = std::max(law.rss, kRounding * kRounding * of_stress);
    const double fit = n * std::log(std::max(rss, 1e-300) / n_readings);
    law.bic = fit + p * std::log(n);
    law.aicc = fit + 2.0 * p * (n > p + 1.0 ? n / (n - p - 1.0) : 1e6);
  }
}

// The same of the laws that were not asked for, so that the criteria of a law do not depend on which
// others were. With terms of relaxation that would take too long.
double inflation_of_others(const LargeStrainRows& rows, const std::vector<LargeStrainTest>& tests,
                           const LargeStrainOptions& options) {
  double least = std::numeric_limits<double>::infinity();
  for (const HyperelasticForm form : hyperelastic_forms()) {
    const bool is_asked =
        std::find(options.forms.begin(), options.forms.end(), form) != options.forms.end();
    if (is_asked) continue;
    LargeStrainRows own = rows;
    const HyperelasticPoint point = point_of_form(form, own, tests, options);
    if (!std::isfinite(point.rss)) continue;
    least = std::min(least, inflation_of(tests, residuals_of(form, own, point)));
  }
  return least;
}

}  // namespace

LargeStrainResult fit_large_strain(const std::vector<LargeStrainTest>& tests,
                                   const LargeStrainOptions& options) {
  check_large_strain(tests, options);
  if (!options.foam_terms.empty()) return fit_foam(tests, options);
  LargeStrainResult result;
  std::vector<MaterialFlag> notes;
  const int most_terms = options.with_damage ? 0 : most_terms_of(tests, options, notes);
  std::vector<LargeStrainTest> used = tests;
  for (LargeStrainTest& test : used) {
    if (most_terms == 0) test.time_s.clear();  // they may not even ascend
  }
  const LargeStrainRows rows(used, options);
  for (const HyperelasticForm form : options.forms) {
    result.laws.push_back(fit_form(form, rows, tests, options, most_terms));
  }
  const bool is_elastic = most_terms == 0 && !options.with_damage;
  const double least_inflation = is_elastic ? inflation_of_others(rows, tests, options)
                                            : std::numeric_limits<double>::infinity();
  add_criteria(tests, least_inflation, result.laws);
  result.chosen = best_law(result.laws);
  result.tests = summaries_of(tests, result.best());
  result.notes = notes_of(tests);
  result.notes.insert(result.notes.end(), notes.begin(), notes.end());
  return result;
}

}  // namespace viscard
