#pragma once

#include "models/material/material.h"

namespace viscard {

// The two ends of a 95 % interval.
enum class IntervalEnd { kLower, kUpper };

// The material at an end of the 95 % interval of E0, systematic parts included: E0 has the value at
// that end, and all other parameters have their most likely values for this E0. With the covariance
// C of the parameters p (moduli, ln tau) and the gradient a of E0 by them,
//   dp = C a dE0 / (a^T C a)
// (conditional mean of a normal distribution, e.g. Anderson, An Introduction to Multivariate
// Statistical Analysis, 2003, theorem 2.5.1). C is the covariance of the fit, widened until its
// interval of E0 is the stated one, plus that of the systematic parts. Moduli that would become
// negative stay at zero. The result states no uncertainty. Throws std::invalid_argument if the
// material states no covariance that applies (has_band()) or no interval of E0, or if that end is
// not a positive modulus.
Material material_at_end(const Material& material, IntervalEnd end);

// The end of the interval of E0 alone, in Pa, systematic parts included.
double end_of_E0_Pa(const Material& material, IntervalEnd end);
// The same of E_inf, by its own interval.
double end_of_E_inf_Pa(const Material& material, IntervalEnd end);

}  // namespace viscard
