#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/plane/array_scene.h"

#include <string>
#include <vector>

namespace viscard {

// Answers the scene as it stands on meshes of rising degree, as simulate_pillar() does for one
// pillar. Results of pillar i carry its number:
//   centre_voltage_i, mean_voltage_i        of a charge-free face
//   electrode_voltage_i, electrode_charge_i (shorted) of equipotential electrodes
//   midway_voltage_i                        between pillars i and i + 1
//   top_displacement_i
// and in per cent
//   coupling_percent_i          100 (V_midway/2)/V, V the mean at both loaded neighbours' centres
//   crosstalk_percent_i         mean or electrode voltage of an unloaded pillar over a loaded one's
//   crosstalk_centre_percent_i  the same of the centres
//   neighbours_percent_i        share of the other loaded pillars in the centre (electrode) voltage
//   deviation_percent_i         centre (electrode) voltage against that of a lone pillar on a wide
//                               film; only if wanted, because it needs a second model
// Harmonic and transient analyses give curves of each pillar's top displacement and voltage
// (array_transfer.h). Throws std::runtime_error if the finest mesh does not meet the tolerance.
SceneAnswer simulate_array(const ArrayScene& scene);

// The scene on one mesh, without mesh errors, and the meshes that simulate_array() goes through.
SceneAnswer array_answer_on(const ArrayScene& scene, const Discretisation& mesh);
std::vector<Discretisation> array_meshes(const ArrayScene& scene);

// Throws SceneMistake naming what is missing or contradictory.
void validate(const ArrayScene& scene);

// The results that a scene may ask for, without the pillars' numbers (simulate_array.h).
std::vector<std::string> result_names(const ArrayScene& scene);

}  // namespace viscard
