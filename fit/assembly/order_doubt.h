#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"

namespace viscard {

// Widens the intervals of E0 and E_inf by the doubt about the order. They come to hold the values,
// with their errors, of every order whose BIC is within 6 of the chosen one's (less than "strong",
// Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773); and when the slowest time is above a tenth of
// the record, E_inf reaches down as far as the likelihood lets it with one more term at the end of
// the range, which such a record cannot exclude. Adds the flag order-uncertain where other orders
// widen an interval by more than half.
void carry_order_doubt(const SpectralModel& model, const SpectralFit& fit,
                       const SeriesFromState& series_from_state, FitResult& result);

}  // namespace viscard
