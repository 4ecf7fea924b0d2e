#pragma once

#include <cmath>
#include <cstdint>

namespace viscard {

// SplitMix64: turns any number into 64 well-mixed bits (Steele, Lea & Flood, OOPSLA 2014).
inline std::uint64_t mixed_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// The normal deviate of mean 0 and variance 1 that belongs to (seed, index), so that the noise of a
// reading does not depend on scheduling. Box-Muller transform of bits from SplitMix64.
inline double normal_deviate(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t key = mixed_bits(seed) ^ (2 * index);
  constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
  const double u = (static_cast<double>(mixed_bits(key) >> 11) + 0.5) * kScale;
  const double v = static_cast<double>(mixed_bits(key + 1) >> 11) * kScale;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
}

}  // namespace viscard
