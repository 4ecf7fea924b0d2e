#include "io/report/report_estimates.h"

#include "models/material/systematic_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void take_fit(const FitResult& fit, SpecimenEstimates& estimates) {
  estimates.is_stiffness = fit.is_stiffness;
  estimates.E0_Pa = {fit.E0_Pa, fit.E0_interval_95};
  estimates.E_inf_Pa = {fit.E_inf_Pa, fit.E_inf_interval_95};
  estimates.sum_g = {1.0 - fit.E_inf_Pa / fit.E0_Pa, fit.sum_g_95};
  estimates.is_trustworthy = fit.is_trustworthy;
  for (const FittedTerm& term : fit.terms) {
    estimates.terms.push_back(
        {{term.modulus_Pa, term.modulus_Pa_95}, {term.g, term.g_95}, {term.tau_s, term.tau_s_95}});
  }
  estimates.systematic_relative = fit.systematic_relative;
  estimates.systematic_parts = fit.systematic_parts;
  estimates.two_point = fit.two_point;
  estimates.flags = fit.flags;
  estimates.covariance_parameters = fit.covariance_parameters;
  estimates.covariance = fit.covariance;
}

void take_material(const Material& material, SpecimenEstimates& estimates) {
  const PronySeries series = young_series(material);
  estimates.E0_Pa.value = material.E0_Pa;
  estimates.E_inf_Pa.value = series.equilibrium_modulus_Pa;
  for (const MaxwellTerm& term : series.terms) {
    estimates.terms.push_back({{term.modulus_Pa, {}},
                               {term.modulus_Pa / material.E0_Pa, {}},
                               {term.relaxation_time_s, {}}});
  }
  estimates.sum_g.value = 1.0 - series.equilibrium_modulus_Pa / material.E0_Pa;
  estimates.flags = material.flags;
  // The uncertainties apply to E(t) only if the Poisson ratio is constant.
  if (!material.uncertainty || !has_constant_poisson_ratio(material)) return;
  const MaterialUncertainty& uncertainty = *material.uncertainty;
  estimates.E0_Pa.interval_95 = uncertainty.E0_Pa_95;
  estimates.E_inf_Pa.interval_95 = uncertainty.E_inf_Pa_95;
  for (std::size_t i = 0; i < std::min(estimates.terms.size(), uncertainty.terms.size()); ++i) {
    estimates.terms[i].modulus_Pa.interval_95 = uncertainty.terms[i].modulus_Pa_95;
    estimates.terms[i].g.interval_95 = uncertainty.terms[i].g_95;
    estimates.terms[i].tau_s.interval_95 = uncertainty.terms[i].tau_s_95;
  }
  estimates.systematic_relative = uncertainty.systematic_relative;
  estimates.systematic_parts = systematic_parts_of(uncertainty);
  estimates.covariance_parameters = uncertainty.covariance_parameters;
  estimates.covariance = uncertainty.covariance;
}

// d E(t) / d parameter, or 0 for a nuisance parameter.
double slope(const SpecimenEstimates& estimates, const std::string& parameter, double time_s) {
  const char* unit = estimates.is_stiffness ? "_N_m" : "_Pa";
  if (parameter == std::string("E_inf") + unit) return 1.0;
  for (std::size_t i = 0; i < estimates.terms.size(); ++i) {
    const double tau_s = estimates.terms[i].tau_s.value;
    const double decay = std::exp(-time_s / tau_s);
    if (parameter == fmt::format("E_{}{}", i + 1, unit)) return decay;
    if (parameter == fmt::format("ln_tau_{}", i + 1)) {
      return estimates.terms[i].modulus_Pa.value * decay * time_s / tau_s;
    }
  }
  return 0.0;
}

Eigen::VectorXd slopes(const SpecimenEstimates& estimates, double time_s) {
  Eigen::VectorXd gradient(static_cast<Eigen::Index>(estimates.covariance_parameters.size()));
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    gradient[i] =
        slope(estimates, estimates.covariance_parameters[static_cast<std::size_t>(i)], time_s);
  }
  return gradient;
}

