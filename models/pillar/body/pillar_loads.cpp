#include "models/pillar/body/pillar_model.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

// The field that carries the motion of the whole pillar. Its virtual work under a unit traction
// (force per volume) in that direction is measure * int field x^x_power: for m = 1, u_x has the
// mean b/2 over the angle, and the measure is pi instead of 2 pi (eq. 12).
int carrying_field(const PillarModel& model) {
  switch (model.options().motion) {
    case Motion::kLongitudinal:
    case Motion::kPlaneSymmetric:
    case Motion::kLateral:
      return 1;
    case Motion::kPlaneAntisymmetric:
      return 0;
    default:
      throw std::invalid_argument("this family of motion has no load that moves the whole pillar");
  }
}

}  // namespace

double top_area_m2(const PillarModel& model) {
  const double R_m = radius_at_m(model.geometry(), model.geometry().length_m);  // with its tip
  return model.system().kinematics().x_power == 1 ? std::numbers::pi * R_m * R_m : 2.0 * R_m;
}

Eigen::VectorXd unit_top_force(const PillarModel& model) {
  const PillarMesh& mesh = model.mesh();
  return model.system().line_load(carrying_field(model), mesh.top_row, 0, mesh.pillar_columns) /
         top_area_m2(model);
}

Eigen::VectorXd unit_acceleration_force(const PillarModel& model) {
  const DiscreteSystem& system = model.system();
  const Section& section = system.section();
  const Kinematics& k = system.kinematics();
  const int field = carrying_field(model);
  const Eigen::Index n1 = section.degree() + 1;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(system.size());
  for (const SectionElement& element : section.elements()) {
    const double weight = k.measure * model.medium(element.region).rho_kg_m3;
    const Eigen::VectorXd x =
        weight * section.x().integral(element.column, k.x_power, 0, 0).rowwise().sum();
    const Eigen::VectorXd z = section.z().integral(element.row, 0, 0, 0).rowwise().sum();
    for (Eigen::Index iz = 0; iz < n1; ++iz) {
      for (Eigen::Index ix = 0; ix < n1; ++ix) {
        const int node = element.nodes[static_cast<std::size_t>(iz * n1 + ix)];
        const int dof = system.dofs().dof(field, node);
        if (dof >= 0) load[dof] += x[ix] * z[iz];
      }
    }
  }
  return load;
}

Eigen::VectorXd heat_force(const PillarModel& model) {
  const DiscreteSystem& system = model.system();
  const std::vector<OperatorRow> rows = system.kinematics().strain_and_field();
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(system.size());
  const std::vector<SectionElement>& elements = system.section().elements();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Medium& medium = model.medium(elements[i].region);
    if (medium.free_strain == 0.0 && medium.free_polarisation_C_m2 == 0.0) continue;
    if (medium.is_isotropic && std::isinf(medium.bulk_Pa)) {
      throw std::invalid_argument(
          "an incompressible solid cannot expand by heat where it is held; its nu must lie below "
          "0.5");
    }
    Eigen::VectorXd at_point = Eigen::VectorXd::Zero(n);
    at_point.head(6) = free_strain_stress_Pa(medium);
    if (n > 6) {
      at_point.tail(3) = -medium.free_strain * medium.piezo_C_m2.leftCols<3>().rowwise().sum() +
                         medium.free_polarisation_C_m2 * Eigen::Vector3d::UnitZ();
    }
    const DiscreteSystem::ElementRows at = system.element_rows(rows, elements[i]);
    Eigen::VectorXd local = Eigen::VectorXd::Zero(at.B.cols());
    for (Eigen::Index k = 0; k < at.weight.size(); ++k) {
      local += at.weight[k] * at.B.middleRows(k * n, n).transpose() * at_point;
    }
    system.scatter(i, local, load);
  }
  return load;
}

}  // namespace viscard
