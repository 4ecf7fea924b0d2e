#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/layer/layer_scene.h"

#include <string>
#include <vector>

namespace viscard {

// Answers the scene as it stands, on grids of halved cells, until every result meets the tolerance:
//   contact_force  N, in a section N/m;  depth  m, of the point `at` below the face at rest
//   contact_area   m2, in a section contact_width in m: of the pressed cells; its error is not watched
//   largest_pressure  Pa, of a cell
//   centre_voltage_1, mean_voltage_1, quadrant_1_voltage_1, electrode_voltage_1: by electrode, from 1
// and curves along x through the middle of the contact: pressure_profile, voltage_profile.
// Errors: the change from grid to grid, plus those of LayerWaves and of the electrodes (eq. L6). Throws
// std::runtime_error with the worst result if the finest grid does not meet the tolerance.
SceneAnswer simulate_layer(const LayerScene& scene);

// The scene on the grid of this degree, without errors.
SceneAnswer layer_answer_on(const LayerScene& scene, const Discretisation& mesh);
// The grids that simulate_layer() goes through: `degree` d stands for 4 2^d cells along each axis, in a
// section for 32 2^d.
std::vector<Discretisation> layer_meshes(const LayerScene& scene);
int cells_across(const LayerScene& scene, const Discretisation& mesh);

std::vector<std::string> result_names(const LayerScene& scene);

// Largest strain of the layer, about, before anything is solved: depth over the smaller of the
// thickness and the half-width of the contact.
double layer_strain(const LayerScene& scene);

}  // namespace viscard
