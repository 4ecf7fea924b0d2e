#include "models/pillar/body/rigid_pins.h"

namespace viscard {

std::vector<RigidPin> rigid_pins(Motion motion) {
  switch (motion) {
    case Motion::kLongitudinal:
    case Motion::kPlaneSymmetric:
      return {{1, false}};
    case Motion::kTorsion:
      return {{0, true}};
    case Motion::kLateral:
      return {{1, false}, {2, true}};
    case Motion::kPlaneAntisymmetric:
      return {{0, false}, {1, true}};
    case Motion::kOvalling:
      return {};
  }
  return {};
}

}  // namespace viscard
