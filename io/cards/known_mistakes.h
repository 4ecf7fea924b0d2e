#pragma once

#include "io/cards/card_numbers.h"
#include "io/cards/conventions.h"
#include "io/cards/unit_system.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// What a card should say: the reference material under the target's bulk rule.
struct CardContext {
  Material material;
  CardTarget target;
  UnitSystem units;

  CardNumbers as(const CardTarget& other) const {
    return numbers_from_material(material, other, units);
  }
};

// One way people get a card wrong, as a change of the right numbers.
struct CardMistake {
  std::string name;  // "tau-for-beta"
  std::string text;
  std::function<void(CardNumbers&)> plant;
};

// All that make sense for the target.
std::vector<CardMistake> known_mistakes(const CardContext& context);

}  // namespace viscard
