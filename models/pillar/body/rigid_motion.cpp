#include "models/pillar/body/pillar_model.h"

#include <functional>

namespace viscard {
namespace {

// One field of a rigid motion as a function of position, u(x, z - bottom).
struct RigidPart {
  int field = 0;
  std::function<double(double x, double height)> value;
};
using RigidMotion = std::vector<RigidPart>;

// Sideways by 1 m: u_x = 1 is b = 2 (eq. 12). A rotation is u_x = height, u_z = -x.
std::vector<RigidMotion> motions_of(Motion motion) {
  const auto one = [](double, double) { return 1.0; };
  const auto back = [](double x, double) { return -x; };
  switch (motion) {
    case Motion::kLongitudinal:
    case Motion::kPlaneSymmetric:
      return {{{1, one}}};
    case Motion::kTorsion:
      return {{{0, [](double x, double) { return x; }}}};
    case Motion::kLateral:
      return {{{1, [](double, double) { return 2.0; }}},
              {{1, [](double, double height) { return 2.0 * height; }}, {2, back}}};
    case Motion::kPlaneAntisymmetric:
      return {{{0, one}}, {{0, [](double, double height) { return height; }}, {1, back}}};
    case Motion::kOvalling:
      return {};
  }
  return {};
}

}  // namespace

int rigid_motion_count(Motion motion) {
  return static_cast<int>(motions_of(motion).size());
}

Eigen::MatrixXd rigid_motions(const PillarModel& model) {
  const std::vector<RigidMotion> motions = motions_of(model.options().motion);
  const DiscreteSystem& system = model.system();
  const Section& section = system.section();
  const double bottom_m = section.z().breaks().front();
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(system.size(), static_cast<Eigen::Index>(motions.size()));
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (const RigidPart& part : motions[i]) {
      for (int node = 0; node < section.node_count(); ++node) {
        const int dof = system.dofs().dof(part.field, node);
        if (dof < 0) continue;
        columns(dof, static_cast<Eigen::Index>(i)) =
            part.value(section.node_x(node), section.node_z(node) - bottom_m);
      }
    }
  }
  return columns;
}

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
