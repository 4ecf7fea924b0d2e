#pragma once

#include "fit/intervals/fit_result.h"
#include "models/contact/punch_contact.h"

#include <optional>
#include <vector>

namespace viscard {

// Modulus from the slope of the loading curve between a fifth and nine tenths of the depth:
//   E = (P_2 - P_1)/(h_2 - h_1) (1 - nu^2)/(2 a kappa)
// Each point is the mean of the readings within two hundredths of the depth around it. Source of
// the method: Sneddon's flat punch, P = 2 a E h/(1 - nu^2), Int. J. Eng. Sci. 3 (1965) 47. time_s,
// force_N, depth_m: the loading part, ascending depth. Returns nothing for fewer than 6 samples.
std::optional<TwoPointModulus> two_point_modulus(const std::vector<double>& time_s,
                                                 const std::vector<double>& force_N,
                                                 const std::vector<double>& depth_m,
                                                 const PunchContact& contact, double sigma_N);

}  // namespace viscard
