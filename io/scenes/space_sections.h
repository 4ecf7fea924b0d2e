#pragma once

#include "io/scenes/scene_drive.h"
#include "io/scenes/scene_fields.h"
#include "io/scenes/scene_file.h"

#include <memory>
#include <string>

namespace viscard {

// Sections of an array in the plane.

void show_heat(FieldVisitor& v, SpaceScene& scene);
void show_noise(FieldVisitor& v, SpaceScene& scene);
void show_quadrants(FieldVisitor& v, SceneFile& file, SpaceScene& scene);

// How a shape presses on an array in time: analysis.kind = "relaxation" with a history of the depth, or "creep" with
// one of the force.
struct TouchKeys {
  std::string kind = "static";
  Pairs history;
  std::shared_ptr<ShapePath> path = std::make_shared<ShapePath>();  // shape.path, instead of both
};
std::shared_ptr<TouchKeys> show_touch(FieldVisitor& analysis_table, const SpaceScene& scene);
// [readout] of the touch or of [noise]. To be shown behind all that it acts on.
void show_reading(FieldVisitor& v, SpaceScene& scene, const std::shared_ptr<TouchKeys>& touch);

// The wanted names: "mean_voltage" is a map with its largest and smallest value, "mean_voltage_3_4" the pillar in row 3
// and column 4. Throws SceneMistake.
void check_space_wanted(const SpaceScene& scene);

}  // namespace viscard
