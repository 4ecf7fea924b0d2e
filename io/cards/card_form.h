#pragma once

#include "io/cards/read_card.h"

#include <optional>
#include <string>
#include <vector>

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

// Lines of a header by this version of viscard that contradict the card or the material: the target,
// units, conventions and moduli, and with a reference its conditions (validity, temperature,
// intervals, flags) and what was approximated ("header-differs", a mistake). A line that is missing
// is a note ("header-incomplete"). `target` is that of the reader, before the text changed it.
std::vector<CardFinding> header_differences(const std::string& text, const ReadCard& read,
                                            const CardTarget& target, const Material* reference);

}  // namespace viscard
