#include "models/array/plane/plane_system.h"

#include <algorithm>

namespace viscard {
namespace {

constexpr double kBulkOverShear = 1e6;  // stands for nu = 0.5

}  // namespace

Kinematics whole_plane() {
  Kinematics kinematics = kinematics_of(Motion::kPlaneSymmetric);
  kinematics.measure = 1.0;
  kinematics.zero_on_axis.clear();
  return kinematics;
}

DofMap plane_dofs(const Section& section, bool holds_base) {
  DofMap dofs(2, section.node_count());
  if (holds_base) {
    for (const int node : nodes_on_break(section, 0, 0, section.x().element_count())) {
      dofs.fix(kAcross, node);
      dofs.fix(kUp, node);
    }
  }
  dofs.number();
  return dofs;
}

PlaneForm plane_form(const Medium& medium, PlaneState plane, bool is_electric) {
  const bool is_plane_stress = plane == PlaneState::kStress;
  if (is_plane_stress || is_electric || !medium.is_isotropic ||
      medium.poisson_ratio < kNearlyIncompressible) {
    return {material_form(medium, is_electric, is_plane_stress), 0.0};
  }
  return {medium.shear_Pa * deviatoric_form(),
          std::min(medium.bulk_Pa, kBulkOverShear * medium.shear_Pa)};
}

SymmetricSparse stiffness_of(const DiscreteSystem& system, const PlaneForm& form) {
  SymmetricSparse matrix = system.form(system.kinematics().strain_and_field(), {form.form});
  if (form.condensed_bulk_Pa > 0.0) {
    matrix.coeffs() += system.volume_form({form.condensed_bulk_Pa}, true).coeffs();
  }
  return matrix;
}

std::vector<int> dofs_on(const DiscreteSystem& system, const std::vector<int>& nodes,
                         int field_count) {
  std::vector<int> dofs;
  for (const int node : nodes) {
    for (int field = 0; field < field_count; ++field) {
      const int dof = system.dofs().dof(field, node);
      if (dof >= 0) dofs.push_back(dof);
    }
  }
  return dofs;
}

std::vector<int> nodes_on_end(const Section& section, bool right) {
  std::vector<int> nodes;
  const int ix = right ? section.x().node_count() - 1 : 0;
  for (int iz = 0; iz < section.z().node_count(); ++iz) nodes.push_back(section.node(ix, iz));
  return nodes;
}

}  // namespace viscard
