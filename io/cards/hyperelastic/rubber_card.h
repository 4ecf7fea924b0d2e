#pragma once

#include "models/hyperelastic/hyperelastic_law.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Solvers that a law of rubber is written for: abaqus, ansys, calculix, febio.
const std::vector<std::string>& rubber_card_targets();

struct RubberCardOptions {
  std::string target;
  std::string units = "SI";
  std::string material_name = "RUBBER";
  // None: incompressible for abaqus and ansys (their D or d = 0), and a thousand times the initial
  // shear modulus for the others, which need a number.
  std::optional<double> bulk_Pa;
};

// The card of a law. Each solver's convention, with its source, stands in rubber_card.cpp and in the
// README. Throws std::invalid_argument for a target without this law (gent in abaqus, calculix and
// febio), a bulk modulus that is not positive, and numbers that calculix would replace silently.
std::string rubber_card(const HyperelasticLaw& law, const RubberCardOptions& options);

}  // namespace viscard
