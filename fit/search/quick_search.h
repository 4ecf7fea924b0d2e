#pragma once

#include "fit/search/separable.h"

namespace viscard {

// refine() for the many fits of an order path: Levenberg-Marquardt in the box of the parameters on
// normal equations (projection.h), with the damping of Nielsen, IMM-REP-1999-05, Techn. Univ.
// Denmark. A problem of two terms takes it some tens of microseconds, of which setting up Ceres
// alone would take more. The last digits are left to refine() and polish().
SpectralState quick_search(const SpectralModel& model, const SpectralState& start,
                           const RefineOptions& options);

}  // namespace viscard
