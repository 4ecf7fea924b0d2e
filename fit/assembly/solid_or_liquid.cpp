#include "fit/assembly/solid_or_liquid.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// Bayesian information criterion (Schwarz, Ann. Stat. 6 (1978) 461) with n_effective independent
// samples.
double bic_of(const FitEvidence& fit, double n_effective) {
  return n_effective * std::log(std::max(fit.rss, 1e-300) / fit.n_samples) +
         fit.n_parameters * std::log(n_effective);
}

struct Comparison {
  double liquid_minus_solid_bic = 0.0;
  // True if the preferred fit has fewer parameters and the others gain nothing significant: a flow
  // of almost zero can be added to the creep of any solid, and E_inf to the relaxation of a liquid.
  bool is_other_needless = false;
};

// The residual of the better fit is nearer to the noise, so its autocorrelation is used for both.
Comparison compared(const FitEvidence& liquid, const FitEvidence& solid) {
  constexpr double kSignificant = 3.84;  // 95 % of chi-square with one degree of freedom
  const FitEvidence& better = liquid.rss < solid.rss ? liquid : solid;
  const int most = std::max(liquid.n_parameters, solid.n_parameters);
  const double n_effective =
      std::max(std::min(better.n_samples, 5.0 * most), better.n_samples / better.inflation);
  const double bic = bic_of(liquid, n_effective) - bic_of(solid, n_effective);
  const double penalty = (liquid.n_parameters - solid.n_parameters) * std::log(n_effective);
  const double gain = std::abs(penalty - bic);  // of the log-likelihood, twice
  return {bic, bic * penalty > 0.0 && gain < kSignificant};
}

Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

void include_other(const FitResult& other, const std::string& text, FitResult& chosen) {
  chosen.E0_interval_95 = hull(chosen.E0_interval_95, other.E0_interval_95);
  chosen.E_inf_interval_95 = hull(chosen.E_inf_interval_95, other.E_inf_interval_95);
  chosen.flags.push_back({"solid-or-liquid", 0, text});
}

// A liquid fit exists unless its smallest order, one term, describes nothing.
std::optional<FitResult> liquid_fit(FitOptions options, const FitAs& fit_as) {
  options.is_liquid = true;
  try {
    return fit_as(options);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace

FitResult fit_solid_or_liquid(const FitOptions& options, const FitAs& fit_as) {
  FitResult solid = fit_as(options);
  const bool is_given = options.is_liquid || options.is_solid || options.allow_negative ||
                        !options.constraints.empty() || options.n_terms == 0;
  if (is_given || !solid.may_flow) return solid;
  std::optional<FitResult> liquid = liquid_fit(options, fit_as);
  if (!liquid) return solid;
  const Comparison comparison = compared(liquid->evidence, solid.evidence);
  const double difference = comparison.liquid_minus_solid_bic;
  FitResult chosen = difference < 0.0 ? *liquid : solid;
  const FitResult& other = difference < 0.0 ? solid : *liquid;
  chosen.bic_liquid_minus_solid = difference;
  constexpr double kStrong = 6.0;
  if (comparison.is_other_needless && difference > 0.0) return chosen;
  // The interval of the solid already includes the times that the record cannot resolve.
  if (comparison.is_other_needless) {
    chosen.E_inf_interval_95 = hull(chosen.E_inf_interval_95, solid.E_inf_interval_95);
  }
  if (std::abs(difference) < kStrong && !comparison.is_other_needless) {
    include_other(other,
                  "a solid and a liquid (E_inf = 0) describe the data about as well (BIC " +
                      text_of(std::abs(difference), 2) +
                      " apart): " + (difference < 0.0 ? "the liquid" : "the solid") +
                      " is shown, and the intervals of E0 and E_inf include both. A longer record "
                      "would decide it",
                  chosen);
  } else if (difference < 0.0) {
    chosen.flags.push_back({"liquid", 0,
                            "the data are described better without an equilibrium modulus (BIC " +
                                text_of(-difference, 3) +
                                " lower), so E_inf = 0. Use --solid to keep it"});
  }
  return chosen;
}

}  // namespace viscard
