#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/samples/fit_data.h"

#include <string>
#include <vector>

namespace viscard {

// "tau_1=0.2" fixes, "g_2=0:0.1" bounds. Names: E_inf, E_i, or E0, g_i (not both kinds), and tau_i,
// in SI; terms are counted as in the result, from 1 at the shortest time. Throws
// std::invalid_argument naming the text.
ParameterConstraint constraint_from_text(const std::string& text);

// Throws std::invalid_argument: an unknown name, one named twice, a term beyond n_terms, bounds the
// wrong way round, moduli and shares both, or what no material can have: E0 <= 0, shares that sum
// to one or more, negative moduli unless they may be.
void validate(const std::vector<ParameterConstraint>& constraints, int n_terms,
              bool may_be_negative = false);

// Replaces the fit's state by the best one that keeps the constraints: least squares in all
// parameters within bounds (trust region of Ceres) from the free optimum and from one that starts
// at the fixed times. Its covariance is that of the parameters left free; parameters that end on a
// bound count as fixed there. Common columns but the first (E_inf) and nuisances stay free.
// Throws std::invalid_argument where they leave no material: E_inf < 0, terms out of their order, a
// time that the record cannot show. Notes constraints that describe the data visibly worse than the
// free fit does: constraints-strained, or contradicts-data where that makes the result
// untrustworthy.
void constrain(const SpectralModel& model, const FitOptions& options, SpectralFit& fit);

}  // namespace viscard
