#pragma once

#include "models/material/prony_series.h"

namespace viscard {

// The series of n_terms whose largest relative error |E'(t)/E(t) - 1| over t_min_s <= t <= t_max_s
// is smallest (a Chebyshev problem), with non-negative moduli and relaxation times within a factor
// of e^1.2 (about half a decade) of the window. Terms ascend in time. Method: least squares in the
// logarithms of moduli and times (Levenberg-Marquardt) from several starts, then iterative
// reweighting towards the maximum norm, then Remez exchange to equal peaks (Braess, Nonlinear
// Approximation Theory (1986), ch. VI: sums of exponentials). Deterministic; the arguments must be
// valid (reduce_terms() checks them).
PronySeries chebyshev_series(const PronySeries& series, int n_terms, double t_min_s,
                             double t_max_s);

}  // namespace viscard
