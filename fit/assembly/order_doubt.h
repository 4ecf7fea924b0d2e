#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"

namespace viscard {

// Widens the intervals of E0 and E_inf for the uncertainty of the order. They then include the
// values, with their errors, of every order whose BIC is within 6 of the chosen one's (evidence
// less than "strong", Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773). If the slowest time is
// above a tenth of the record, the interval of E_inf extends down to the lowest value that the
// likelihood allows with one more term at the end of the range, because such a record cannot
// exclude that term. Adds the flag order-uncertain if other orders widen an interval by more than
// half.
void carry_order_doubt(const SpectralModel& model, const SpectralFit& fit,
                       const SeriesFromState& series_from_state, FitResult& result);

}  // namespace viscard
