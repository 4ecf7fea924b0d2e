#pragma once

#include "fit/large_strain/fit_large_strain.h"

namespace viscard {

// Standard error of the nominal stress of a fitted law, Pa, from the covariance of its parameters.
double nominal_stress_se_Pa(const FittedRubber& fitted, Deformation deformation, double stretch);

}  // namespace viscard
