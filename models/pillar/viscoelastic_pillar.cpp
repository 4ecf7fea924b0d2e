#include "models/pillar/viscoelastic_pillar.h"

#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

DofMap longitudinal_dofs(const PillarMesh& mesh, TopLoad top) {
  const Kinematics kinematics = longitudinal_kinematics();
  const Section& section = mesh.section;
  DofMap dofs(kinematics.field_count, section.node_count());
  if (top == TopLoad::kRigidPlate) {
    dofs.tie(1, nodes_on_break(section, mesh.top_row, 0, mesh.pillar_columns));
  }
  for (int node = 0; node < section.node_count(); ++node) {
    if (section.node_x(node) == 0.0) {
      for (const int field : fields_zero_on_axis(kinematics)) dofs.fix(field, node);
    }
  }
  for (const int node : nodes_on_break(section, 0, 0, section.x().element_count())) {
    for (int field = 0; field < kinematics.field_count; ++field) dofs.fix(field, node);
  }
  dofs.number();
  return dofs;
}

}  // namespace

ViscoelasticPillar::ViscoelasticPillar(const PillarGeometry& geometry,
                                       const Discretisation& discretisation,
                                       const Material& material, TopLoad top,
                                       const std::optional<Matrix6d>& film_moduli_Pa) {
  validate(material);
  if (geometry.film.has_value() != film_moduli_Pa.has_value()) {
    throw std::invalid_argument("a film needs its moduli, and moduli need a film");
  }
  mesh_ = std::make_unique<PillarMesh>(pillar_mesh(geometry, discretisation));
  discrete_ = std::make_unique<DiscreteSystem>(mesh_->section, longitudinal_kinematics(),
                                               longitudinal_dofs(*mesh_, top));
  const DerivedModuli moduli = derived_moduli(material);
  const std::vector<OperatorRow>& strain = discrete_->kinematics().strain;
  system_.terms = material.terms;
  system_.incompressible = material.nu == 0.5;
  system_.shear = discrete_->form(strain, {moduli.G0_Pa * deviatoric_form(), {}});
  // The penalty of the augmented Lagrangian; its size sets the number of iterations, not the
  // answer.
  constexpr double kPenaltyOverShear = 1e4;
  const double bulk_Pa = system_.incompressible ? kPenaltyOverShear * moduli.G0_Pa : moduli.K0_Pa;
  system_.bulk = discrete_->volume_form({bulk_Pa, 0.0}, material.nu >= kNearlyIncompressible);
  system_.elastic =
      film_moduli_Pa ? discrete_->form(strain, {{}, *film_moduli_Pa}) : discrete_->zero();
  const Eigen::VectorXd per_traction =
      discrete_->line_load(1, mesh_->top_row, 0, mesh_->pillar_columns);
  top_area_m2_ = std::numbers::pi * 0.25 * geometry.diameter_m * geometry.diameter_m;
  system_.load = per_traction / top_area_m2_;
}

}  // namespace viscard
