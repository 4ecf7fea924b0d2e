#pragma once

#include "io/cards/read_card.h"

#include <optional>
#include <string>

namespace viscard {

// A card by viscard, edited afterwards in a way that its reader does not see: a misspelt type, a
// repeated line, a keyword of another material. The first line that is not as viscard would write
// it for the same numbers is reported ("form-differs"). Empty for a card without viscard's header.

// `numbers` are those that were read, in the conventions of read.understood.
std::optional<CardFinding> form_difference(const std::string& text, const ReadCard& read);

// The same against the text that viscard writes for a material; for tables.
std::optional<CardFinding> form_difference(const std::string& text, const CardTarget& target,
                                           const Material& reference);

// The same against the text of a right card; for cards that state no whole material.
std::optional<CardFinding> form_difference(const std::string& text, const CardBody& right);

}  // namespace viscard
