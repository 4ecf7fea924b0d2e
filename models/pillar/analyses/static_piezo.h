#pragma once

#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/scene_answer.h"

namespace viscard {

// A static load along the axis of a pillar whose film has an electrode or a charge-free face: adds
// voltage, charge, capacitance and motion to the answer (eq. 19 to 25).
void run_static_piezo(const PillarScene& scene, SceneAnswer& answer);

}  // namespace viscard
