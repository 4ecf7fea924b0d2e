#pragma once

#include "io/cards/read_card.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A card states in its header the SHA-256 of its own text, without the digits of that sum and without
// carriage returns, so that an edit of anything else shows.

// "card sha256 000..." as it is written before the text of the card is known; sealed() puts the sum in.
std::string unsealed_sum_line();
// Replaces the sum of the first line that begins with it. A text without one stays as it is.
std::string sealed(const std::string& card);

// The sum that a card states, or "".
std::string stated_card_sum(const std::string& card);
// The sum of the text as it is.
std::string card_sum(const std::string& card);
// True if the card states a sum that is not its own: a number or a word of it was changed since.
bool is_card_edited(const std::string& card);
// The note of what the sum shows: "card-edited", or "card-unchecked" of a card by viscard that states none, or
// nothing. is_compared: with a material, from which no number of the card differs; then a sum need not be stated.
std::optional<CardFinding> sum_finding(const std::string& card, bool is_compared);
bool has_edited_finding(const std::vector<CardFinding>& findings);

}  // namespace viscard
