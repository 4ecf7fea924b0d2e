#pragma once

#include "models/material/material.h"
#include "models/material/series_directions.h"

#include <cstddef>
#include <vector>

namespace viscard {

// The systematic parts that the material states; if it states only their sum, one part that scales
// all moduli together.
std::vector<SystematicPart> systematic_parts_of(const MaterialUncertainty& uncertainty);

// The changes of E_inf, E_i and ln tau_i that a part makes: g_i = E_i/E0, so that
//   d ln E_i = d ln E0 + d ln g_i,  d E_inf = E_inf d ln E0 - sum E_i d ln g_i.
SeriesDirection direction_of(const PronySeries& series, const SystematicPart& part);

// Relative standard uncertainties due to all parts together. Terms are counted from 0.
double systematic_u_of_E0(const std::vector<SystematicPart>& parts);
double systematic_u_of_E_inf(const std::vector<SystematicPart>& parts, const PronySeries& series);
double systematic_u_of_modulus(const std::vector<SystematicPart>& parts, std::size_t term);  // E_i
double systematic_u_of_g(const std::vector<SystematicPart>& parts, std::size_t term);
double systematic_u_of_tau(const std::vector<SystematicPart>& parts, std::size_t term);

}  // namespace viscard
