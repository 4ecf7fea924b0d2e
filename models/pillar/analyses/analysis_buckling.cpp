#include "models/pillar/analyses/analysis.h"
#include "models/pillar/body/pillar_modes.h"

#include <stdexcept>

namespace viscard {

void check_buckling(const Scene& scene) {
  if (scene.plane) {
    throw std::invalid_argument("buckling is computed for a cylinder, not for a strip");
  }
}

void run_buckling(const Scene& scene, SceneAnswer& answer) {
  const PillarModel axial = model_of(scene, Motion::kLongitudinal, answer);
  const PillarModel lateral = model_of(scene, Motion::kLateral, answer);
  count_unknowns(lateral, answer);
  answer.results.push_back({"buckling_pressure", buckling(axial, lateral).pressure_Pa, "Pa"});
}

}  // namespace viscard
