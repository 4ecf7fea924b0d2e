#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"
#include "fit/intervals/uncertainty.h"

namespace viscard {

// Widens the intervals of E0, E_inf, the shares and the times for a term that is faster than all
// fitted ones and does not show. In a slow test such a term looks like a later start, another
// contact and another speed of the stage, so that no criterion chooses it, and yet E0 and all that
// is fitted with it depend on it. One more term is fitted at held times (8 a decade) from shortest_s
// to near the fastest fitted one. The intervals extend to those of each such fit, up to a rise of the
// sum of squares of 3.84 variances over the best: the profile likelihood over the hidden term
// (Venzon & Moolgavkar, Appl. Statist. 37 (1988) 87), each fit taken as quadratic. Nothing happens
// if that range spans less than a factor of 20 (terms of a series are about a decade apart, and the
// fitted one stands for its own), or if the order was requested.
// Adds the flag fast-term-hidden if the interval of E0 becomes wider by more than half.
//   shortest_s: of the times that E0 is to include; what is faster is no part of E0.
void carry_fast_doubt(const SpectralModel& model, const SpectralFit& fit,
                      const SeriesFromState& series_from_state, double shortest_s,
                      FitResult& result);

}  // namespace viscard
