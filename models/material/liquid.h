#pragma once

#include "models/material/material.h"

#include <string>

namespace viscard {

// True when the shares g add up to 1 within 1e-12: E_inf = 0. Its moduli can be predicted, but it
// has no equilibrium for a solver to start from.
bool is_liquid(const Material& material);

// Throws std::invalid_argument for a liquid. name: of the material or its file.
void refuse_liquid(const Material& material, const std::string& name);
// As validate(Material), and throws std::invalid_argument for a liquid.
void validate_solid(const Material& material);

}  // namespace viscard
