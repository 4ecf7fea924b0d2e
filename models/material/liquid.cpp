#include "models/material/liquid.h"

#include "models/maths/require.h"

#include <cmath>

namespace viscard {

double lasting_share(double sum) {
  constexpr double kOfRounding = 1e-12;
  return std::abs(1.0 - sum) <= kOfRounding ? 0.0 : 1.0 - sum;
}

bool is_liquid(const Material& material) {
  double sum = 0.0;
  for (const MaterialTerm& term : material.terms) sum += term.g;
  return lasting_share(sum) == 0.0;
}

void refuse_liquid(const Material& material, const std::string& name) {
  require(!is_liquid(material), name +
                                    ": E_inf = 0: this is a liquid, and a solid is needed here. "
                                    "Fit the data with --solid, or use viscard predict");
}

void validate_solid(const Material& material) {
  validate(material);
  refuse_liquid(material, "the material");
}

}  // namespace viscard
