#pragma once

#include <cstdint>

namespace viscard {

// The normal deviate of mean 0 and variance 1 that belongs to (seed, index), so that the noise of a
// reading does not depend on scheduling. Box-Muller transform of bits from SplitMix64 (Steele, Lea
// & Flood, OOPSLA 2014).
double normal_deviate(std::uint64_t seed, std::uint64_t index);

}  // namespace viscard
