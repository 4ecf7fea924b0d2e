#include "models/pillar/system/medium.h"

#include "models/maths/dense.h"
#include "models/maths/require.h"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <stdexcept>

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
  require_positive("Young's modulus", young_modulus_Pa, "Pa");
  require_value(poisson_ratio > -1.0 && poisson_ratio < 0.5, "Poisson ratio", poisson_ratio, "",
                "between -1 and 0.5 here");
  return young_modulus_Pa / (2.0 * (1.0 + poisson_ratio)) * deviatoric_form() +
         young_modulus_Pa / (3.0 * (1.0 - 2.0 * poisson_ratio)) * volumetric_form();
}

Eigen::MatrixXd plane_stress_moduli(const Eigen::MatrixXd& moduli) {
  constexpr Eigen::Index kThick = 1;  // yy
  require(moduli(kThick, kThick) > 0.0, "plane stress needs a positive modulus across the plane");
  return moduli - moduli.col(kThick) * moduli.row(kThick) / moduli(kThick, kThick);
}

Medium isotropic_medium(double young_modulus_Pa, double poisson_ratio, double rho_kg_m3) {
  require_not_negative("density", rho_kg_m3, "kg/m3");
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

Medium elastic_medium(const Matrix6d& stiffness_Pa, double rho_kg_m3) {
  require_not_negative("density", rho_kg_m3, "kg/m3");
  // Cholesky reads only one triangle, so check the symmetry separately.
  require(stiffness_Pa.allFinite() && stiffness_Pa.isApprox(stiffness_Pa.transpose(), 1e-9) &&
              Cholesky(stiffness_Pa).is_definite(),
          "the elastic constants are not symmetric and positive definite");
  Medium medium;
  medium.rho_kg_m3 = rho_kg_m3;
  medium.stiffness_Pa = stiffness_Pa;
  return medium;
}

Medium piezo_medium(const Matrix6d& stiffness_Pa, const PiezoMatrix& charge_C_N,
                    const Eigen::Matrix3d& permittivity_stress_F_m, double rho_kg_m3) {
  Medium medium = elastic_medium(stiffness_Pa, rho_kg_m3);
  medium.piezo_C_m2 = charge_C_N * stiffness_Pa;
  medium.permittivity_F_m =
      permittivity_stress_F_m - charge_C_N * stiffness_Pa * charge_C_N.transpose();
  if (!medium.permittivity_F_m.allFinite() || !Cholesky(medium.permittivity_F_m).is_definite()) {
    throw std::invalid_argument(
        "the piezoelectric constants are too large for the permittivity: no stable medium has "
        "them. Check the units of d (C/N) and the relative permittivity");
  }
  return medium;
}

Medium with_reversed_poling(Medium medium) {
  medium.piezo_C_m2 = -medium.piezo_C_m2;
  medium.free_polarisation_C_m2 = -medium.free_polarisation_C_m2;
  return medium;
}

Eigen::Matrix<double, 6, 1> free_strain_stress_Pa(const Medium& medium) {
  Eigen::Matrix<double, 6, 1> strain = Eigen::Matrix<double, 6, 1>::Zero();
  strain.head<3>().setConstant(medium.free_strain);
  return medium.stiffness_Pa * strain;
}

Eigen::MatrixXd coupled_form(const Medium& medium) {
  Eigen::MatrixXd form(9, 9);
  form << medium.stiffness_Pa, -medium.piezo_C_m2.transpose(), -medium.piezo_C_m2,
      -medium.permittivity_F_m;
  return form;
}

Eigen::MatrixXd material_form(const Medium& medium, bool is_electric, bool is_plane_stress) {
  Eigen::MatrixXd form = is_electric ? coupled_form(medium) : Eigen::MatrixXd(medium.stiffness_Pa);
  if (!is_plane_stress) return form;
  // E/(1 - nu^2) is finite at nu = 0.5, K is not: condense three-dimensional moduli just below.
  if (!is_electric && medium.is_isotropic && medium.poisson_ratio == 0.5) {
    return plane_stress_moduli(medium.shear_Pa * (deviatoric_form() + 1e12 * volumetric_form()));
  }
  return plane_stress_moduli(form);
}

double potential_scale_V(const Medium& film) {
  return std::sqrt(film.stiffness_Pa(2, 2) / film.permittivity_F_m(2, 2));
}

}  // namespace viscard
