#pragma once

#include "models/material/prony_series.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/load_history.h"
#include "models/scene/common/effect_estimate.h"
#include "models/scene/common/scene_answer.h"

#include <string>
#include <vector>

namespace viscard {

// What creep and relaxation share: a history without inertia.

// Throws SceneMistake for a history that is too short, does not start at 0 s or is zero throughout.
void check_quasi_static(const PillarScene& scene);

// Control::kForce: the history is the pressure on the top; Control::kDisplacement: its shortening.
void run_quasi_static(const PillarScene& scene, Control control, SceneAnswer& answer);

// Estimate of leaving relaxation out, from the modulus or compliance lost by the end of the history
// (eq. E3): the largest relative deviation from the elastic answer. `share_at` gives the relative
// loss of a Prony series at a time.
EffectEstimate relaxation_over_history(const PillarScene& scene,
                                       double (*share_at)(const PronySeries& series,
                                                          double time_s));

}  // namespace viscard
