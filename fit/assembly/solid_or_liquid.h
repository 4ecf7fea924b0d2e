#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

#include <functional>

namespace viscard {

using FitAs = std::function<FitResult(const FitOptions&)>;

// The fit as a solid. If the data do not exclude E_inf = 0 (FitResult::may_flow), the fit as a
// liquid too, and the one with the lower BIC. A choice that nobody asked for is reported by the flag
// "liquid". If the two BIC differ by less than 6 (evidence less than "strong", Kass & Raftery, J.
// Am. Stat. Assoc. 90 (1995) 773), the intervals of E0 and E_inf include both fits, and the flag is
// "solid-or-liquid". The options is_liquid and is_solid, constraints and terms of either sign leave
// nothing to choose.
FitResult fit_solid_or_liquid(const FitOptions& options, const FitAs& fit_as);

}  // namespace viscard
