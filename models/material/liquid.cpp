#include "models/material/liquid.h"

#include "models/material/lasting_share.h"
#include "models/maths/require.h"

namespace viscard {

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
