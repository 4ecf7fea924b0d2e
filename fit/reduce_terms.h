#pragma once

#include "models/material/material.h"
#include "models/material/prony_series.h"

namespace viscard {

// The series of n_terms with the smallest largest relative error over t_min_s <= t <= t_max_s
// (fit/chebyshev_series.h). The error is not limited outside the window, and E0 becomes about
// E(t_min). Throws std::invalid_argument for an invalid series or window, or n_terms < 1.
struct ReducedSeries {
  PronySeries series;  // ascending relaxation times
  double largest_error = 0.0;
};
ReducedSeries reduce_terms(const PronySeries& series, int n_terms, double t_min_s, double t_max_s);

// The same for a material with constant Poisson ratio or constant bulk modulus, over its validity
// window; if that is unknown, from a tenth of the shortest to ten times the longest relaxation
// time. Bulk rule, density and provenance are kept; uncertainties of the old terms are dropped.
// Throws std::invalid_argument if n_terms < 1 or the material has bulk terms of its own.
struct ReducedMaterial {
  Material material;
  double largest_error = 0.0;  // of E(t) over the window
  double t_min_s = 0.0, t_max_s = 0.0;
};
ReducedMaterial reduce_material(const Material& material, int n_terms);

}  // namespace viscard
