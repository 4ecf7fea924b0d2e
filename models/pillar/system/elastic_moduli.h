#pragma once

#include <Eigen/Core>

namespace viscard {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Voigt order xx yy zz yz xz xy with engineering shears throughout (eq. 15).
// An isotropic solid is G * deviatoric_form() + K * volumetric_form().
Matrix6d deviatoric_form();
Matrix6d volumetric_form();
Matrix6d inverse(const Matrix6d& matrix);
// Pa. Throws std::invalid_argument unless E > 0 and -1 < nu < 0.5.
Matrix6d isotropic_moduli_Pa(double young_modulus_Pa, double poisson_ratio);

// Condenses sigma_yy = 0 out of the moduli: the yy row and column become zero. Works for any linear
// medium; in a 9 x 9 matrix with piezoelectric rows appended, those rows are condensed as well.
Eigen::MatrixXd plane_stress_moduli(const Eigen::MatrixXd& moduli);

}  // namespace viscard
