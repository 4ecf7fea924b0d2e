#pragma once

#include <cstdint>

namespace viscard {

// One normal deviate of mean 0 and variance 1 per (seed, index), so that no scheduling can change
// the noise of a reading: bits of SplitMix64 (Steele, Lea & Flood, OOPSLA 2014) through Box and
// Muller.
double normal_deviate(std::uint64_t seed, std::uint64_t index);

}  // namespace viscard
