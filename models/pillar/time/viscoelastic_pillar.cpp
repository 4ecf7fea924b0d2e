#include "models/pillar/time/viscoelastic_pillar.h"

#include "models/material/liquid.h"
#include "models/maths/require.h"

namespace viscard {

ViscoelasticSystem viscoelastic_system(const PillarModel& model, const Material& material,
                                       bool with_mass) {
  const DiscreteSystem& discrete = model.system();
  const DerivedModuli moduli = derived_moduli(material);
  const std::vector<OperatorRow>& strain = discrete.kinematics().strain;
  ViscoelasticSystem system;
  system.terms = material.terms;
  if (model.is_plane_stress() && material.nu < 0.5) {
    require(has_constant_poisson_ratio(material),
            "in plane stress the shear and the bulk modulus must relax alike (k = g for every term "
            "of the Prony series); use plane strain or the cylinder instead");
    const Matrix6d& c_Pa = model.medium(kPillarRegion).stiffness_Pa;
    system.shear = discrete.form(strain, {plane_stress_moduli(c_Pa), {}});
    system.bulk = discrete.zero();
  } else if (model.is_plane_stress()) {
    system.shear =
        model.stiffness();  // incompressible: only the shear modulus is left in plane stress
    require(!model.geometry().film,
            "an incompressible strip in plane stress cannot stand on a film; use plane strain");
    system.bulk = discrete.zero();
  } else {
    system.incompressible = material.nu == 0.5;
    system.shear = discrete.form(strain, {moduli.G0_Pa * deviatoric_form(), {}});
    const double bulk_Pa = system.incompressible ? kPenaltyOverShear * moduli.G0_Pa : moduli.K0_Pa;
    const bool condenses = material.nu >= kNearlyIncompressible;
    system.bulk = discrete.volume_form({bulk_Pa, 0.0}, condenses);
    if (model.loses_digits()) {
      system.by_shear = [&discrete, G_Pa = moduli.G0_Pa](const Eigen::VectorXd& u) {
        return discrete.form_times(discrete.kinematics().strain, {G_Pa * deviatoric_form(), {}}, u);
      };
      system.by_bulk = [&discrete, bulk_Pa, condenses](const Eigen::VectorXd& u) {
        return discrete.volume_form_times({bulk_Pa, 0.0}, condenses, u);
      };
    }
  }
  system.elastic = discrete.zero();
  if (model.geometry().film) system.elastic = model.stiffness_of(kFilmRegion);
  if (with_mass) system.mass = model.mass();
  return system;
}

ViscoelasticPillar::ViscoelasticPillar(const PillarGeometry& geometry,
                                       const Discretisation& discretisation,
                                       const Material& material, TopCondition top,
                                       const std::optional<Medium>& film) {
  validate_solid(material);
  model_ = std::make_unique<PillarModel>(
      geometry, discretisation,
      PillarMedia{isotropic_medium(material.E0_Pa, material.nu, material.rho_kg_m3), film},
      ModelOptions{.rigid_top = top == TopCondition::kRigidPlate});
  system_ = viscoelastic_system(*model_, material, /*with_mass=*/false);
  const Eigen::VectorXd traction = model_->top_traction();
  top_area_m2_ = traction.sum();
  system_.load = traction / top_area_m2_;
}

}  // namespace viscard
