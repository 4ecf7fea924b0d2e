#pragma once

#include "io/cards/card_numbers.h"

#include <string>

namespace viscard {

struct ReadCard;

// Laws of rubber and foams in the keywords that Abaqus and CalculiX share.
LawKeywords keyword_laws();
// Their energy of the volume, with the name of the constant.
std::string keyword_law_volume(const std::string& d);

std::string write_keyword_law(const CardBody& body, bool is_calculix);
void read_keyword_law(const std::string& text, bool is_calculix, ReadCard& card);

}  // namespace viscard
