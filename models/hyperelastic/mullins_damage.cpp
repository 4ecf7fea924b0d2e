#include "models/hyperelastic/mullins_damage.h"

#include "models/hyperelastic/law_energy.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// (W_m - W)/(m + beta W_m); 0 at rest before any loading.
double relative_drop(const MullinsDamage& damage, double energy_Pa, double largest_Pa) {
  const double drop = largest_Pa - energy_Pa;
  return drop > 0.0 ? drop / (damage.m_Pa + damage.beta * largest_Pa) : 0.0;
}

}  // namespace

const std::vector<std::string>& damage_parameter_names() {
  static const std::vector<std::string> kNames{"r", "m_Pa", "beta"};
  return kNames;
}

void validate(const MullinsDamage& damage) {
  require_value(damage.r > 1.0, "r of mullins-or", damage.r, "", "above 1 and finite");
  require_not_negative("m of mullins-or", damage.m_Pa, "Pa");
  require_not_negative("beta of mullins-or", damage.beta);
  require(damage.m_Pa > 0.0 || damage.beta > 0.0,
          "m and beta of mullins-or are both 0; one must be positive");
}

double softening_factor(const MullinsDamage& damage, double energy_Pa, double largest_energy_Pa) {
  return 1.0 - std::erf(relative_drop(damage, energy_Pa, largest_energy_Pa)) / damage.r;
}

double lost_energy_Pa(const MullinsDamage& damage, double energy_Pa, double largest_energy_Pa) {
  const double x = relative_drop(damage, energy_Pa, largest_energy_Pa);
  const double width_Pa = damage.m_Pa + damage.beta * largest_energy_Pa;
  return width_Pa / damage.r * (x * std::erf(x) + std::expm1(-x * x) * std::numbers::inv_sqrtpi);
}

std::vector<double> nominal_stress_Pa(const HyperelasticLaw& law, const MullinsDamage& damage,
                                      Deformation deformation, const std::vector<double>& stretch) {
  std::vector<double> stress_Pa;
  double largest_Pa = 0.0;
  for (const double s : stretch) {
    const double energy = energy_Pa(law, std::log(s) * strain_direction(deformation));
    largest_Pa = std::max(largest_Pa, energy);
    stress_Pa.push_back(softening_factor(damage, energy, largest_Pa) *
                        nominal_stress_Pa(law, deformation, s));
  }
  return stress_Pa;
}

}  // namespace viscard
