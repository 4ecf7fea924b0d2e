#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"

#include <cstdint>

namespace viscard {

// The rig of the demonstration: a 250 gf cell with 0.7255 V/N, a frame of 10 N/mm known to 2 %, a
// GRBL stage with 3200 steps/mm, 80 readings/s. Ports are empty; EmulatedRig fills them in.
RigConfig demo_rig();

// PDMS of mixing ratio 10, 13 or 20 to 1 as an emulated specimen: modulus and Prony terms of the
// rig's publication (models/README.md), Poisson ratio 0.495, a layer of 11 mm on a rigid base under
// a punch of 4.4 mm diameter; noise 0.02 % of full scale, drift 0.1 % of the force in 1000 s. The
// surface lies up to 10 um beyond 1 mm, depending on the seed. Throws std::invalid_argument for
// another ratio.
EmulatedTruth demo_truth(double mixing_ratio, std::uint64_t seed);

// What a user would know of that specimen: its geometry and a guess of the modulus.
Specimen demo_specimen(double mixing_ratio);

}  // namespace viscard
