#pragma once

#include <Eigen/Core>

namespace viscard {

// A matrix between stresses and strains.
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

// Poisson ratio from which pressures are condensed (eq. 14), because stresses from displacements
// alone become wrong through locking.
constexpr double kNearlyIncompressible = 0.45;

// A matrix between strains and electric displacement.
using PiezoMatrix = Eigen::Matrix<double, 3, 6>;

// A linear elastic or piezoelectric medium:
//   T = c S - e^t E,  D = e S + eps E   (eq. 20), IEEE Std 176-1987.
struct Medium {
  double rho_kg_m3 = 0.0;
  Matrix6d stiffness_Pa = Matrix6d::Zero();                    // c at constant field
  PiezoMatrix piezo_C_m2 = PiezoMatrix::Zero();                // e
  Eigen::Matrix3d permittivity_F_m = Eigen::Matrix3d::Zero();  // eps at constant strain; 0: none

  // Set for an isotropic medium, so that its bulk part can be treated separately near nu = 0.5.
  bool is_isotropic = false;
  double shear_Pa = 0.0;
  double bulk_Pa = 0.0;  // infinite at nu = 0.5
  double poisson_ratio = 0.0;

  // By heat: of a body that nothing holds, with its faces shorted. In T = c (S - free strain) - e^t E and
  // D = e (S - free strain) + eps E + free polarisation.
  double free_strain = 0.0;             // in each direction, a pure number
  double free_polarisation_C_m2 = 0.0;  // along z

  bool is_piezoelectric() const { return !piezo_C_m2.isZero(0.0); }
  bool has_permittivity() const { return permittivity_F_m(2, 2) > 0.0; }
};

// Throws std::invalid_argument unless E > 0, -1 < nu <= 0.5 and rho >= 0. At nu = 0.5 stiffness_Pa
// contains only the shear part and bulk_Pa is infinite.
Medium isotropic_medium(double young_modulus_Pa, double poisson_ratio, double rho_kg_m3);

// Throws std::invalid_argument unless the stiffness is symmetric and positive definite and rho >= 0.
Medium elastic_medium(const Matrix6d& stiffness_Pa, double rho_kg_m3);

// From stiffness (Pa), charge constants d (C/N) and permittivity at constant stress (F/m): e = d c,
// eps^S = eps^T - d c d^t. Throws std::invalid_argument if the stiffness or the resulting
// permittivity is not positive definite (the constants cannot belong to one medium).
Medium piezo_medium(const Matrix6d& stiffness_Pa, const PiezoMatrix& charge_C_N,
                    const Eigen::Matrix3d& permittivity_stress_F_m, double rho_kg_m3);

// The stress that would suppress the free strain, with the other sign: c times it (Voigt, Pa).
Eigen::Matrix<double, 6, 1> free_strain_stress_Pa(const Medium& medium);

// Poled along -z instead of +z: e and the free polarisation change sign.
Medium with_reversed_poling(Medium medium);

// The 9 x 9 form [c, -e^t; -e, -eps] for rows [strain; electric field] with E = -grad phi.
Eigen::MatrixXd coupled_form(const Medium& medium);
// The form for rows of strain or, if electric, [strain; electric field].
Eigen::MatrixXd material_form(const Medium& medium, bool is_electric, bool is_plane_stress);

// Unit of the potential in which the elastic and the electric entries of the form have one size
// (times a length of 1 m): sqrt(stiffness/permittivity).
double potential_scale_V(const Medium& film);

constexpr double kVacuumPermittivity_F_m = 8.8541878128e-12;  // CODATA 2018

}  // namespace viscard
