#include "models/pillar/system/elastic_moduli.h"

#include "models/pillar/mesh/number_text.h"

#include <Eigen/LU>

#include <stdexcept>
#include <string>

namespace viscard {

Matrix6d deviatoric_form() {
  Matrix6d form = Matrix6d::Zero();
  form.topLeftCorner<3, 3>().setConstant(-2.0 / 3.0);
  form.diagonal() << 4.0 / 3.0, 4.0 / 3.0, 4.0 / 3.0, 1.0, 1.0, 1.0;
  return form;
}

Matrix6d volumetric_form() {
  Matrix6d form = Matrix6d::Zero();
  form.topLeftCorner<3, 3>().setOnes();
  return form;
}

Matrix6d inverse(const Matrix6d& matrix) {
  return matrix.inverse();
}

Matrix6d isotropic_moduli_Pa(double young_modulus_Pa, double poisson_ratio) {
  if (!(young_modulus_Pa > 0.0)) {
    throw std::invalid_argument("Young's modulus is " + number_text(young_modulus_Pa) +
                                " Pa; it must be positive");
  }
  if (!(poisson_ratio > -1.0 && poisson_ratio < 0.5)) {
    throw std::invalid_argument("Poisson ratio is " + number_text(poisson_ratio) +
                                "; it must lie between -1 and 0.5 here");
  }
  return young_modulus_Pa / (2.0 * (1.0 + poisson_ratio)) * deviatoric_form() +
         young_modulus_Pa / (3.0 * (1.0 - 2.0 * poisson_ratio)) * volumetric_form();
}

Eigen::MatrixXd plane_stress_moduli(const Eigen::MatrixXd& moduli) {
  constexpr Eigen::Index kThick = 1;  // yy
  if (!(moduli(kThick, kThick) > 0.0)) {
    throw std::invalid_argument("plane stress needs a positive modulus across the plane");
  }
  return moduli - moduli.col(kThick) * moduli.row(kThick) / moduli(kThick, kThick);
}

}  // namespace viscard
