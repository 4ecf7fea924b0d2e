#include "models/material/ratio_model.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace viscard {
namespace {

// Digits of a standard error or of the scatter of a few specimens; no more are known.
constexpr int kRough = 2;

// ln E0 = at_zero + slope v with the variable v of the form.
struct StraightLaw {
  double at_zero = 0.0, at_zero_se = 0.0;
  double slope = 0.0, slope_se = 0.0;
};

StraightLaw straight_law(const RatioModel& law) {
  const ScaledVariable scaled = scale_of(law);
  const double back = -scaled.middle / scaled.half;
  const double variance =
      law.covariance(0, 0) + 2.0 * back * law.covariance(0, 1) + back * back * law.covariance(1, 1);
  return {law.coefficients[0] + back * law.coefficients[1], std::sqrt(std::max(0.0, variance)),
          law.coefficients[1] / scaled.half,
          std::sqrt(law.covariance(1, 1)) / std::abs(scaled.half)};
}

const char* variable_name(RatioVariable variable) {
  switch (variable) {
    case RatioVariable::kLogRatio:
      return "ln(ratio)";
    case RatioVariable::kRatio:
      return "the ratio";
    case RatioVariable::kCrosslinkerShare:
      return "the cross-linker share 1/(1 + ratio)";
  }
  return "";
}

std::string degree_in_words(const std::string& what, int degree, const char* variable) {
  if (degree == kPerRatio) return what + " free at each ratio";
  if (degree == 0) return what + " the same at all ratios";
  return what + (degree == 1 ? " linear in " : " quadratic in ") + variable;
}

}  // namespace

std::string form_name(const RatioForm& form) {
  if (is_law(form)) return "law";
  if (form.E0_degree == kPerRatio && form.g_degree == kPerRatio) {
    if (form.tau_degree == kPerRatio) return "independent";
    if (form.tau_degree == 0) return "shared-times";
  }
  if (form.E0_degree == kPerRatio && form.g_degree == 0 && form.tau_degree == 0) {
    return "shared-spectrum";
  }
  return "mixed";
}

std::string form_in_words(const RatioForm& form) {
  const char* variable = variable_name(form.variable);
  std::string same;
  for (const std::string& name : form.same) same += "; " + name + " the same at all ratios";
  return degree_in_words("ln E0", form.E0_degree, variable) + "; " +
         degree_in_words("ln g", form.g_degree, variable) + "; " +
         degree_in_words("ln tau", form.tau_degree, variable) + same;
}

std::string law_in_words(const RatioFit& fit) {
  const RatioModel& law = fit.law;
  std::string text;
  if (law.form.E0_degree == 1) {
    const StraightLaw line = straight_law(law);
    const double factor_MPa = std::exp(line.at_zero) * 1e-6;
    const std::string slope = text_with_error(line.slope, line.slope_se);
    text = "E0 = " + text_with_error(factor_MPa, factor_MPa * line.at_zero_se) + " MPa x ";
    switch (law.form.variable) {
      case RatioVariable::kLogRatio:
        text += "ratio^" + slope + " (exponent +- ";
        break;
      case RatioVariable::kRatio:
        text += "exp(" + slope + " ratio) (coefficient +- ";
        break;
      case RatioVariable::kCrosslinkerShare:
        text += "exp(" + slope + "/(1 + ratio)) (coefficient +- ";
        break;
    }
    text += text_of(line.slope_se, kRough) + ")";
  } else {
    text = form_in_words(law.form);
  }
  text += has_known_spread(law, 0) ? "; between specimens E0 scatters by " +
                                         text_of(100.0 * law.spread_ln_E0, kRough) + " %"
                                   : "; scatter of E0 between specimens unknown";
  return text + " (" + counted(static_cast<std::size_t>(law.n_specimens), "specimen") + ", " +
         counted(law.ratios.size(), "ratio") + ")";
}

}  // namespace viscard
