#include "models/pillar/viscoelastic_pillar.h"

namespace viscard {

ViscoelasticPillar::ViscoelasticPillar(const PillarGeometry& geometry,
                                       const Discretisation& discretisation,
                                       const Material& material, TopLoad top,
                                       const std::optional<Medium>& film) {
  validate(material);
  model_ = std::make_unique<PillarModel>(
      geometry, discretisation,
      PillarMedia{isotropic_medium(material.E0_Pa, material.nu, material.rho_kg_m3), film},
      ModelOptions{.rigid_top = top == TopLoad::kRigidPlate});
  const DiscreteSystem& discrete = model_->system();
  const DerivedModuli moduli = derived_moduli(material);
  const std::vector<OperatorRow>& strain = discrete.kinematics().strain;
  system_.terms = material.terms;
  system_.incompressible = material.nu == 0.5;
  system_.shear = discrete.form(strain, {moduli.G0_Pa * deviatoric_form(), {}});
  const double bulk_Pa = system_.incompressible ? kPenaltyOverShear * moduli.G0_Pa : moduli.K0_Pa;
  system_.bulk = discrete.volume_form({bulk_Pa, 0.0}, material.nu >= kNearlyIncompressible);
  system_.elastic = discrete.zero();
  if (film) system_.elastic = discrete.form(strain, {{}, film->stiffness_Pa});
  const Eigen::VectorXd traction = model_->top_traction();
  top_area_m2_ = traction.sum();
  system_.load = traction / top_area_m2_;
}

}  // namespace viscard
