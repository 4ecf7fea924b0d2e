#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Ends of intervals of quantities that no material has negative (moduli, shares) are not below zero, unless
// the options allow negative terms. Call it last: an interval that reaches zero is judged before.
void keep_intervals_positive(const FitOptions& options, FitResult& result);

}  // namespace viscard