bool has_covariance(const SpecimenEstimates& estimates) {
  const Eigen::Index n = static_cast<Eigen::Index>(estimates.covariance_parameters.size());
  return n > 0 && estimates.covariance.rows() == n && estimates.covariance.cols() == n &&
         estimates.covariance.allFinite();
}

Recovery recovery_of(double truth, const Estimate& estimate, double systematic_relative) {
  if (!std::isfinite(truth) || !std::isfinite(estimate.value)) return Recovery::kNotResolved;
  const Interval& interval = estimate.interval_95;
  if (interval.low == 0.0 && interval.high == 0.0) return Recovery::kNoInterval;
  if (truth >= interval.low && truth <= interval.high) return Recovery::kInside;
  const double random =
      truth > estimate.value ? interval.high - estimate.value : estimate.value - interval.low;
  const double systematic = kNormal95 * systematic_relative * std::abs(estimate.value);
  return std::abs(truth - estimate.value) <= std::hypot(random, systematic)
             ? Recovery::kInsideWithSystematic
             : Recovery::kOutside;
}

RecoveredParameter recovered(const std::string& name_html, const std::string& unit, double truth,
                             const Estimate& estimate, double systematic_relative) {
  return {name_html, unit, truth, estimate, recovery_of(truth, estimate, systematic_relative)};
}

// For each true term the index of a fitted term, or nothing; each fitted term is used at most once.
std::vector<std::optional<std::size_t>> paired_terms(const std::vector<MaxwellTerm>& truth,
                                                     const std::vector<TermEstimate>& fitted) {
  std::vector<std::optional<std::size_t>> pairs(truth.size());
  std::vector<bool> is_taken(fitted.size(), false);
  for (std::size_t round = 0; round < std::min(truth.size(), fitted.size()); ++round) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t best_truth = 0, best_fit = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      for (std::size_t j = 0; j < fitted.size(); ++j) {
        if (pairs[i] || is_taken[j]) continue;
        const double apart = std::abs(std::log(truth[i].relaxation_time_s / fitted[j].tau_s.value));
        if (!(apart < nearest)) continue;
        nearest = apart;
        best_truth = i;
        best_fit = j;
      }
    }
    if (!std::isfinite(nearest)) break;
    pairs[best_truth] = best_fit;
    is_taken[best_fit] = true;
  }
  return pairs;
}

PronySeries series_from_estimates(const SpecimenEstimates& estimates) {
  PronySeries series;
  series.equilibrium_modulus_Pa = estimates.E_inf_Pa.value;
  for (const TermEstimate& term : estimates.terms) {
    series.terms.push_back({term.modulus_Pa.value, term.tau_s.value});
  }
  return series;
}

}  // namespace

SpecimenEstimates estimates_from_specimen(const SpecimenReport& specimen, std::size_t index) {
  SpecimenEstimates estimates;
  estimates.label = specimen.specimen.id;
  if (estimates.label.empty() && specimen.material) estimates.label = specimen.material->name;
  if (estimates.label.empty()) estimates.label = "specimen " + std::to_string(index + 1);
  estimates.anchor = "specimen-" + std::to_string(index + 1);
  estimates.mixing_ratio = specimen.specimen.mixing_ratio;
  if (specimen.material) estimates.specimen_id = specimen.material->specimen_id;
  if (specimen.fit) {
    take_fit(*specimen.fit, estimates);
  } else if (specimen.material) {
    take_material(*specimen.material, estimates);
  } else {
    throw std::invalid_argument(
        "report: " + estimates.label +
        " has neither a fit nor a material; give a capture, a table or a material file");
  }
  return estimates;
}

ShownUnit modulus_unit(const std::vector<SpecimenEstimates>& estimates) {
  std::vector<double> values;
  for (const SpecimenEstimates& specimen : estimates) values.push_back(specimen.E0_Pa.value);
  return shown_unit(estimates.front().is_stiffness ? "N/m" : "Pa", values);
}

