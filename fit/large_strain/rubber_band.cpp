#include "fit/large_strain/rubber_band.h"

#include "fit/large_strain/series_refine.h"

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

std::vector<double> stresses_Pa(const FittedRubber& fitted, const LargeStrainTest& test) {
  std::vector<double> stress_Pa;
  if (fitted.foam) {
    for (const double measured : test.stretch) {
      stress_Pa.push_back(foam_state(fitted.foam->law, test.foam_test, measured).nominal_stress_Pa);
    }
    return stress_Pa;
  }
  if (fitted.damage) {
    return nominal_stress_Pa(fitted.law, fitted.damage->constants, test.deformation, test.stretch);
  }
  if (fitted.terms.empty()) {
    for (const double stretch : test.stretch) {
      stress_Pa.push_back(nominal_stress_Pa(fitted.law, test.deformation, stretch));
    }
    return stress_Pa;
  }
  const StretchCourse course(test.deformation, history_of(test));
  const auto stress = course.unit_stress(fitted.law.form, fitted.law.shapes, false)
                          .values.times(fitted.law.moduli_Pa);
  const Eigen::MatrixXd at_once = course.instantaneous(stress);
  Eigen::VectorXd sum = at_once.col(0);
  for (const RubberTerm& term : relaxation_of(fitted)) {
    sum += term.g * (course.relaxed(stress, term.tau_s, false).values - at_once).col(0);
  }
  const auto first = static_cast<std::ptrdiff_t>(test.before.size());
  return {sum.begin() + first, sum.end()};
}

std::vector<double> stress_errors_Pa(const FittedRubber& fitted, const LargeStrainTest& test) {
  std::vector<double> errors_Pa;
  if (fitted.terms.empty()) {
    for (const double stretch : test.stretch) {
      errors_Pa.push_back(nominal_stress_se_Pa(fitted, test.deformation, stretch));
    }
    return errors_Pa;
  }
  const LargeStrainRows rows({test}, {});
  HyperelasticPoint point;
  point.moduli = fitted.law.moduli_Pa / rows.stress_scale_Pa();
  point.shapes = fitted.law.shapes;
  point.terms = relaxation_of(fitted);
  Eigen::MatrixXd slopes = rows.stress_scale_Pa() * series_jacobian(fitted.law.form, rows, point);
  slopes.leftCols(point.moduli.size()) /= rows.stress_scale_Pa();  // by moduli in Pa
  for (Eigen::Index i = 0; i < slopes.rows(); ++i) {
    const Eigen::VectorXd slope = slopes.row(i).transpose();
    errors_Pa.push_back(std::sqrt(std::max(0.0, slope.dot(fitted.series_covariance * slope))));
  }
  return errors_Pa;
}

}  // namespace viscard
