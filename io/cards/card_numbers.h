#pragma once

#include "io/cards/card_target.h"
#include "io/cards/unit_system.h"
#include "models/hyperelastic/hyperelastic_law.h"
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

  // A law of rubber in the place of E and nu (models/hyperelastic): its moduli in the unit of stress,
  // its shapes without unit. `shear` is its modulus at rest, `bulk` 0 incompressible, branches are shares.
  HyperelasticForm form = HyperelasticForm::kNeoHooke;
  std::vector<double> moduli = {}, shapes = {};
  // A foam in the place of such a law (foam_law.h); mu in the unit of stress.
  struct FoamTerm {
    double mu = 0.0, alpha = 0.0, nu = 0.0;
    double beta() const { return nu / (1.0 - 2.0 * nu); }
  };
  std::vector<FoamTerm> foam = {};
  // Softening by the first loading (mullins_damage.h); m in the unit of stress.
  struct Damage {
    double r = 0.0, m = 0.0, beta = 0.0;
  };
  std::optional<Damage> damage = {};

  double d() const { return bulk > 0.0 ? 2.0 / bulk : 0.0; }  // 2/K; 0: incompressible
  // Share that is left after all relaxation.
  double long_term_share() const {
    double share = 1.0;
    for (const CardBranch& branch : branches) share -= branch.shear;
    return share;
  }
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
