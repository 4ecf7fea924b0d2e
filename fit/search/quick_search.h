#pragma once

#include "fit/search/separable.h"

namespace viscard {

// Fast replacement for refine() in the many fits of an order path: Levenberg-Marquardt within the
// bounds of the parameters on normal equations (projection.h), with the damping of Nielsen,
// IMM-REP-1999-05, Techn. Univ. Denmark. A problem of two terms takes some tens of microseconds;
// setting up Ceres alone takes longer. refine() and polish() compute the last digits.
SpectralState quick_search(const SpectralModel& model, const SpectralState& start,
                           const RefineOptions& options);

}  // namespace viscard
