#include "io/report/report_sections.h"

#include <algorithm>
#include <string>

namespace viscard {
namespace {

template <typename Predicate>
bool any_fit(const ReportInput& input, Predicate predicate) {
  return std::any_of(
      input.specimens.begin(), input.specimens.end(),
      [&](const SpecimenReport& specimen) { return specimen.fit && predicate(specimen); });
}

std::string loading_text(const ReportInput& input) {
  std::string text;
  if (any_fit(input, [](const SpecimenReport& s) { return s.run.has_value(); })) {
    text +=
        "Captured runs: a rigid punch was driven into the specimen, held, partly unloaded and held "
        "again. The force follows the recorded motion of the stage through the hereditary integral "
        "of specimen and frame in series, in closed form between the knots of the motion (Taylor, "
        "Pister and Goudreau, 1970), so the finite ramp is part of the model. Contact position, "
        "starts of the motions, zero and drift of the load cell are fitted with the material, and "
        "the intervals include their uncertainty. The compliance of the frame is subtracted. ";
  }
  const auto is_table = [](const SpecimenReport& s) { return !s.run.has_value(); };
  if (any_fit(input, is_table)) {
    text +=
        "Tables: step records are fitted directly, loading histories through the exact hereditary "
        "integral of the measured depth or strain (Taylor, Pister and Goudreau, 1970). ";
  }
  return text;
}

}  // namespace

void add_methods(Page& page, const ReportInput& input) {
  if (!any_fit(input, [](const SpecimenReport&) { return true; })) return;
  const bool is_punch = any_fit(input, [](const SpecimenReport& specimen) {
    return specimen.fit->kind == FitKind::kIndentation && !specimen.fit->is_stiffness;
  });
  const bool has_profiles = any_fit(
      input, [](const SpecimenReport& specimen) { return !specimen.fit->profiles.empty(); });
  page.add_heading(2, "methods", "Methods");
  std::string loading = loading_text(input);
  if (is_punch) {
    loading +=
        "The moduli include the correction factor of a punch on a bonded layer, computed from the "
        "integral equation of the contact.";
  }
  page.add_paragraph(loading);
  page.add_paragraph(
      "For every number of terms, the relaxation times are found by variable projection (Golub and "
      "Pereyra, 1973), which starts from a non-negative spectrum on a dense grid; no starting "
      "values are needed. The number of terms is the smallest whose cross-validated error is "
      "within one standard error of the best, but not larger than the Bayesian information "
      "criterion selects. A term longer than a third of the record needs strong evidence.");
  std::string intervals =
      "Intervals are 95 % intervals. They follow from the covariance of the parameters with "
      "autocorrelated noise (an autoregression of the residuals)";
  intervals += has_profiles
                   ? "; the intervals of the equilibrium modulus and, without a frame in series, "
                     "of the times come from profile likelihoods (Venzon and Moolgavkar, 1988). "
                   : ". ";
  if (is_punch) {
    intervals +=
        "If the record shows a drift of the load cell before contact, the intervals of the moduli "
        "include it. Errors of punch, layer and Poisson ratio scale all moduli of a specimen "
        "together; those of the frame, and of the calibration on a frame that yields, change "
        "<i>g</i> and <i>τ</i> as well. They are reported separately as the systematic part.";
  }
  page.add_paragraph(intervals);
  if (!input.law) return;
  page.add_paragraph(
      "The joint fit is a multivariate meta-regression of the specimens' parameters on the mixing "
      "ratio, with one variance between specimens for each kind of parameter (van Houwelingen, "
      "Arends and Stijnen, 2002). Repeated touches are first pooled to their specimen. The "
      "variances between touches, specimens and ratios are restricted maximum likelihood estimates "
      "of a nested "
      "random model (Patterson and Thompson, 1971), with intervals from its profile.");
}

}  // namespace viscard
