#include "fit/large_strain/rubber_intervals.h"

#include "models/maths/interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Standard error of a quantity with this gradient; infinite if the data do not determine it.
double se_of(double variance, const VectorXd& gradient, const FittedRubber& fitted) {
  return fitted.unseen.change(gradient) ? kInfinity : std::sqrt(std::max(0.0, variance));
}

void add_parameters(FittedRubber& fitted) {
  std::vector<std::string> names = modulus_names(fitted.law.form);
  for (const std::string& name : shape_names(fitted.law.form)) names.push_back(name);
  VectorXd values(fitted.covariance.rows());
  values << fitted.law.moduli_Pa, fitted.law.shapes;
  for (Index i = 0; i < values.size(); ++i) {
    const double se = se_of(fitted.covariance(i, i), VectorXd::Unit(values.size(), i), fitted);
    fitted.parameters.push_back({names[static_cast<std::size_t>(i)],
                                 values[i],
                                 se,
                                 {values[i] - kNormal95 * se, values[i] + kNormal95 * se}});
  }
}

// Intervals of the terms and of the modulus after all relaxation; slope: of E0 by the parameters.
void add_series(const VectorXd& slope, FittedRubber& fitted) {
  const Index n = slope.size(), n_terms = static_cast<Index>(fitted.terms.size());
  fitted.E_inf_Pa = fitted.E0_Pa;
  fitted.E_inf_se_Pa = fitted.E0_se_Pa;
  fitted.E_inf_interval_95 = fitted.E0_interval_95;
  if (n_terms == 0) return;
  double left = 1.0;
  for (Index i = 0; i < n_terms; ++i) {
    FittedRubberTerm& term = fitted.terms[static_cast<std::size_t>(i)];
    const auto error_of = [&](Index k) {
      const VectorXd gradient = VectorXd::Unit(n + 2 * n_terms, k);
      return se_of(fitted.series_covariance(k, k), gradient, fitted);
    };
    term.g_se = error_of(n + i);
    term.ln_tau_se = error_of(n + n_terms + i);
    term.g_interval_95 = {term.g - kNormal95 * term.g_se, term.g + kNormal95 * term.g_se};
    const double factor = std::exp(kNormal95 * term.ln_tau_se);
    term.tau_s_interval_95 = {term.tau_s / factor, term.tau_s * factor};
    left -= term.g;
  }
  VectorXd of_rest = VectorXd::Zero(n + 2 * n_terms);
  of_rest.head(n) = left * slope;
  of_rest.segment(n, n_terms).setConstant(-fitted.E0_Pa);
  fitted.E_inf_Pa = left * fitted.E0_Pa;
  fitted.E_inf_se_Pa = se_of(of_rest.dot(fitted.series_covariance * of_rest), of_rest, fitted);
  const double half = kNormal95 * fitted.E_inf_se_Pa;
  fitted.E_inf_interval_95 = {fitted.E_inf_Pa - half, fitted.E_inf_Pa + half};
}

// Young's modulus at rest depends on the moduli, and on the shape of arruda-boyce.
void add_modulus(FittedRubber& fitted) {
  const HyperelasticLaw& law = fitted.law;
  fitted.E0_Pa = youngs_modulus_Pa(law);
  VectorXd slope = VectorXd::Zero(fitted.covariance.rows());
  slope.head(law.moduli_Pa.size()) = youngs_columns(law.form, law.shapes);
  for (Index k = 0; k < law.shapes.size(); ++k) {
    const double step = 1e-6 * std::max(1.0, std::abs(law.shapes[k]));
    HyperelasticLaw up = law, down = law;
    up.shapes[k] += step;
    down.shapes[k] -= step;
    slope[law.moduli_Pa.size() + k] =
        (youngs_modulus_Pa(up) - youngs_modulus_Pa(down)) / (2.0 * step);
  }
  fitted.E0_se_Pa = se_of(slope.dot(fitted.covariance * slope), slope, fitted);
  const double half = kNormal95 * fitted.E0_se_Pa;
  fitted.E0_interval_95 = {fitted.E0_Pa - half, fitted.E0_Pa + half};
  add_series(slope, fitted);
}

}  // namespace

void add_intervals(FittedRubber& fitted) {
  add_parameters(fitted);
  add_modulus(fitted);
}

}  // namespace viscard
