#pragma once

#include "io/cards/card.h"
#include "io/cards/card_numbers.h"

#include <string>
#include <vector>

namespace viscard {

// What a writer formats: all numbers are ready, so it does no algebra on the material.
struct CardBody {
  std::string name;  // an identifier that every code takes: letters, digits, underscores
  CardNumbers numbers;
  const CardTarget& target;
  const UnitSystem& units;
  const Material& material;  // SI, for targets that write tables of E(t)
  std::vector<std::string> header;
};

}  // namespace viscard
