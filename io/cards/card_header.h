#pragma once

#include "io/cards/card.h"
#include "io/cards/card_target.h"
#include "io/cards/unit_system.h"

#include <string>
#include <vector>

namespace viscard {

// The header of every card, one sentence a line, without comment signs: name, version and date,
// units, E0 and E_inf, conventions, bulk rule, origin of nu, validity, provenance with hashes, and
// how each item was written.
std::vector<std::string> card_header(const Material& material, const CardTarget& target,
                                     const UnitSystem& units, const CardOptions& options,
                                     const std::vector<FidelityItem>& fidelity);

// The lines in the comment syntax of the target, in ASCII and without "--" inside an XML comment.
std::string as_comments(const std::vector<std::string>& lines, const std::string& comment);

// "PDMS 1:10" -> "PDMS_1_10"; "MATERIAL" for an empty name.
std::string card_identifier(const std::string& name);

}  // namespace viscard
