#pragma once

#include <Eigen/Core>

namespace viscard {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Voigt order xx yy zz yz xz xy with engineering shears throughout (eq. 15).
// An isotropic solid is G * deviatoric_form() + K * volumetric_form().
Matrix6d deviatoric_form();
Matrix6d volumetric_form();
// Pa. Throws std::invalid_argument unless E > 0 and -1 < nu < 0.5.
Matrix6d isotropic_moduli_Pa(double young_modulus_Pa, double poisson_ratio);

// Moduli with sigma_yy = 0 condensed out: the yy row and column become zero. Works for any linear
// medium; with piezoelectric rows appended (9 x 9) those are condensed alike.
Eigen::MatrixXd plane_stress_moduli(const Eigen::MatrixXd& moduli);

}  // namespace viscard
