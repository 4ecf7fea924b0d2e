#pragma once

#include "io/cards/card_target.h"
#include "io/cards/unit_system.h"
#include "models/material/frequency_band.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The numbers as they stand in a card: in its unit system and by its target's conventions. A writer
// and a reader choose those that their target states. All algebra is in the two functions below.
struct CardBranch {
  double shear = 0.0;  // g_i, G_i or E_i      (CardTarget::branch)
  double bulk = 0.0;   // k_i or K_i; kOwnNumbers only
  double time = 0.0;   // tau_i, beta_i or A_i (CardTarget::time)
};

struct CardNumbers {
  double young = 0.0, poisson = 0.0;  // at CardTarget::at
  double bulk = 0.0, shear = 0.0;     // at CardTarget::at
  double equilibrium = 0.0;           // like CardBranch::shear, of the branch that never relaxes
  double density = 0.0;               // 0: not given
  std::vector<CardBranch> branches;
  // Temperatures are in C in all unit systems. Set only if the target takes the law.
  std::optional<TemperatureShift> shift;
};

// The same material under the bulk rule of the target: k_i kept, zero, or g_i.
Material with_bulk_rule(Material material, BulkRule rule);

CardNumbers numbers_from_material(const Material& material, const CardTarget& target,
                                  const UnitSystem& units);

// The inverse, in SI. Fills E0, nu, rho, terms and shift only. Throws std::invalid_argument when
// the numbers describe no solid (the long-term modulus or a time is not positive).
Material material_from_numbers(const CardNumbers& numbers, const CardTarget& target,
                               const UnitSystem& units);

// What a writer formats: all numbers are ready, so it does no algebra on the material.
struct CardBody {
  std::string name;  // an identifier that every code takes: letters, digits, underscores
  CardNumbers numbers;
  const CardTarget& target;
  const UnitSystem& units;
  const Material& material;  // SI, for targets that write tables of E(t)
  std::vector<std::string> header;
  // Of the rows of a table, or the two ends of the band; empty for a card without one.
  std::vector<double> frequencies_Hz = {};

  FrequencyBand band() const { return {frequencies_Hz.front(), frequencies_Hz.back()}; }
};

}  // namespace viscard
