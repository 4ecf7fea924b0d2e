#pragma once

#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/effect_estimate.h"

namespace viscard {

// What each effect is to one pillar: its estimate, and how a scene becomes one that never had it.

// Effects in the film and its electrodes (pillar_effects_film.cpp).
EffectEstimate film_compliance_estimate(const PillarScene& scene);
void leave_out_film(PillarScene& scene);
EffectEstimate piezo_coupling_estimate(const PillarScene& scene);
void leave_out_piezo_coupling(PillarScene& scene);
EffectEstimate leakage_estimate(const PillarScene& scene);
EffectEstimate crosstalk_estimate(const PillarScene& scene);

// Effects in time (pillar_effects_time.cpp).
EffectEstimate relaxation_estimate(const PillarScene& scene);
void leave_out_relaxation(PillarScene& scene);
EffectEstimate inertia_estimate(const PillarScene& scene);

// Effects of the body's shape and of large motion (pillar_effects_body.cpp).
EffectEstimate incompressibility_estimate(const PillarScene& scene);
void leave_out_incompressibility(PillarScene& scene);
void insist_on_incompressibility(PillarScene& scene);
EffectEstimate three_dimensional_estimate(const PillarScene& scene);
EffectEstimate geometric_stiffness_estimate(const PillarScene& scene);
void leave_out_geometric_stiffness(PillarScene& scene);
EffectEstimate adhesion_estimate(const PillarScene& scene);
EffectEstimate finite_strain_estimate(const PillarScene& scene);
EffectEstimate contact_estimate(const PillarScene& scene);

}  // namespace viscard
