#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/plane/array_scene.h"
#include "models/array/plane/row_contact.h"

#include <string>
#include <vector>

namespace viscard {

// A row under a rigid shape (ArrayScene::press). Results of pillar i carry its number:
//   pillar_force_i, shear_force_i (friction), moment_i, contact_share_percent_i
//   centre_voltage_i, mean_voltage_i, electrode_voltage_i, electrode_charge_i, midway_voltage_i
// and of all: contact_force, contacts, depth, largest_pressure (mean over a top).
SceneAnswer simulate_pressed_row(const ArrayScene& scene,
                                 const std::vector<Discretisation>& meshes);
// On one mesh, without mesh errors; finer meshes have finer grids of the tops.
SceneAnswer pressed_row_on(const ArrayScene& scene, const Discretisation& mesh);

// Throws SceneMistake naming what is missing or contradictory in the shape.
void check_row_press(const ArrayScene& scene);

std::vector<std::string> pressed_row_names(const ArrayScene& scene);

// Remarks on what the answer leaves out: buckling, large strain, steep shapes, tops that meet.
std::vector<std::string> row_contact_notes(const ArrayScene& scene, const RowContact& contact);

}  // namespace viscard
