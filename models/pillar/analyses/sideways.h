#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/scene_answer.h"

#include <vector>

namespace viscard {

// A shear on the top along x, and a voltage on the opposite halves of quadrants.

// At rest: checks, results, the solution to be looked at.
void check_sideways(const PillarScene& scene);
void run_sideways(const PillarScene& scene, SceneAnswer& answer);
std::vector<SectionGrid> sideways_fields(const PillarScene& scene, const Discretisation& mesh);

// In time or frequency: checks, and whether an electrode in quadrants reads the load.
void check_sideways_in_time(const PillarScene& scene);
bool reads_quadrants(const PillarScene& scene);

}  // namespace viscard
