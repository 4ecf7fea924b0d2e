#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"

#include <cstdint>

namespace viscard {

// The rig of the demonstration: 250 gf cell behind .7255 V/N, frame spring 10 N/mm known to 2 %,
// GRBL stage of 3200 steps/mm, 80 readings/s. Ports are empty; EmulatedRig fills them in.
RigConfig demo_rig();

// PDMS of mixing ratio 10, 13 or 20 to 1 as an emulated specimen: modulus and Prony terms of the
// rig's publication (models/README.md), nu .495, layer 11 mm on a rigid base under a punch of 4.4
// mm; noise .02 % of full scale, drift .1 % of the force in 1000 s. The surface lies a seeded few
// um from 1 mm. Throws std::invalid_argument for another ratio.
EmulatedTruth demo_truth(double mixing_ratio, std::uint64_t seed);

// What a user would know of it: geometry, and a guess of the modulus.
Specimen demo_specimen(double mixing_ratio);

}  // namespace viscard
