#pragma once

#include "fit/intervals/fit_result.h"
#include "models/material/viscoelastic_models.h"

#include <optional>

namespace viscard {

class ResultVisitor;

// Compares the series (1 + 2N parameters) with a power law between two plateaus (four parameters),
// E(t) = E_inf + E_1 E_alpha(-(t/tau)^alpha), the fractional Zener model (Mainardi, Fractional
// Calculus and Waves in Linear Viscoelasticity (2010), ch. 3). Both are evaluated on the averages
// in FitResult::curves, whose noise is known from the fit:
//   BIC difference = (chi^2 - chi^2_series)/inflation + (4 - 1 - 2N) ln(n/inflation)
// It is negative if the fractional model is the better description.
struct FractionalDiagnosis {
  FractionalZenerModel model;      // moduli in the unit of the fitted column
  double chi_square = 0.0;         // of the fractional model
  double series_chi_square = 0.0;  // of the Prony series
  double bic_difference = 0.0;     // as above
};

// Shows all keys of it to a visitor.
void show_keys(ResultVisitor& v, const FractionalDiagnosis& fractional);

// Returns nothing for tests other than relaxation after a step, and for fewer than five averages.
std::optional<FractionalDiagnosis> diagnose_fractional(const FitResult& fit);

}  // namespace viscard
