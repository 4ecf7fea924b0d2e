#pragma once

#include "io/scenes/raw_drive.h"
#include "models/array/plane/array_scene.h"
#include "models/pillar/scene/pillar_scene.h"

namespace viscard {

// Fill the drive of a scene, which stands at the default values of its analysis: every part that
// the drive has, whatever the analysis. Throw SceneMistake for a key that the analysis does not
// use, naming the analyses that do.
void fill_modes_and_top(const RawDrive& raw, PillarScene& scene);
void fill_drive(const RawDrive& raw, PillarScene& scene);
void fill_drive(const RawDrive& raw, ArrayScene& scene);  // all but the load

void fill_readout(const RawDrive& raw, PillarScene& scene);

}  // namespace viscard
