#pragma once

#include "io/cards/hyperelastic/rubber_card.h"
#include "io/materials/hyperelastic_file.h"

#include <string>

namespace viscard {

// The card of the law of a file, below lines about its origin, its limits and its bulk modulus. name
// stands for the file in messages. Throws what rubber_card() throws, and std::runtime_error for a law
// that is not to be trusted.
std::string rubber_file_card(const HyperelasticFile& file, const std::string& name,
                             const RubberCardOptions& options);

}  // namespace viscard
