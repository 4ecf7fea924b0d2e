#pragma once

#include "io/cards/read_card.h"
#include "models/quantities/plausible.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A card compared with the material it is meant to be.
struct CardCheck {
  ReadCard read;
  std::string units = {};                  // of the card: stated in it, named by the user, else SI
  std::vector<CardFinding> findings = {};  // of the reader, and mistakes that explain a difference
  // Largest relative differences over the comparison times: of G(t), of E(t) with the reference
  // under the target's bulk rule, and of E(t) with the reference as it is. Absent without a
  // reference, or if the card describes no solid.
  std::optional<double> G_difference = {}, E_difference = {}, E_difference_with_bulk = {};
  double tolerance = 1e-6;  // limit of E_difference
  bool agrees = true;       // no mistake, and E_difference within the tolerance
};

struct CheckOptions {
  std::string units;  // empty: those that the card states, else SI
  // Of E(t), relative. Default: the larger of 1e-6 and the error that write_card makes when it
  // rounds the reference to the target's columns.
  std::optional<double> tolerance = {};
  std::optional<FrequencyBand> band = {};      // of a card that does not state its own
  Plausible plausible = Plausible::kMeasured;  // of a card alone; kOff accepts any number
};

// Throws where read_card does. Without a reference it reports only mistakes in the card itself,
// among them numbers that no solid has.
CardCheck check_card(const std::string& text, const CardTarget& target, const CheckOptions& options,
                     const Material* reference);

// The same for a target with CardTarget::values; its differences are of numbers, not of E(t).
CardCheck check_card_values(const std::string& text, const CardTarget& target,
                            const CheckOptions& options, const Material* reference);

// Explains a card that differs from the material it is meant to be. Applies each known mistake to
// the expected numbers, then each pair, and returns the one or two that reproduce the card:
// "tau-for-beta", "g-for-G", "plane-strain-modulus" ... Empty if none does.
std::vector<CardFinding> explain_difference(const ReadCard& read, const Material& reference);

}  // namespace viscard
