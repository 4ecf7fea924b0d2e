#pragma once

#include "models/material/material.h"
#include "models/quantities/plausible.h"

#include <string>
#include <vector>

namespace viscard {

// Throws std::runtime_error naming the file, the key, the number and its range if it is not plausible.
void refuse_implausible(const std::string& file, const std::string& key, const Quantity& quantity,
                        double value, Plausible judged);

// E0, nu, density and reference temperature of a material.
void refuse_implausible(const std::string& file, const Material& material, Plausible judged);

// True if the flags say that implausible numbers were accepted.
bool accepts_implausible(const std::vector<MaterialFlag>& flags);

// Adds that flag, if it is not there.
void flag_plausible_off(std::vector<MaterialFlag>& flags);

}  // namespace viscard
