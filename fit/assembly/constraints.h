#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/samples/fit_data.h"

#include <string>
#include <vector>

namespace viscard {

// "tau_1=0.2" fixes a parameter, "g_2=0:0.1" bounds it. Names: E_inf and E_i, or E0 and g_i (not
// both kinds), and tau_i, in SI units. Terms are numbered as in the result, from 1 for the shortest
// time. Throws std::invalid_argument that quotes the text.
ParameterConstraint constraint_from_text(const std::string& text);

// Throws std::invalid_argument for an unknown name, a parameter named twice, a term beyond n_terms,
// a lower bound above the upper one, moduli together with shares, or values that no material can
// have: E0 <= 0, shares that sum to one or more, negative moduli unless they are allowed.
void validate(const std::vector<ParameterConstraint>& constraints, int n_terms,
              bool may_be_negative = false);

// Replaces the state of the fit by the best one that satisfies the constraints: least squares in
// all parameters within bounds (trust region of Ceres), started from the free optimum and from the
// fixed times. The covariance is that of the free parameters; a parameter that ends on a bound
// counts as fixed. Nuisances and the common columns other than the first (E_inf) stay free. Throws
// std::invalid_argument if the constraints leave no possible material: E_inf < 0, terms out of
// order, a time that the record cannot show. Adds the note constraints-strained if the constraints
// fit the data visibly worse than the free fit does, or contradicts-data if that makes the result
// untrustworthy.
void constrain(const SpectralModel& model, const FitOptions& options, SpectralFit& fit);

}  // namespace viscard
