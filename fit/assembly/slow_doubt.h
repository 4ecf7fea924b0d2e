#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"

namespace viscard {

// The lowest E_inf at which the sum of squares rises by at most 3.84 variances over least_rss, with
// all else refitted (profile likelihood, Venzon & Moolgavkar, Appl. Statist. 37 (1988) 87). 0 if
// nothing excludes it. start: a fit within that region, whose last term is slower than all that the
// data determine and replaces part of E_inf.
struct EquilibriumProfile {
  double least_rss = 0.0;
  double variance = 1.0;    // of one weighted sample
  double step = 0.0;        // first change of E_inf; the steps double
  bool holds_time = false;  // of the last term
};
double lowest_equilibrium(const SpectralModel& model, const SpectralState& start,
                          const EquilibriumProfile& profile);

// Widens the interval of E_inf of an oscillation for relaxation slower than the lowest frequency. A
// term of E and tau adds the plateau E to the storage modulus, as E_inf does, and E/(w tau) to the
// loss modulus. So E_inf is known only as well as the loss modulus at the lowest frequencies.
//
// Two cases, for a fit with E_inf whose order was not requested:
// - Such a loss is within the noise: E_inf may be as low as a term two decades below the lowest
//   frequency allows (95 %). E_inf is thus the modulus at a hundredth of the lowest frequency; what
//   relaxes later, no sweep can exclude. Flag slow-term-hidden if the interval becomes wider by half
//   and by 5 % of E_inf.
// - Such a loss is there (99 %) and no term explains it: its time is unknown, so that E_inf may be
//   anything down to 0. Flag slower-relaxation.
//   lowest_angular_1_s: lowest (reduced) angular frequency
void carry_slow_doubt(const SpectralModel& model, const SpectralFit& fit, double lowest_angular_1_s,
                      FitResult& result);

}  // namespace viscard
