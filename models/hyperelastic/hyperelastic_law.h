#pragma once

#include "models/hyperelastic/deformation.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

// Strain energy W of an incompressible isotropic rubber per volume at rest. I1 and I2 are the
// invariants of the left Cauchy-Green tensor, s_i the principal stretches.
//   neo-hooke      C10 (I1 - 3)
//   mooney-rivlin  C10 (I1 - 3) + C01 (I2 - 3)
//   yeoh           C10 (I1 - 3) + C20 (I1 - 3)^2 + C30 (I1 - 3)^3
//   ogden-N        sum over N terms of 2 mu_i/alpha_i^2 (s_1^alpha_i + s_2^alpha_i + s_3^alpha_i - 3)
//   arruda-boyce   mu sum over i = 1 to 5 of C_i/s_m^(2i - 2) (I1^i - 3^i),
//                  C = 1/2, 1/20, 11/1050, 19/7000, 519/673750
//   gent           -mu J_m/2 ln(1 - (I1 - 3)/J_m)
// Ogden's terms are written so that the shear modulus at rest is the sum of the mu_i; mu_i of Ogden
// (1972) is 2 mu_i/alpha_i of these. A term with mu_i > 0 is stable. The initial shear modulus of
// arruda-boyce is mu (1 + 3/(5 s_m^2) + ...), of gent mu.
// Sources: Treloar, The Physics of Rubber Elasticity (1975); Ogden, Proc. R. Soc. A 326 (1972) 565;
// Yeoh, Rubber Chem. Technol. 66 (1993) 754; Arruda & Boyce, J. Mech. Phys. Solids 41 (1993) 389,
// eq. 21; Gent, Rubber Chem. Technol. 69 (1996) 59.
enum class HyperelasticForm {
  kNeoHooke,
  kMooneyRivlin,
  kYeoh,
  kOgden1,
  kOgden2,
  kOgden3,
  kArrudaBoyce,
  kGent
};

// C_i of arruda-boyce.
inline constexpr double kArrudaBoyceSeries[] = {1.0 / 2.0, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0,
                                                519.0 / 673750.0};

// In the order of HyperelasticForm, as on the command line.
const std::vector<std::string>& hyperelastic_names();
const std::string& name_of(HyperelasticForm form);
// All forms, in their order.
const std::vector<HyperelasticForm>& hyperelastic_forms();

// W is linear in the moduli and not in the shapes (alpha_i, s_m, J_m).
std::vector<std::string> modulus_names(HyperelasticForm form);
std::vector<std::string> shape_names(HyperelasticForm form);
// Number of moduli of a form.
inline Eigen::Index n_moduli(HyperelasticForm form) {
  return static_cast<Eigen::Index>(modulus_names(form).size());
}
// Number of shapes of a form.
inline Eigen::Index n_shapes(HyperelasticForm form) {
  return static_cast<Eigen::Index>(shape_names(form).size());
}

// A form with its parameters.
struct HyperelasticLaw {
  HyperelasticForm form = HyperelasticForm::kNeoHooke;
  Eigen::VectorXd moduli_Pa;  // in the order of modulus_names()
  Eigen::VectorXd shapes;     // in the order of shape_names()
};

// Throws std::invalid_argument naming the parameter: wrong number of parameters, not finite, s_m or
// J_m not positive, no stiffness at rest.
void validate(const HyperelasticLaw& law);

// First and second derivatives of W by the principal logarithmic strains, in Pa. The gradient lacks
// a part that is equal for all three: only differences have a meaning, because the pressure is free.
struct LogDerivatives {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};
LogDerivatives log_derivatives(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain);

// False beyond the largest stretch of a law that has one (gent).
bool is_within_limit(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain);

// Force over area at rest, Pa, at the measured stretch (> 0). nan beyond the law's limit.
double nominal_stress_Pa(const HyperelasticLaw& law, Deformation deformation, double stretch);
// Its derivative by the stretch.
double nominal_tangent_Pa(const HyperelasticLaw& law, Deformation deformation, double stretch);

// The nominal stress for a unit of each modulus, and its derivative by each shape (rows: moduli,
// columns: shapes).
struct StressColumns {
  Eigen::VectorXd values;
  Eigen::MatrixXd shape_slopes;
};
// At one stretch.
StressColumns stress_columns(HyperelasticForm form, const Eigen::VectorXd& shapes,
                             Deformation deformation, double stretch);

// Principal Kirchhoff stresses for a unit of each modulus (columns), up to the pressure, and their
// derivatives by each shape.
struct PrincipalColumns {
  Eigen::Matrix3Xd values;
  std::vector<Eigen::Matrix3Xd> shape_slopes;  // empty unless they are asked for
};
// At principal logarithmic strains.
PrincipalColumns principal_columns(HyperelasticForm form, const Eigen::VectorXd& shapes,
                                   const Eigen::Vector3d& log_strain, bool with_slopes);

// Young's modulus at rest for a unit of each modulus: three times the shear modulus.
Eigen::VectorXd youngs_columns(HyperelasticForm form, const Eigen::VectorXd& shapes);
double youngs_modulus_Pa(const HyperelasticLaw& law);

}  // namespace viscard
