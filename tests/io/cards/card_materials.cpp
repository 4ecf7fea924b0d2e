#include "tests/io/cards/card_materials.h"

#include <cmath>

namespace viscard::test {

Material reference_material() {
  Material material;
  material.name = "PDMS";
  material.E0_Pa = 1.88e6;
  material.nu = 0.495;
  material.rho_kg_m3 = 965.0;
  material.terms = {{0.008206, 0.008206, 0.1945}, {0.01386, 0.01386, 2.403}};
  material.valid = {0.0125, 60.0, 0.05};
  material.provenance.raw_files = {{"run.viscap", std::string(64, 'a')}};
  return material;
}

Material material_of_terms(int n, double nu) {
  Material material;
  material.name = "Spectrum";
  material.E0_Pa = 3.7123456789e6;
  material.nu = nu;
  material.rho_kg_m3 = 1030.0;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double share = 1.0 + 0.7 * std::sin(1.3 * i + 0.4);
    material.terms.push_back({share, 0.0, 1.2345e-3 * std::pow(10.0, i / 3.0)});
    sum += share;
  }
  for (MaterialTerm& term : material.terms) {
    term.g *= 0.6 / sum;
    term.k = term.g;
  }
  return material;
}

}  // namespace viscard::test
