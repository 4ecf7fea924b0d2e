#pragma once

#include <string>

namespace viscard {

// A card states in its header the SHA-256 of its own text, without the digits of that sum and without
// carriage returns, so that an edit of anything else shows.

// "card sha256 000..." as it is written before the text of the card is known; sealed() puts the sum in.
std::string unsealed_sum_line();
// Replaces the sum of the first such line. A text without one stays as it is.
std::string sealed(const std::string& card);

// The sum that a card states, or "".
std::string stated_card_sum(const std::string& card);
// The sum of the text as it is.
std::string card_sum(const std::string& card);

}  // namespace viscard
