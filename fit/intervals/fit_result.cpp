#include "fit/intervals/fit_result.h"

#include "models/material/systematic_parts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

Interval combined_95(const Interval& interval, double value, double relative_u) {
  const double part = kNormal95 * relative_u * std::abs(value);
  const Interval wide{value - std::hypot(std::max(0.0, value - interval.low), part),
                      value + std::hypot(std::max(0.0, interval.high - value), part)};
  // A lower end that was not negative stays so.
  return interval.low >= 0.0 ? Interval{std::max(0.0, wide.low), wide.high} : wide;
}

ModulusIntervals combined_intervals(const FitResult& fit) {
  const double of_E_inf = systematic_u_of_E_inf(fit.systematic_parts, fitted_series(fit));
  return {combined_95(fit.E0_interval_95, fit.E0_Pa, fit.systematic_relative),
          combined_95(fit.E_inf_interval_95, fit.E_inf_Pa, of_E_inf)};
}

TermUncertainty combined_intervals(const FitResult& fit, std::size_t term) {
  FittedTerm one = fit.terms[term];
  const std::vector<SystematicPart>& parts = fit.systematic_parts;
  one.modulus_Pa_95 =
      combined_95(one.modulus_Pa_95, one.modulus_Pa, systematic_u_of_modulus(parts, term));
  one.g_95 = combined_95(one.g_95, one.g, systematic_u_of_g(parts, term));
  one.tau_s_95 = combined_95(one.tau_s_95, one.tau_s, systematic_u_of_tau(parts, term));
  return one;
}

PronySeries fitted_series(const FitResult& fit) {
  PronySeries series{fit.E_inf_Pa, {}};
  for (const FittedTerm& term : fit.terms) series.terms.push_back({term.modulus_Pa, term.tau_s});
  return series;
}

Material material_from_fit(const FitResult& fit, double nu, double rho_kg_m3) {
  if (fit.is_stiffness) {
    throw std::invalid_argument(
        "this fit gives stiffnesses in N/m, not moduli: the punch geometry was not given. Pass "
        "--punch-diameter (and --layer-thickness) or a specimen file");
  }
  Material material;
  material.E0_Pa = fit.E0_Pa;
  material.nu = nu;
  material.rho_kg_m3 = rho_kg_m3;
  MaterialUncertainty uncertainty;
  uncertainty.E0_Pa_95 = fit.E0_interval_95;
  uncertainty.E_inf_Pa_95 = fit.E_inf_interval_95;
  uncertainty.covariance_parameters = fit.covariance_parameters;
  uncertainty.covariance = fit.covariance;
  uncertainty.systematic_relative = fit.systematic_relative;
  uncertainty.systematic_parts = fit.systematic_parts;
  for (const FittedTerm& term : fit.terms) {
    material.terms.push_back({term.g, term.g, term.tau_s});
    uncertainty.terms.push_back(term);
  }
  material.uncertainty = uncertainty;
  material.flags = fit.flags;
  material.provenance.fit_from_s = fit.fit_from_s;
  material.provenance.fit_to_s = fit.fit_to_s;
  return material;
}

}  // namespace viscard
