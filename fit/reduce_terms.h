#pragma once

#include "models/material/material.h"
#include "models/material/prony_series.h"

namespace viscard {

// The series of n_terms whose largest relative error |E'(t)/E(t) - 1| over t_min_s <= t <= t_max_s
// is smallest (a Chebyshev problem), with non-negative moduli and relaxation times within a factor
// of e^1.2 (about half a decade) of the window. The error is not limited outside the window, and
// the instantaneous modulus becomes about E(t_min). Method: least squares in the logarithms of
// moduli and times (Levenberg-Marquardt) from several starts, then iterative reweighting towards
// the maximum norm, then Remez exchange to equal peaks (Braess, Nonlinear Approximation Theory
// (1986), ch. VI: sums of exponentials).
struct ReducedSeries {
  PronySeries series;  // ascending relaxation times
  double largest_error = 0.0;
};
ReducedSeries reduce_terms(const PronySeries& series, int n_terms, double t_min_s, double t_max_s);

// The same for a material with constant Poisson ratio or constant bulk modulus, over its validity
// window; if that is unknown, from a tenth of the shortest to ten times the longest relaxation
// time. Bulk rule, density and provenance are kept; uncertainties of the old terms are dropped.
// Throws std::invalid_argument if n_terms is not positive or the material has bulk terms of its
// own.
struct ReducedMaterial {
  Material material;
  double largest_error = 0.0;  // of E(t) over the window
  double t_min_s = 0.0, t_max_s = 0.0;
};
ReducedMaterial reduce_material(const Material& material, int n_terms);

}  // namespace viscard
