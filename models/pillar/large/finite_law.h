#pragma once

#include "models/hyperelastic/hyperelastic_law.h"

#include <Eigen/Core>

#include <optional>

namespace viscard {

// A slightly compressible isotropic law for large strain:
//   W = W_iso(s_i J^(-1/3)) + (K/2) (J - 1)^2                                                (N1)
// with W_iso a law of rubber at stretches of unit volume. Without one it is the law of St Venant and
// Kirchhoff, lambda (tr E)^2/2 + mu E:E of Green's strain E, which has no separate volumetric part.
// Sources: Holzapfel, Nonlinear Solid Mechanics (2000), ch. 6.4; Bonet & Wood, Nonlinear Continuum
// Mechanics for Finite Element Analysis (2008), ch. 6.
struct FiniteLaw {
  std::optional<HyperelasticLaw> rubber;  // its moduli scaled to shear_Pa at rest
  double shear_Pa = 0.0;                  // at rest
  double bulk_Pa = 0.0;                   // at rest; infinite at nu = 0.5
  double poisson_ratio = 0.0;             // at rest
};

// The law of rubber whose Young's modulus at rest stays E0 at the Poisson ratio nu: the tension that
// was measured is kept, so that all moduli are multiplied by 3/(2 (1 + nu)). Throws std::invalid_argument unless
// 0 <= nu <= 0.5.
FiniteLaw finite_law(const HyperelasticLaw& rubber, double poisson_ratio);
// Throws std::invalid_argument unless E > 0 and -1 < nu < 0.5.
FiniteLaw st_venant_kirchhoff(double young_modulus_Pa, double poisson_ratio);

// The gradient of the displacement without twist: rr, rz, tt, zr, zz (d u_r/dr, d u_r/dz, u_r/r,
// d u_z/dr, d u_z/dz).
using Gradient5 = Eigen::Matrix<double, 5, 1>;
using Tangent5 = Eigen::Matrix<double, 5, 5>;

// Derivatives of an energy per volume at rest by the gradient: the nominal stress and its tangent.
struct GradientDerivatives {
  Gradient5 stress = Gradient5::Zero();  // Pa, of the energy; of J: a pure number
  Tangent5 tangent = Tangent5::Zero();   // the same
};
// Of the energy without (K/2) (J - 1)^2. All entries are nan where the law ends (Gent) or the body is
// turned inside out.
GradientDerivatives shape_energy(const FiniteLaw& law, const Gradient5& gradient);

// J - 1, the change of volume, without loss of digits at small strain; and the derivatives of J.
double volume_change(const Gradient5& gradient);
GradientDerivatives volume_derivatives(const Gradient5& gradient);

// The true stress (Cauchy) rr, tt, zz, rz from the nominal one: P F^t/J.
Eigen::Vector4d true_stress_Pa(const Gradient5& nominal_Pa, const Gradient5& gradient);

}  // namespace viscard
