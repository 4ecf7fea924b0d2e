#pragma once

#include "models/pillar/mesh/pillar_mesh.h"
#include "models/pillar/scene/pillar_scene.h"

namespace viscard {

// A mesh for the modes of a scene, and the rounding of its lateral modes.
struct ModalMesh {
  Discretisation mesh;
  double rounding = 0.0;  // relative error of the first bending frequency (slender_rounding.h)
  double rim = 0.0;       // that of the layers that were removed for the rounding
};

// `mesh` with elements for the highest mode that the scene wants; as it is where the scene states one.
// Throws std::runtime_error where rounding exceeds the scene's tolerance.
ModalMesh modal_mesh(const PillarScene& scene, Discretisation mesh);

}  // namespace viscard
