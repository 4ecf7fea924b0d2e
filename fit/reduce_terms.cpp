#include "fit/reduce_terms.h"

#include "fit/chebyshev_series.h"
#include "models/material/liquid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// Evaluates the error on a grid four times as fine as the one used for the reduction.
double largest_error(const PronySeries& one, const PronySeries& reference, double t_min_s,
                     double t_max_s) {
  const int count = std::max(800, static_cast<int>(160.0 * std::log10(t_max_s / t_min_s)));
  double error = 0.0;
  for (int i = 0; i < count; ++i) {
    const double t_s = t_min_s * std::pow(t_max_s / t_min_s, static_cast<double>(i) / (count - 1));
    error = std::max(
        error,
        std::abs(relaxation_modulus_Pa(one, t_s) / relaxation_modulus_Pa(reference, t_s) - 1.0));
  }
  return error;
}

}  // namespace

ReducedSeries reduce_terms(const PronySeries& series, int n_terms, double t_min_s, double t_max_s) {
  validate(series);
  if (n_terms < 1) {
    throw std::invalid_argument("a series can be reduced to one term or more, not to " +
                                std::to_string(n_terms));
  }
  if (!(t_min_s > 0.0) || !(t_max_s > t_min_s)) {
    throw std::invalid_argument("the window of a reduction must be 0 < t_min < t_max");
  }
  if (static_cast<int>(series.terms.size()) <= n_terms) return {series, 0.0};
  ReducedSeries reduced{chebyshev_series(series, n_terms, t_min_s, t_max_s), 0.0};
  reduced.largest_error = largest_error(reduced.series, series, t_min_s, t_max_s);
  return reduced;
}

ReducedMaterial reduce_material(const Material& material, int n_terms) {
  validate_solid(material);
  const bool is_constant_poisson = has_constant_poisson_ratio(material) || material.nu == 0.5;
  ReducedMaterial out{material, 0.0, material.valid.t_min_s, material.valid.t_max_s};
  double fastest_s = std::numeric_limits<double>::infinity(), slowest_s = 0.0;
  for (const MaterialTerm& term : material.terms) {
    if (!is_constant_poisson && term.k != 0.0) {
      throw std::invalid_argument(
          "terms can be reduced if the bulk modulus is constant (k = 0) or relaxes like the shear "
          "modulus (k = g); this material has bulk terms of their own");
    }
    fastest_s = std::min(fastest_s, term.tau_s);
    slowest_s = std::max(slowest_s, term.tau_s);
  }
  if (static_cast<int>(material.terms.size()) <= n_terms) return out;
  if (!(out.t_max_s > 0.0)) out.t_max_s = 10.0 * slowest_s;
  if (!(out.t_min_s > 0.0)) out.t_min_s = std::min(0.1 * fastest_s, 0.01 * out.t_max_s);

  const PronySeries shear = shear_series(material);
  const PronySeries reduced = reduce_terms(shear, n_terms, out.t_min_s, out.t_max_s).series;
  const double G0_Pa = instantaneous_modulus_Pa(reduced);
  const double ratio = G0_Pa / instantaneous_modulus_Pa(shear);
  if (is_constant_poisson) {
    out.material.E0_Pa *= ratio;
  } else {
    const double K0_Pa = derived_moduli(material).K0_Pa;
    out.material.E0_Pa = 9.0 * K0_Pa * G0_Pa / (3.0 * K0_Pa + G0_Pa);
    out.material.nu = (3.0 * K0_Pa - 2.0 * G0_Pa) / (2.0 * (3.0 * K0_Pa + G0_Pa));
  }
  out.material.terms.clear();
  for (const MaxwellTerm& term : reduced.terms) {
    const double g = term.modulus_Pa / G0_Pa;
    out.material.terms.push_back({g, is_constant_poisson ? g : 0.0, term.relaxation_time_s});
  }
  out.material.uncertainty.reset();
  std::erase_if(out.material.flags, [](const MaterialFlag& flag) { return flag.term > 0; });
  out.largest_error =
      largest_error(young_series(out.material), young_series(material), out.t_min_s, out.t_max_s);
  return out;
}

}  // namespace viscard
