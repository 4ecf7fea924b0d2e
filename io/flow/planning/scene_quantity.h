#pragma once

#include "fit/planning/predicted_errors.h"

#include <string>
#include <vector>

namespace viscard {

// True for a parameter of the material, such as "E0" or "tau_3"; other names are results of a scene.
bool is_of_material(const std::string& name);

// Turns those wishes that are no parameters of the material into results of the scene: by their name,
// or "voltage" for the first result in V. Such a quantity is taken as a power law of E_inf, E_i and
// tau_i about the guess, whose exponents come from differences on one mesh. The guess replaces the
// material of the pillars; Poisson ratio and density stay. Throws what read_scene() throws, and
// std::invalid_argument for a result that the scene does not have.
void take_results_of_scene(const std::string& path, const Material& guess,
                           std::vector<WantedQuantity>& wanted);

}  // namespace viscard
