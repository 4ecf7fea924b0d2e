#pragma once

#include "io/cards/read_card.h"
#include "io/cards/unit_system.h"
#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/foam_law.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/hyperelastic/mullins_damage.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What two cards are compared by.
struct RubberParts {
  HyperelasticLaw law;
  std::vector<RubberTerm> terms;
  std::optional<double> bulk_Pa = {};  // 0: incompressible; none: not compared
  double density_kg_m3 = 0.0;          // 0: not compared
  double poisson = 0.0;                // of a card that states it for the bulk modulus; 0 else
  std::optional<MullinsDamage> damage = {};
  std::optional<FoamLaw> foam = {};  // stands in the place of the law
};

// Neo-Hooke and Mooney-Rivlin as the law of Ogden that they equal, for cards that have only that.
RubberParts in_form(RubberParts parts, HyperelasticForm wanted);

// Largest relative difference of a number; 1 if law or number of terms differ.
double largest_mismatch(const RubberParts& found, const RubberParts& expected);
double sum_of_shares(const std::vector<RubberTerm>& terms);

// The mistake whose numbers are the card's, or the numbers that differ.
std::vector<CardFinding> explained(const RubberParts& found, const RubberParts& expected,
                                   const std::string& target, const UnitSystem& units);

}  // namespace viscard
