#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"
#include "fit/intervals/uncertainty.h"

namespace viscard {

// Widens the intervals of E0, E_inf, the shares and the times for a term that is faster than all
// fitted ones and does not show. In a slow test such a term looks like a later start, another
// contact and another speed of the stage, so that no criterion chooses it, and yet E0 and all that is
// fitted with it depend on it.
//
// One more term is fitted at held times (8 a decade) from shortest_s to a quarter of the fastest fitted
// time; what is nearer, the fitted term stands for. (A hidden term shortens the fitted time: up to a
// sixth only, a term at a sixth of the true time was beyond the region; see fit/intervals/README.md.) Its
// modulus then takes values within the region where the sum of squares rises by less than 3.84 variances
// over the best of these fits, and all else its best values and region there: the profile likelihood over
// the hidden term (Venzon & Moolgavkar, Appl. Statist. 37 (1988) 87), each fit taken as quadratic, moduli
// not negative. Nothing happens if the order was requested.
//
// Adds the flag fast-term-hidden if the interval of E0 becomes wider by more than half and by more
// than 1.5 % of E0.
//   shortest_s: of the times that E0 is to include; what is faster is no part of E0.
void carry_fast_doubt(const SpectralModel& model, const SpectralFit& fit,
                      const SeriesFromState& series_from_state, double shortest_s,
                      FitResult& result);

}  // namespace viscard
