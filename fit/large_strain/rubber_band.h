#pragma once

#include "fit/large_strain/large_strain_result.h"

namespace viscard {

// Standard error of the nominal stress of a fitted law, Pa, from the covariance of its parameters.
double nominal_stress_se_Pa(const FittedRubber& fitted, Deformation deformation, double stretch);

}  // namespace viscard
