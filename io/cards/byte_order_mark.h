#pragma once

#include "io/cards/card_target.h"
#include "io/cards/read_card.h"

#include <string>

namespace viscard {

// The text behind a byte order mark of UTF-8, or all of it.
std::string without_byte_order_mark(const std::string& text);

// What the mark does to a card of this target: "byte-order-mark". Solvers in Fortran take it for a part
// of the first keyword; readers of XML, JSON and Python skip it.
CardFinding byte_order_mark_finding(const CardTarget& target);

}  // namespace viscard
