#include "fit/large_strain/rubber_bounds.h"

#include "fit/large_strain/damage_search.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Eigen::Index;

// True if r ended at the end of its range: no softening, or more than the law has.
bool is_r_held(const FoundDamage& damage) {
  constexpr double kTouch = 1e-6;
  return damage.constants.r <= kLeastR * (1.0 + kTouch) ||
         damage.constants.r >= kMostR * (1.0 - kTouch);
}

// Names of the parameters that are held, and what holds them: "mu_3 at 0".
std::string held_parameters(HyperelasticForm form, const HyperelasticPoint& point,
                            const std::vector<Index>& free) {
  const std::vector<std::string> moduli = modulus_names(form), shapes = shape_names(form);
  const Index n = n_moduli(form);
  std::string text;
  for (Index j = 0; j < n + n_shapes(form); ++j) {
    if (std::find(free.begin(), free.end(), j) != free.end()) continue;
    const bool is_shape = j >= n;
    // The shape of a term without modulus means nothing.
    if (is_shape && point.moduli[std::min(j - n, n - 1)] == 0.0) continue;
    text += (text.empty() ? "" : ", ") + (is_shape ? shapes[static_cast<std::size_t>(j - n)] +
                                                         " at " + text_of(point.shapes[j - n], 4)
                                                   : moduli[static_cast<std::size_t>(j)] + " at 0");
  }
  if (point.damage && is_r_held(*point.damage)) {
    text += (text.empty() ? "r at " : ", r at ") + text_of(point.damage->constants.r, 4);
  }
  return text;
}

}  // namespace

std::vector<Index> free_parameters(HyperelasticForm form, const LargeStrainRows& rows,
                                   const HyperelasticPoint& point) {
  const ShapeBounds bounds = shape_bounds(form, rows);
  constexpr double kTouch = 1e-6;
  const Index n = n_moduli(form);
  std::vector<Index> free;
  for (Index j = 0; j < n; ++j) {
    if (is_sign_free(form) || point.moduli[j] > 0.0) free.push_back(j);
  }
  for (Index k = 0; k < n_shapes(form); ++k) {
    const double at = point.shapes[k];
    const bool is_inside = at > bounds.low + kTouch * std::abs(bounds.low) &&
                           at < bounds.high - kTouch * std::abs(bounds.high);
    if (is_inside && point.moduli[std::min(k, n - 1)] != 0.0) free.push_back(n + k);
  }
  const Index first = n + n_shapes(form), n_terms = static_cast<Index>(point.terms.size());
  for (Index i = 0; i < n_terms; ++i) {
    if (point.terms[static_cast<std::size_t>(i)].g > kTouch) free.push_back(first + i);
  }
  for (Index i = 0; i < n_terms; ++i) {
    if (point.terms[static_cast<std::size_t>(i)].g > kTouch) free.push_back(first + n_terms + i);
  }
  if (!point.damage) return free;
  if (!is_r_held(*point.damage)) free.push_back(first);
  if (point.damage->fits_m) free.push_back(first + 1);
  if (point.damage->fits_beta) free.push_back(first + 2);
  return free;
}

std::string bound_text(HyperelasticForm form, const LargeStrainRows& rows,
                       const HyperelasticPoint& point, const std::vector<Index>& free) {
  std::string text = held_parameters(form, point, free);
  const bool is_held = !is_sign_free(form) && (point.moduli.array() == 0.0).any();
  if (!is_held || !point.terms.empty() || point.damage) return text;
  const HyperelasticPoint any = best_point(form, rows, ModulusSigns::kAny);
  const double lower = 1.0 - any.rss / point.rss;
  constexpr double kVisible = 0.01;
  text += " (moduli are kept from negative values, which make a law unstable";
  if (lower > kVisible) {
    text +=
        "; with either sign the sum of squares would be " + text_of(100.0 * lower, 2) + " % lower";
  }
  return text + ")";
}

}  // namespace viscard
