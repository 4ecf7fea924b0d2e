#include "models/array/layer/layer_scene.h"

namespace viscard {

LayeredFilm stack_of(const LayerScene& scene) {
  LayeredFilm stack;
  stack.layers = {{scene.film, scene.film_thickness_m},
                  {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3),
                   scene.thickness_m}};
  stack.grounded = scene.grounded;
  stack.is_plane_stress = scene.model == LayerModel::kPlaneStress;
  return stack;
}

LayerPress press_of(const LayerScene& scene) {
  return {scene.press.shape, scene.width_m, !scene.feels_contact};
}

double contact_modulus_Pa(const LayerScene& scene) {
  const double nu = scene.model == LayerModel::kPlaneStress ? 0.0 : scene.pillar.nu;
  return scene.pillar.E0_Pa / (1.0 - nu * nu);
}

double bonded_modulus_Pa(const LayerScene& scene) {
  const double nu = scene.pillar.nu;
  if (scene.model == LayerModel::kPlaneStress) return scene.pillar.E0_Pa / (1.0 - nu * nu);
  return scene.pillar.E0_Pa * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
}

}  // namespace viscard
