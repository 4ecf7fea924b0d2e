#pragma once

#include "tests/rig/rig_fixture.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace viscard {

// What happens to the lines and the specimen of one run, drawn from its seed.

inline FaultRates rates_from(std::mt19937_64& random) {
  std::uniform_real_distribution<double> exponent(-3.3, -1.5);
  const double rate = std::pow(10.0, exponent(random));
  const auto maybe = [&](double chance) {
    return std::bernoulli_distribution(chance)(random) ? rate : 0.0;
  };
  FaultRates rates;
  rates.drop = maybe(0.4);
  rates.duplicate = maybe(0.4);
  rates.split = maybe(0.4);
  rates.delay = maybe(0.4);
  rates.garble = maybe(0.4);
  rates.insert = maybe(0.3);
  rates.hang_up = 0.1 * maybe(0.15);
  return rates;
}

inline LineFaults faults_of(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  LineFaults faults;
  for (FaultPlan* plan : {&faults.stage, &faults.cell}) {
    plan->seed = random();
    if (std::bernoulli_distribution(0.7)(random)) plan->to_host = rates_from(random);
    if (std::bernoulli_distribution(0.5)(random)) plan->to_device = rates_from(random);
  }
  return faults;
}

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
