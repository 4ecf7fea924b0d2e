#pragma once

#include "fit/large_strain/large_strain_result.h"

namespace viscard {

// Fills the parameters, the modulus at rest at once and after all relaxation, and the terms' intervals,
// from the law, its terms and their covariance.
void add_intervals(FittedRubber& fitted);

}  // namespace viscard
