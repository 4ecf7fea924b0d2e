#pragma once

#include "models/material/material.h"

#include <vector>

namespace viscard {

// Times in s over which two materials are compared, logarithmic: the validity window, or if it is
// not stated two decades beyond the relaxation times.
std::vector<double> comparison_times_s(const Material& material, int count = 400);

// Largest |E(t)/E_reference(t) - 1| over the times, and the same of G(t).
double largest_E_difference(const Material& one, const Material& reference,
                            const std::vector<double>& times_s);
double largest_G_difference(const Material& one, const Material& reference,
                            const std::vector<double>& times_s);

}  // namespace viscard
