#include "models/hyperelastic/deformation.h"

namespace viscard {

const std::vector<std::string>& deformation_names() {
  static const std::vector<std::string> kNames{"uniaxial", "planar", "equibiaxial"};
  return kNames;
}

const std::string& name_of(Deformation deformation) {
  return deformation_names()[static_cast<std::size_t>(deformation)];
}

Eigen::Vector3d strain_direction(Deformation deformation) {
  switch (deformation) {
    case Deformation::kUniaxial:
      return {1.0, -0.5, -0.5};
    case Deformation::kPlanar:
      return {1.0, 0.0, -1.0};
    case Deformation::kEquibiaxial:
      break;
  }
  return {1.0, 1.0, -2.0};
}

double n_loaded_directions(Deformation deformation) {
  return deformation == Deformation::kEquibiaxial ? 2.0 : 1.0;
}

}  // namespace viscard
