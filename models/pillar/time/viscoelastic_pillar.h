#pragma once

#include "models/material/material.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <memory>
#include <optional>

namespace viscard {

// Stiffness (and, with_mass, mass) of a model of a pillar of one viscoelastic material, in any
// family of motion, with or without film and electrodes; the film's part is elastic. The model must
// have been made with the instantaneous moduli of the material. The load is left empty. Throws
// std::invalid_argument for plane stress if shear and bulk moduli relax differently, because the
// condensed moduli are then no sum of the two.
ViscoelasticSystem viscoelastic_system(const PillarModel& model, const Material& material,
                                       bool with_mass);

// What loads the top of the pillar along its axis.
enum class TopCondition {
  kRigidPlate,  // a rigid frictionless plate: one displacement
  kPressure     // uniform pressure, free top: load.u is the mean displacement
};

// Longitudinal (m = 0) model of a pillar of one viscoelastic material, on a rigid base or an
// elastic film. Its load is 1 N along +z, so load.u is the top's (mean) axial displacement, m.
class ViscoelasticPillar {
 public:
  // `film` must be given if and only if the geometry has a film. Throws std::invalid_argument for a
  // bad geometry or material. Near nu = 0.5 (from 0.45) pressures are condensed, see volume_form().
  ViscoelasticPillar(const PillarGeometry& geometry, const Discretisation& discretisation,
                     const Material& material, TopCondition top,
                     const std::optional<Medium>& film = std::nullopt);

  const ViscoelasticSystem& system() const { return system_; }
  const PillarModel& model() const { return *model_; }
  double top_area_m2() const { return top_area_m2_; }

 private:
  std::unique_ptr<PillarModel> model_;
  ViscoelasticSystem system_;
  double top_area_m2_ = 0.0;
};

}  // namespace viscard
