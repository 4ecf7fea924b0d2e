#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "fit/large_strain/large_strain_result.h"

#include <vector>

namespace viscard {

// Fits the laws to all tests together and chooses by BIC among those that converge, are stable in the
// measured range and do not end on a bound (all of them, if none is left). Intervals are from the
// covariance at the best point, with the scatter of the residuals and its memory. Tests with times give
// terms of relaxation beside each law too (models/hyperelastic/finite_viscoelasticity.h), their number by
// BIC; flags of terms: rubber_term_checks.h, of damage: damage_checks.h. Flags of a law:
// unstable-in-range, misfit, on-bound (a shape ended at the end of its range), not-converged, undetermined;
// notes: unstable-beyond, one-deformation, few-readings, modulus-disagrees. The first five make the
// law untrustworthy.
// Throws std::runtime_error for a test with fewer than 3 readings, a stretch that is not positive, a
// number that is not finite, all stretches 1, or compression with a positive stress throughout.
LargeStrainResult fit_large_strain(const std::vector<LargeStrainTest>& tests,
                                   const LargeStrainOptions& options = {});

}  // namespace viscard
