#pragma once

#include "io/config/config_fields.h"
#include "io/scenes/raw_drive.h"
#include "io/scenes/shape_section.h"
#include "models/array/space/space_scene.h"
#include "models/pillar/time/readout.h"

#include <string>

namespace viscard {

// How a shape presses on an array in time: analysis.kind = "relaxation" with a history of the depth, or
// "creep" with one of the force; [readout] as for single pillars.
void show_touch_history(FieldVisitor& analysis_table, const std::string& kind, RawDrive& drive);

// What [readout] wires to an electrode of a scene that has its film.
Readout readout_from(const RawDrive& raw, const SpaceScene& scene);

// Sets what a scene that has its shape and its noise does in time: with shape.path, or a history; nothing for kind =
// "static" without a path. Throws SceneMistake naming what is wrong.
void fill_touch(const std::string& kind, const RawDrive& raw, const RawShape& shape,
                SpaceScene& scene);

}  // namespace viscard
