#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "fit/large_strain/large_strain_result.h"

#include <vector>

namespace viscard {

// Standard error of the nominal stress of a fitted law, Pa, from the covariance of its parameters.
double nominal_stress_se_Pa(const FittedRubber& fitted, Deformation deformation, double stretch);
// The nominal stress of a fitted law at each reading of a test, with its relaxation or damage, Pa.
std::vector<double> stresses_Pa(const FittedRubber& fitted, const LargeStrainTest& test);
// Its standard errors, from the covariance of parameters and terms; of the first loading, with damage.
std::vector<double> stress_errors_Pa(const FittedRubber& fitted, const LargeStrainTest& test);

}  // namespace viscard
