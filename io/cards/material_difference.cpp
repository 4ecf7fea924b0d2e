#include "io/cards/material_difference.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

double largest_difference(const PronySeries& one, const PronySeries& reference,
                          const std::vector<double>& times_s) {
  double largest = 0.0;
  for (const double time_s : times_s) {
    const double expected_Pa = relaxation_modulus_Pa(reference, time_s);
    const double difference =
        std::abs(relaxation_modulus_Pa(one, time_s) - expected_Pa) / expected_Pa;
    if (!(difference <= largest)) largest = difference;  // NaN counts as the largest
  }
  return largest;
}

}  // namespace

std::vector<double> comparison_times_s(const Material& material, int count) {
  double from_s = material.valid.t_min_s, to_s = material.valid.t_max_s;
  if (!(to_s > 0.0)) {
    from_s = 1e-2;
    to_s = 1e2;
    for (std::size_t i = 0; i < material.terms.size(); ++i) {
      const double tau_s = material.terms[i].tau_s;
      from_s = i == 0 ? tau_s / 100.0 : std::min(from_s, tau_s / 100.0);
      to_s = i == 0 ? tau_s * 100.0 : std::max(to_s, tau_s * 100.0);
    }
  }
  if (!(from_s > 0.0)) from_s = to_s * 1e-6;
  std::vector<double> times_s;
  for (int i = 0; i < count; ++i) {
    times_s.push_back(from_s * std::pow(to_s / from_s, static_cast<double>(i) / (count - 1)));
  }
  return times_s;
}

double largest_E_difference(const Material& one, const Material& reference,
                            const std::vector<double>& times_s) {
  return largest_difference(young_series(one), young_series(reference), times_s);
}

double largest_G_difference(const Material& one, const Material& reference,
                            const std::vector<double>& times_s) {
  return largest_difference(shear_series(one), shear_series(reference), times_s);
}

}  // namespace viscard
