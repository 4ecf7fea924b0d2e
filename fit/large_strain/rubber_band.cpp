#include "fit/large_strain/rubber_band.h"

#include <algorithm>
#include <cmath>

namespace viscard {

double nominal_stress_se_Pa(const FittedRubber& fitted, Deformation deformation, double stretch) {
  const HyperelasticLaw& law = fitted.law;
  const StressColumns unit = stress_columns(law.form, law.shapes, deformation, stretch);
  Eigen::VectorXd slope(fitted.covariance.rows());
  slope << unit.values, unit.shape_slopes.transpose() * law.moduli_Pa;
  return std::sqrt(std::max(0.0, slope.dot(fitted.covariance * slope)));
}

}  // namespace viscard
