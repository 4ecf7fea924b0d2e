#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"

#include <optional>

namespace viscard {

// The continuous relaxation spectrum H of a fitted test,
//   E(t) = E_inf + integral of H(tau) exp(-t/tau) d ln tau      (Ferry, Viscoelastic Properties of Polymers, ch. 3)
// with what the data leave open. Nothing where the parameters of the model are not those of the material (creep, a frame
// in series, moduli of either sign).
//
// The family is ALL non-negative spectra on a dense grid of the times that the record can show (12 a decade) and the times
// of the fitted series, with E_inf, offsets and first-order changes of nuisances, whose sum of squares stays within 3.84
// variances of that of the series. (The best of so free a family fits the noise, too: measured from it, the bounds would
// be too narrow.) Its members that make a value c.x smallest and largest bound it: the value of a linear functional of a convex set (Backus & Gilbert,
// Geophys. J. R. Astron. Soc. 16 (1968) 169; Stark, J. Geophys. Res. 97 (1992) 14055). The best member at each value of
// c.x is one least-squares problem over x >= 0 (nnls.h).
// - H itself is its smoothest member (least sum of squared second differences: Constable, Parker & Constable, Geophysics
//   52 (1987) 289).
// - The band of a row bounds the mean of H over half a decade around it: of a narrower mean no record says anything.
// - E0 (the sum of all) and E_inf are bounded likewise: no order is chosen. Relaxation outside the grid is not in them.
std::optional<ContinuousSpectrum> continuous_spectrum(const SpectralModel& model,
                                                      const SpectralFit& fit);

}  // namespace viscard
