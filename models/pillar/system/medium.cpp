#include "models/pillar/system/medium.h"

#include "models/maths/dense.h"
#include "models/pillar/mesh/number_text.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

void require_density(double rho_kg_m3) {
  if (!(rho_kg_m3 >= 0.0) || !std::isfinite(rho_kg_m3)) {
    throw std::invalid_argument("density is " + number_text(rho_kg_m3) +
                                " kg/m3; it must not be negative");
  }
}

// Rotates Voigt stresses about z (Auld, Acoustic Fields and Waves in Solids (1973), ch. 3); strains
// rotate with the inverse transpose.
Matrix6d stress_rotation(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Matrix6d M = Matrix6d::Zero();
  M << c * c, s * s, 0, 0, 0, 2 * c * s, s * s, c * c, 0, 0, 0, -2 * c * s, 0, 0, 1, 0, 0, 0, 0, 0,
      0, c, -s, 0, 0, 0, 0, s, c, 0, -c * s, c * s, 0, 0, 0, c * c - s * s;
  return M;
}

}  // namespace

Medium isotropic_medium(double young_modulus_Pa, double poisson_ratio, double rho_kg_m3) {
  require_density(rho_kg_m3);
  Medium medium;
  medium.rho_kg_m3 = rho_kg_m3;
  medium.is_isotropic = true;
  medium.poisson_ratio = poisson_ratio;
  medium.shear_Pa = young_modulus_Pa / (2.0 * (1.0 + poisson_ratio));
  if (poisson_ratio == 0.5) {
    isotropic_moduli_Pa(young_modulus_Pa, 0.0);  // called to check the modulus
    medium.bulk_Pa = std::numeric_limits<double>::infinity();
    medium.stiffness_Pa = medium.shear_Pa * deviatoric_form();
  } else {
    medium.stiffness_Pa = isotropic_moduli_Pa(young_modulus_Pa, poisson_ratio);
    medium.bulk_Pa = young_modulus_Pa / (3.0 * (1.0 - 2.0 * poisson_ratio));
  }
  return medium;
}

Medium piezo_medium(const Matrix6d& stiffness_Pa, const PiezoMatrix& charge_C_N,
                    const Eigen::Matrix3d& permittivity_stress_F_m, double rho_kg_m3) {
  require_density(rho_kg_m3);
  Medium medium;
  medium.rho_kg_m3 = rho_kg_m3;
  medium.stiffness_Pa = stiffness_Pa;
  medium.piezo_C_m2 = charge_C_N * stiffness_Pa;
  medium.permittivity_F_m =
      permittivity_stress_F_m - charge_C_N * stiffness_Pa * charge_C_N.transpose();
  // Cholesky reads only one triangle, so check the symmetry separately.
  if (!stiffness_Pa.isApprox(stiffness_Pa.transpose(), 1e-9) ||
      !Cholesky(stiffness_Pa).is_definite()) {
    throw std::invalid_argument("the elastic constants are not symmetric and positive definite");
  }
  if (!Cholesky(medium.permittivity_F_m).is_definite()) {
    throw std::invalid_argument(
        "the piezoelectric constants are too large for the permittivity: no stable medium has "
        "them. "
        "Check the units of d (C/N) and the relative permittivity");
  }
  return medium;
}

Medium with_reversed_poling(Medium medium) {
  medium.piezo_C_m2 = -medium.piezo_C_m2;
  return medium;
}

Medium averaged_about_z(const Medium& medium) {
  Medium mean = medium;
  mean.stiffness_Pa.setZero();
  mean.piezo_C_m2.setZero();
  mean.permittivity_F_m.setZero();
  constexpr int kAngles = 8;  // fourth-order harmonics and lower cancel exactly
  for (int i = 0; i < kAngles; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kAngles;
    const Matrix6d M = stress_rotation(angle);
    Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
    a.topLeftCorner<2, 2>() << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    mean.stiffness_Pa += M * medium.stiffness_Pa * M.transpose() / kAngles;
    mean.piezo_C_m2 += a * medium.piezo_C_m2 * M.transpose() / kAngles;
    mean.permittivity_F_m += a * medium.permittivity_F_m * a.transpose() / kAngles;
  }
  return mean;
}

Eigen::MatrixXd coupled_form(const Medium& medium) {
  Eigen::MatrixXd form(9, 9);
  form << medium.stiffness_Pa, -medium.piezo_C_m2.transpose(), -medium.piezo_C_m2,
      -medium.permittivity_F_m;
  return form;
}

}  // namespace viscard
