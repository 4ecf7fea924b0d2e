#include "models/pillar/scene.h"

#include <cmath>
#include <stdexcept>

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
  const bool in_time =
      scene.kind == AnalysisKind::kCreep || scene.kind == AnalysisKind::kRelaxation;
  if (in_time && scene.history.size() < 2) {
    throw std::invalid_argument("creep and relaxation need a history of at least two points");
  }
  if (in_time && scene.plane) {
    throw std::invalid_argument(
        "creep and relaxation are computed for a cylinder, not for a strip");
  }
  if (scene.kind == AnalysisKind::kStatic && scene.pressure_Pa == 0.0) {
    throw std::invalid_argument("a static analysis needs a pressure on the top");
  }
  if (!std::isfinite(scene.pressure_Pa)) throw std::invalid_argument("the pressure is not finite");
  if (scene.kind == AnalysisKind::kModal) {
    if (scene.modes < 1 || scene.modes > 40) {
      throw std::invalid_argument("modes: " + std::to_string(scene.modes) +
                                  " per family; it must lie between 1 and 40");
    }
    if (!(scene.pillar.rho_kg_m3 > 0.0)) {
      throw std::invalid_argument("a modal analysis needs the density of the pillar");
    }
    if (scene.film && !(scene.film->rho_kg_m3 > 0.0)) {
      throw std::invalid_argument("a modal analysis needs the density of the film");
    }
  }
  if (scene.kind == AnalysisKind::kBuckling && scene.plane) {
    throw std::invalid_argument("buckling is computed for a cylinder, not for a strip");
  }
}

}  // namespace viscard
