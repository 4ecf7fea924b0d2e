#pragma once

#include "rig/emulator/emulated_rig.h"
#include "rig/emulator/fault_proxy.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>

namespace viscard {

// Disturbances of the two lines of a rig.
struct LineFaults {
  FaultPlan stage, cell;
};

// The config of a rig; with faults, that of the proxies that are put before its ports.
inline RigConfig config_behind(EmulatedRig& emulated, const std::optional<LineFaults>& faults,
                               std::unique_ptr<FaultProxy>& stage,
                               std::unique_ptr<FaultProxy>& cell) {
  RigConfig config = emulated.config();
  if (!faults) return config;
  stage = std::make_unique<FaultProxy>(emulated, config.stage.port, faults->stage);
  cell = std::make_unique<FaultProxy>(emulated, config.load_cell.port, faults->cell);
  config.stage.port = stage->path();
  config.load_cell.port = cell->path();
  return config;
}

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

// Faults of a run, from its seed.
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

}  // namespace viscard
