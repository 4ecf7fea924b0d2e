#pragma once

#include "models/array/plane/array_scene.h"
#include "models/scene/common/effect_estimate.h"

namespace viscard {

// What each effect is to a row of pillars: its estimate, and how a scene becomes one that never had
// it.

EffectEstimate relaxation_estimate(const ArrayScene& scene);
EffectEstimate inertia_estimate(const ArrayScene& scene);
EffectEstimate incompressibility_estimate(const ArrayScene& scene);
EffectEstimate film_compliance_estimate(const ArrayScene& scene);
void leave_out_film(ArrayScene& scene);
EffectEstimate piezo_coupling_estimate(const ArrayScene& scene);
void leave_out_piezo_coupling(ArrayScene& scene);
EffectEstimate leakage_estimate(const ArrayScene& scene);
EffectEstimate crosstalk_estimate(const ArrayScene& scene);
void leave_out_crosstalk(ArrayScene& scene);
EffectEstimate three_dimensional_estimate(const ArrayScene& scene);
EffectEstimate geometric_stiffness_estimate(const ArrayScene& scene);
EffectEstimate adhesion_estimate(const ArrayScene& scene);
EffectEstimate finite_strain_estimate(const ArrayScene& scene);
EffectEstimate contact_estimate(const ArrayScene& scene);

}  // namespace viscard
