#include "models/pillar/scene.h"

#include "models/pillar/analysis.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace viscard {

void validate(const Scene& scene) {
  validate(scene.geometry);
  validate(scene.pillar);
  if (!(scene.tolerance >= 1e-9 && scene.tolerance < 1.0)) {
    throw std::invalid_argument("the tolerance is " + std::to_string(scene.tolerance) +
                                "; it must lie between 1e-9 and 1");
  }
  if (scene.geometry.film.has_value() != scene.film.has_value()) {
    throw std::invalid_argument("a film needs its material, and a material its film");
  }
  if (scene.electrodes) {
    if (!scene.film || !scene.film->is_piezoelectric()) {
      throw std::invalid_argument("an electrode needs a film of piezoelectric material");
    }
    if (scene.electrodes->electrode_radius_m > scene.geometry.film->radius_m * (1.0 + 1e-9)) {
      throw std::invalid_argument("the electrode is wider than the film");
    }
  }
  if (!std::isfinite(scene.pressure_Pa)) throw std::invalid_argument("the pressure is not finite");
  const Analysis& analysis = analysis_of(scene.kind);
  if (analysis.has_inertia) {
    const std::string needs = std::string(analysis.name) + " analysis needs the density of the ";
    if (!(scene.pillar.rho_kg_m3 > 0.0)) throw std::invalid_argument(needs + "pillar");
    if (scene.film && !(scene.film->rho_kg_m3 > 0.0)) throw std::invalid_argument(needs + "film");
  }
  analysis.check(scene);
}

}  // namespace viscard
