#include "models/ratio_model.h"
#include "models/text_of_number.h"

#include <cmath>
#include <string>

namespace viscard {
namespace {

// Four digits: what a law of a few specimens is worth.
std::string short_text(double value) {
  return text_of(value, 4);
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
  const ScaledVariable scaled = scale_of(law);
  std::string text;
  if (law.form.E0_degree == 1) {
    const double slope = law.coefficients[1] / scaled.half;
    const double slope_se = std::sqrt(law.covariance(1, 1)) / std::abs(scaled.half);
    const double at_zero = law.coefficients[0] - slope * scaled.middle;
    if (law.form.variable == RatioVariable::kLogRatio) {
      text = "E0 = " + short_text(std::exp(at_zero) * 1e-6) + " MPa x ratio^" + short_text(slope) +
             " (exponent +- " + short_text(slope_se) + ")";
    } else {
      const bool is_share = law.form.variable == RatioVariable::kCrosslinkerShare;
      text = "E0 = " + short_text(std::exp(at_zero) * 1e-6) + " MPa x exp(" + short_text(slope) +
             (is_share ? "/(1 + ratio))" : " ratio)") + " (coefficient +- " + short_text(slope_se) +
             ")";
    }
  } else {
    text = form_in_words(law.form);
  }
  text += has_known_spread(law, 0)
              ? "; between specimens E0 scatters by " + short_text(100.0 * law.spread_ln_E0) + " %"
              : "; scatter of E0 between specimens unknown";
  return text + " (" + std::to_string(law.n_specimens) + " specimens, " +
         std::to_string(law.ratios.size()) + " ratios)";
}

}  // namespace viscard
