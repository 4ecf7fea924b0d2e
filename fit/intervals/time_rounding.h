#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/rounded_times.h"

#include <string>

namespace viscard {

// Widens the intervals of E0 and of the terms by what the unsure zero of rounded times changes, and names it
// in the flag times-rounded. All times may be late or early together (an instrument that cuts them off), so
// the zero of time is as uncertain, and E0 = sum E_i exp(t/tau_i) with it. If the times stand as they are,
// the flag is left out if the change is below a quarter of the interval.
void report_time_rounding(const TimeRounding& rounding, FitResult& result);

// The same for a load that rose from begin_s to end_s and counts as a step in the middle, which is t = 0
// of the fit (Zapas & Craft, J. Res. Natl. Bur. Stand. 69A (1965) 541, for times far above the rise):
// flag time-zero-chosen.
void report_rise(double begin_s, double end_s, FitResult& result);

// The same for a load ("stress", "strain", "depth") that changes at once between two rows, jump_s apart.
void report_jump(const std::string& load, double jump_s, FitResult& result);

// Widens the intervals of E0, of the moduli and shares of the terms for a zero of time that is uncertain
// by half_s: each modulus changes by exp(half_s/tau). Returns the change of E0 between both ends.
double widen_for_zero(double half_s, FitResult& result);

}  // namespace viscard
