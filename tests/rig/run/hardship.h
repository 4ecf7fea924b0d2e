#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace viscard {

// What a run meets beside disturbed lines.
struct Hardship {
  bool is_format_learnt = false;
  double stiffer = 1.0;   // than the guess of the modulus
  std::string slows_in;   // the phase in which the cell's line slows down; empty: never
  double line_B_s = 0.0;  // from then on; the amplifier sends some 1350
};

inline Hardship hardship_of(std::uint64_t seed) {
  std::mt19937_64 random(seed + 7919);
  const auto chance = [&](double of) { return std::bernoulli_distribution(of)(random); };
  Hardship hardship;
  hardship.is_format_learnt = chance(0.5);
  if (chance(0.4)) hardship.stiffer = std::uniform_real_distribution<double>(1.0, 4.0)(random);
  if (!chance(0.4)) return hardship;
  const std::vector<std::string> phases = {"tare", "approach", "ramp", "hold", "unload"};
  hardship.slows_in = phases[random() % phases.size()];
  hardship.line_B_s = std::uniform_real_distribution<double>(200.0, 1500.0)(random);
  return hardship;
}

}  // namespace viscard
