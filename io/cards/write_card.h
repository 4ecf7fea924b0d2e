#pragma once

#include "io/cards/card.h"
#include "io/cards/card_target.h"

namespace viscard {

// Writes the card in memory, reads it back and compares before returning it.
// Throws std::invalid_argument with one line that says what to do: unknown unit system, unphysical
// material, nu = 0.5 where K must be finite, too many terms, a stated bulk relaxation the target
// has no place for, flagged terms, numbers that do not fit the columns.
Card write_card(const Material& material, const CardTarget& target,
                const CardOptions& options = {});

}  // namespace viscard