bool have_own_units(const std::vector<SpecimenEstimates>& estimates) {
  constexpr double kFactor = 300.0;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const SpecimenEstimates& specimen : estimates) {
    if (!(specimen.E0_Pa.value > 0.0)) continue;
    least = std::min(least, specimen.E0_Pa.value);
    most = std::max(most, specimen.E0_Pa.value);
  }
  return most > kFactor * least;
}

RelaxationBand relaxation_band(const SpecimenEstimates& estimates,
                               const std::vector<double>& time_s, bool is_relative) {
  const PronySeries series = series_from_estimates(estimates);
  const double E0_Pa = instantaneous_modulus_Pa(series);
  const bool has_band = has_covariance(estimates);
  const Eigen::VectorXd slopes_at_0 = slopes(estimates, 0.0);
  RelaxationBand band;
  for (const double t : time_s) {
    const double modulus_Pa = relaxation_modulus_Pa(series, t);
    const double value = is_relative ? modulus_Pa / E0_Pa : modulus_Pa;
    band.time_s.push_back(t);
    band.value.push_back(value);
    if (!has_band) continue;
    Eigen::VectorXd gradient = slopes(estimates, t);
    if (is_relative) gradient = (gradient - value * slopes_at_0) / E0_Pa;
    const double variance = gradient.dot(estimates.covariance * gradient);
    const double half = kNormal95 * std::sqrt(std::max(0.0, variance));
    band.low.push_back(value - half);
    band.high.push_back(value + half);
  }
  return band;
}

std::vector<RecoveredParameter> recovered_parameters(const SpecimenEstimates& estimates,
                                                     const Material& truth) {
  const PronySeries series = young_series(truth);
  MaterialUncertainty stated;
  stated.systematic_relative = estimates.systematic_relative;
  stated.systematic_parts = estimates.systematic_parts;
  const std::vector<SystematicPart> parts = systematic_parts_of(stated);
  const Estimate none{kNaN, {}};
  std::vector<RecoveredParameter> rows;
  rows.push_back(recovered("<i>E</i><sub>0</sub>", "Pa", truth.E0_Pa, estimates.E0_Pa,
                           systematic_u_of_E0(parts)));
  rows.push_back(recovered("<i>E</i><sub>∞</sub>", "Pa", series.equilibrium_modulus_Pa,
                           estimates.E_inf_Pa,
                           systematic_u_of_E_inf(parts, series_from_estimates(estimates))));
  const auto pairs = paired_terms(series.terms, estimates.terms);
  std::vector<bool> is_paired(estimates.terms.size(), false);
  const auto add_term = [&](std::size_t number, double g, double tau_s, const TermEstimate* term) {
    const auto at = static_cast<std::size_t>(term == nullptr ? 0 : term - estimates.terms.data());
    rows.push_back(recovered(fmt::format("<i>g</i><sub>{}</sub>", number), "", g,
                             term != nullptr ? term->g : none, systematic_u_of_g(parts, at)));
    rows.push_back(recovered(fmt::format("<i>τ</i><sub>{}</sub>", number), "s", tau_s,
                             term != nullptr ? term->tau_s : none, systematic_u_of_tau(parts, at)));
  };
  for (std::size_t i = 0; i < series.terms.size(); ++i) {
    if (pairs[i]) is_paired[*pairs[i]] = true;
    add_term(i + 1, series.terms[i].modulus_Pa / truth.E0_Pa, series.terms[i].relaxation_time_s,
             pairs[i] ? &estimates.terms[*pairs[i]] : nullptr);
  }
  std::size_t number = series.terms.size();
  for (std::size_t j = 0; j < estimates.terms.size(); ++j) {
    if (!is_paired[j]) add_term(++number, kNaN, kNaN, &estimates.terms[j]);
  }
  return rows;
}

}  // namespace viscard
