#pragma once

#include "io/cards/read_card.h"
#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/foam_law.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/hyperelastic/mullins_damage.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A law of rubber as a solver takes it from a card, in SI.
struct ReadRubber {
  HyperelasticLaw law;                       // at once
  std::optional<FoamLaw> foam = {};          // stands in its place
  std::vector<RubberTerm> terms;             // shares of the law at once
  std::optional<MullinsDamage> damage = {};  // by the first loading
  // The law that stands in the card is the one after all relaxation.
  bool is_long_term = false;
  double bulk_Pa = 0.0;        // 0: incompressible
  double poisson = 0.0;        // stands in the card for the bulk modulus; 0: it does not
  double density_kg_m3 = 0.0;  // 0: not in the card
  const UnitSystem* units = nullptr;
  bool units_were_stated = false;
  std::vector<CardFinding> findings;
};

// Name of the law of a card: "yeoh", "hyperfoam-2".
std::string name_of(const ReadRubber& read);

// True for a text with a law of rubber of any of them, or a card of rubber by viscard. A Mooney-Rivlin of
// FEBio alone is not: it may be the child of a linear card.
bool looks_like_rubber_card(const std::string& text);

// The target that the first lines of a card of rubber by viscard name, or "".
std::string stated_rubber_target(const std::string& text);

// Reads a card, by viscard or by hand. `units` names the unit system; empty: that of the header, else SI.
// Throws std::runtime_error naming what is missing, std::invalid_argument for another target.
ReadRubber read_rubber_card(const std::string& text, const std::string& target,
                            const std::string& units);

}  // namespace viscard
