#pragma once

#include "io/cards/card_numbers.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// What a card should contain: the reference material under the target's bulk rule.
struct CardContext {
  Material material;
  CardTarget target;
  UnitSystem units;

  CardNumbers as(const CardTarget& other) const {
    return numbers_from_material(material, other, units);
  }
};

// A common mistake in cards, as a change of the right numbers.
struct CardMistake {
  std::string name;  // "tau-for-beta"
  std::string text;
  std::function<void(CardNumbers&)> plant;
};

// Those possible in a card of the target. Of equally good explanations the first is reported.
std::vector<CardMistake> known_mistakes(const CardContext& context);

}  // namespace viscard
