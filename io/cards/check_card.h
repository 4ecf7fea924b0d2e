#pragma once

#include "io/cards/read_card.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A card against the material it is meant to be.
struct CardCheck {
  ReadCard read;
  std::vector<CardFinding> findings;  // of the reader, and the mistakes that explain a difference
  // Largest relative differences over the comparison times, absent without a reference or when the
  // card holds no solid: of G(t), of E(t) when the reference follows the target's bulk rule, and of
  // E(t) against the reference as it is.
  std::optional<double> G_difference, E_difference, E_difference_with_bulk;
  double tolerance = 1e-6;  // what E_difference was held against
  bool agrees = true;       // no mistake, and E_difference within the tolerance
};

struct CheckOptions {
  std::string target;
  std::string units;  // empty: what the card states, else SI
  // Of E(t), relative; without one, 1e-6 or what write_card's own rounding to the target's columns
  // makes of the reference, whichever is larger.
  std::optional<double> tolerance;
};

// Throws where read_card does. Without a reference only what is wrong in itself is found.
CardCheck check_card(const std::string& text, const CheckOptions& options,
                     const Material* reference);

// The mistakes (one, or two at once) that turn the reference into what the card says:
// "tau-for-beta", "g-for-G", "plane-strain-modulus" ... Empty when none does.
std::vector<CardFinding> explain_difference(const ReadCard& read, const Material& reference);

}  // namespace viscard
