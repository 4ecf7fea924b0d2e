#include "models/pillar/analyses/modal_mesh.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/pressed_modes.h"
#include "models/pillar/analyses/slender_rounding.h"

#include <algorithm>
#include <variant>

namespace viscard {

ModalMesh modal_mesh(const PillarScene& scene, Discretisation mesh) {
  if (!scene.discretisation) {
    // The n-th mode of a clamped bar has n - 1/2 half waves; with an element for each, even the lowest
    // degrees resolve all of them.
    mesh.longest_m = scene.geometry.length_m / (std::get<ModalDrive>(scene.drive).modes - 0.5);
    // Ovalling modes of a long pillar end within a diameter of its top.
    const double two_diameters_m = 2.0 * scene.geometry.diameter_m;
    if (scene.geometry.length_m > 40.0 * two_diameters_m) {
      mesh.longest_m = std::min(mesh.longest_m, two_diameters_m);
    }
    mesh.grades_top = is_pressed(scene);
  }
  const int layers = mesh.layers;
  const double rounding = avoid_rounding(scene, mesh);
  const double rim = mesh.layers < layers ? rim_share(scene, mesh, mesh.layers) : 0.0;
  return {mesh, rounding, rim};
}

}  // namespace viscard
