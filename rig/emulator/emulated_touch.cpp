#include "rig/emulator/emulated_touch.h"

#include "rig/emulator/seeded_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace viscard {
namespace {

// FNV-1a (Fowler, Noll & Vo), the same on every machine.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace

EmulatedTruth truth_of_touch(const EmulatedTruth& truth, const std::string& specimen_id,
                             int touch) {
  EmulatedTruth out = truth;
  const std::uint64_t seed = mixed_bits(truth.seed ^ hash_of(specimen_id));
  const auto number = static_cast<std::uint64_t>(touch);
  out.material.E0_Pa *= std::exp(truth.specimen_scatter * normal_deviate(seed, 0));
  out.contact_factor *= std::exp(truth.alignment_scatter * normal_deviate(seed, 2 * number));
  const double shift_m = truth.surface_scatter_m * normal_deviate(seed, 2 * number + 1);
  out.surface_position_m = std::max(0.0, truth.surface_position_m + shift_m);
  if (touch > 1) out.seed = mixed_bits(seed + number) >> 33;  // small enough for every file format
  return out;
}

}  // namespace viscard
