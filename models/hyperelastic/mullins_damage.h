#pragma once

#include "models/hyperelastic/hyperelastic_law.h"

#include <string>
#include <vector>

namespace viscard {

// Softening of a rubber by its first loading: the pseudo-elastic law of Ogden & Roxburgh, Proc. R. Soc.
// Lond. A 455 (1999) 2861, with the third constant beta of finite-element codes (Abaqus Analysis User's
// Guide, Mullins effect; mullins-or). All stresses of a law are multiplied by
//   eta = 1 - erf((W_m - W)/(m + beta W_m))/r                                                   (3)
// where W is the energy of the law at the strain and W_m its largest value so far. On the first loading
// eta is 1; unloading and reloading up to W_m are one curve, without hysteresis and set.
struct MullinsDamage {
  double r = 0.0;     // above 1; at rest the modulus is never below 1 - 1/r of the law's
  double m_Pa = 0.0;  // an energy per volume
  double beta = 0.0;  // pure number
};

// Its name in files and on the command line.
inline constexpr const char* kMullinsName = "mullins-or";
// "r", "m_Pa", "beta".
const std::vector<std::string>& damage_parameter_names();

// Throws std::invalid_argument naming the number: r not above 1, m or beta negative, or both 0.
void validate(const MullinsDamage& damage);

// eta of (3).
double softening_factor(const MullinsDamage& damage, double energy_Pa, double largest_energy_Pa);

// Energy per volume that is lost between loading to W_m and unloading to W, whatever the deformation: the
// integral of 1 - eta over W. With x = (W_m - W)/a, a = m + beta W_m it is
// a/r (x erf(x) + (exp(-x^2) - 1)/sqrt(pi)).
double lost_energy_Pa(const MullinsDamage& damage, double energy_Pa, double largest_energy_Pa);

// Nominal stress at each of these stretches, in the order in which a body at rest goes through them.
std::vector<double> nominal_stress_Pa(const HyperelasticLaw& law, const MullinsDamage& damage,
                                      Deformation deformation, const std::vector<double>& stretch);

}  // namespace viscard
