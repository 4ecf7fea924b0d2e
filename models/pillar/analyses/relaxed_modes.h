#pragma once

#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/scene_answer.h"

namespace viscard {

// Replaces the frequencies of a modal answer, found with the instantaneous moduli, by those at
// which the storage modulus at the frequency itself carries the vibration:
//   f^2 = f_0^2 [E'(2 pi f)/E_0 - s]/(1 - s)   (eq. E8)
// with s = p/p_cr for lateral modes under a pressure and G' for torsion. Exact without film and
// load at constant Poisson ratio (correspondence principle: Christensen, Theory of Viscoelasticity
// (1982), ch. 2); otherwise a tenth of the change is added to the error.
void relax_modes(const PillarScene& scene, SceneAnswer& answer);

}  // namespace viscard
