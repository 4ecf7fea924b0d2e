#include "rig/emulator/normal_deviate.h"

#include <cmath>

namespace viscard {
namespace {

// SplitMix64: turns any number into 64 well-mixed bits (Steele, Lea & Flood, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

double normal_deviate(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t key = mixed(seed) ^ (2 * index);
  constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
  const double u = (static_cast<double>(mixed(key) >> 11) + 0.5) * kScale;
  const double v = static_cast<double>(mixed(key + 1) >> 11) * kScale;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
}

}  // namespace viscard
