#pragma once

#include "models/hyperelastic/law_stability.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Elastomeric foam of N terms (hyperfoam-N), with principal stretches s_i and J = s_1 s_2 s_3:
//   W = sum over terms of 2 mu/alpha^2 [s_1^alpha + s_2^alpha + s_3^alpha - 3 + (J^(-alpha beta) - 1)/beta],
//   beta = nu/(1 - 2 nu); for beta = 0 the last part is -alpha ln J.                                   (4)
// The Kirchhoff stress is tau_k = sum of 2 mu/alpha (s_k^alpha - J^(-alpha beta)). At rest the shear modulus
// is the sum of the mu and the bulk modulus that of 2 mu (1/3 + beta). If all terms have one nu, the side
// of a uniaxial test is s^-nu at any strain.
// Sources: Ogden, Proc. R. Soc. Lond. A 328 (1972) 567; Hill, Adv. Appl. Mech. 18 (1978) 1; Storakers,
// J. Mech. Phys. Solids 34 (1986) 125; constants as in Abaqus, *HYPERFOAM.
struct FoamLaw {
  Eigen::VectorXd mu_Pa, alpha, nu;  // of each term
};
inline constexpr Eigen::Index kMostFoamTerms = 3;

// The family, and "hyperfoam-1" to "hyperfoam-3".
inline constexpr const char* kFoamName = "hyperfoam";
std::string foam_name(Eigen::Index n_terms);
// Number of terms of such a name; nothing for another.
std::optional<Eigen::Index> foam_terms_of(const std::string& name);

// Throws std::invalid_argument naming the number: number of terms, alpha 0, nu outside -1 to 0.5, no
// stiffness at rest.
void validate(const FoamLaw& law);

// Of shape and of volume, at rest.
double shear_modulus_Pa(const FoamLaw& law);
// The same of volume alone.
double bulk_modulus_Pa(const FoamLaw& law);
// At rest, of both moduli.
double poisson_ratio(const FoamLaw& law);
double youngs_modulus_Pa(const FoamLaw& law);

// W of (4), Pa, and the principal Kirchhoff stresses, at principal logarithmic strains.
double energy_Pa(const FoamLaw& law, const Eigen::Vector3d& log_strain);
Eigen::Vector3d kirchhoff_Pa(const FoamLaw& law, const Eigen::Vector3d& log_strain);
// Derivative of the Kirchhoff stresses by the logarithmic strains.
Eigen::Matrix3d kirchhoff_tangent_Pa(const FoamLaw& law, const Eigen::Vector3d& log_strain);

// Homogeneous tests of a foam. The measured quantity is the stretch s, of shear the tangent of its angle.
enum class FoamTest {
  kUniaxial,     // free sides
  kPlanar,       // one side held, the other free
  kEquibiaxial,  // s, s, the third free
  kConfined,     // s, 1, 1 (oedometer)
  kVolumetric,   // s, s, s (hydrostatic); the force works along all three
  kShear         // simple shear: the volume stays, so that nu does not count
};
// "uniaxial", "planar", "equibiaxial", "confined", "volumetric", "shear", in their order.
const std::vector<std::string>& foam_test_names();
const std::string& name_of(FoamTest test);

// A body in a test.
struct FoamState {
  Eigen::Vector3d log_strain = Eigen::Vector3d::Zero();
  double nominal_stress_Pa =
      0.0;  // force over area at rest; of shear the shear stress, true and nominal
  double lateral_stretch() const;  // of the first free or held side
};
// `measured`: stretch, volume ratio or the tangent of shear, a pure number. Free sides are solved to rounding; nan where a law that is not stable has no such state.
FoamState foam_state(const FoamLaw& law, FoamTest test, double measured);

// True if the tangent is positive definite: every change of the strains does positive work on the change of
// the Kirchhoff stresses (Hill's form of Drucker's postulate).
bool is_stable(const FoamLaw& law, const Eigen::Vector3d& log_strain);
// Range of the measured quantity about rest in which a test is stable, up to stretches of 0.1 to 10, of shear
// to tangents of -10 and 10.
StableRange stable_range(const FoamLaw& law, FoamTest test);

}  // namespace viscard
