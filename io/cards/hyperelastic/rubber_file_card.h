#pragma once

#include "io/cards/hyperelastic/rubber_card.h"
#include "io/materials/hyperelastic_file.h"

#include <string>

namespace viscard {

// Throws std::invalid_argument for a bulk modulus below 2/3 of the shear modulus at rest: that Poisson
// ratio is negative, which no rubber has.
void refuse_bulk_modulus(const HyperelasticFile& file, const RubberCardOptions& options);
// Why a bulk modulus is doubtful for rubber: it is below ten times the shear modulus. Empty if it is not.
std::string doubtful_bulk_modulus(const HyperelasticFile& file, const RubberCardOptions& options);

// The card of the law of a file, below lines about its origin, its limits and its bulk modulus. name
// stands for the file in messages. Throws what rubber_card() and refuse_bulk_modulus() throw, and std::runtime_error for a law
// that is not to be trusted.
std::string rubber_file_card(const HyperelasticFile& file, const std::string& name,
                             const RubberCardOptions& options);

}  // namespace viscard
