#pragma once

#include "models/answer/effect_estimate.h"
#include "models/array/plane/array_scene.h"
#include "models/array/plane/row_contact.h"
#include "models/array/space/space_scene.h"
#include "models/pillar/scene/pillar_scene.h"

namespace viscard {

// The effects of each kind of scene: the estimate of leaving one out, and how a scene becomes one
// that never had it. Those of one line are in effects.cpp.

// One pillar: effects in the film and its electrodes, and of the body.
EffectEstimate film_compliance_estimate(const PillarScene& scene);
void leave_out_film(PillarScene& scene);
EffectEstimate piezo_coupling_estimate(const PillarScene& scene);
void leave_out_piezo_coupling(PillarScene& scene);
EffectEstimate relaxation_estimate(const PillarScene& scene);
EffectEstimate inertia_estimate(const PillarScene& scene);
EffectEstimate leakage_estimate(const PillarScene& scene);
EffectEstimate dielectric_loss_estimate(const PillarScene& scene);
EffectEstimate incompressibility_estimate(const PillarScene& scene);
EffectEstimate three_dimensional_estimate(const PillarScene& scene);
EffectEstimate geometric_stiffness_estimate(const PillarScene& scene);
void leave_out_geometric_stiffness(PillarScene& scene);
EffectEstimate finite_strain_estimate(const PillarScene& scene);
void leave_out_finite_strain(PillarScene& scene);

// Of a film that loses under a load whose slowest change is given; 0: it is at rest. `in_time`: loss_in_time().
EffectEstimate film_loss_estimate(const FilmLoss& loss, double slowest_rad_s, double in_time);
// By how much the error in time of a step or any other load may exceed that of a slow oscillation (eq. E16): behind a
// circuit what is lost rises and falls again.
inline double loss_in_time(bool oscillates, bool has_circuit) {
  if (oscillates) return 1.0;
  return has_circuit ? 2.0 : 1.1;
}

// What a scene stands in (surroundings_effects.cpp). The first takes two other estimates of the scene: whether its
// answer relaxes, and whether it vibrates.
EffectEstimate temperature_estimate(const SceneCommon& scene, const EffectEstimate& relaxation,
                                    const EffectEstimate& inertia);
void leave_out_temperature(SceneCommon& scene);
EffectEstimate thermal_strain_estimate(const PillarScene& scene);
void leave_out_thermal_strain(PillarScene& scene);
EffectEstimate weight_estimate(const PillarScene& scene);
EffectEstimate air_damping_estimate(const PillarScene& scene);

// Why pillars under a shape are less stiff than their answer.
constexpr const char* kTurned =
    "the pressure bends pillars further whose tops the shape turns; not in the error";

// What a scene declares that forces off the contact of a shape.
constexpr const char* kPrescribed =
    "off, the scene prescribes the motion of all tops, which are pulled, too; a shape that only "
    "pushes bears something else";

// Adhesion of neighbours whose length is `ratio` times the longest that parts again (row_effects.cpp).
EffectEstimate adhesion_at(double ratio);

// Of tops that are pulled with at most this share of the largest force (row_effects.cpp).
EffectEstimate pull_off_at(const ShapePress& press, double share);
template <typename Body>
void leave_out_pull_off(Body& scene) {
  if (scene.press) scene.press->work_of_adhesion_J_m2 = 0.0;
}

// Of pillars that bend under this share of their buckling pressure, the part `bent` of which grows with their moments
// (row_effects.cpp).
EffectEstimate stiffness_of_bent(double share, double bent, const char* reason);
// Of a shape that presses, by the elastic foundation (row_effects.cpp).
EffectEstimate contact_of(const ShapePress& press, const FoundationPress& pressed);

// A row of pillars (row_effects.cpp).
EffectEstimate film_compliance_estimate(const ArrayScene& scene);
EffectEstimate piezo_coupling_estimate(const ArrayScene& scene);
void leave_out_piezo_coupling(ArrayScene& scene);
EffectEstimate relaxation_estimate(const ArrayScene& scene);
EffectEstimate dielectric_loss_estimate(const ArrayScene& scene);
EffectEstimate inertia_estimate(const ArrayScene& scene);
EffectEstimate incompressibility_estimate(const ArrayScene& scene);
EffectEstimate crosstalk_estimate(const ArrayScene& scene);
EffectEstimate geometric_stiffness_estimate(const ArrayScene& scene);
EffectEstimate adhesion_estimate(const ArrayScene& scene);
EffectEstimate finite_strain_estimate(const ArrayScene& scene);
EffectEstimate contact_estimate(const ArrayScene& scene);
EffectEstimate pull_off_estimate(const ArrayScene& scene);

// An array in the plane (space_effects.cpp).
EffectEstimate film_compliance_estimate(const SpaceScene& scene);
EffectEstimate piezo_coupling_estimate(const SpaceScene& scene);
EffectEstimate relaxation_estimate(const SpaceScene& scene);
void leave_out_relaxation(SpaceScene& scene);
EffectEstimate leakage_estimate(const SpaceScene& scene);
EffectEstimate dielectric_loss_estimate(const SpaceScene& scene);
EffectEstimate incompressibility_estimate(const SpaceScene& scene);
EffectEstimate crosstalk_estimate(const SpaceScene& scene);
EffectEstimate geometric_stiffness_estimate(const SpaceScene& scene);
EffectEstimate adhesion_estimate(const SpaceScene& scene);
EffectEstimate finite_strain_estimate(const SpaceScene& scene);
EffectEstimate contact_estimate(const SpaceScene& scene);
EffectEstimate pull_off_estimate(const SpaceScene& scene);
EffectEstimate backing_estimate(const SpaceScene& scene);

}  // namespace viscard
