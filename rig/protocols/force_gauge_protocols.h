#pragma once

#include "rig/protocols/gauge_protocol.h"

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Mark-10 series 4, 5 and 7: "?" and CR asks; "-18.78 lbF" or, with the unit switched off in its
// menu, a number alone (then `unit` counts). "*10" and the like is a refusal. Source: Mark-10
// Series 4/5/7 user's guides, "Communications". Compression is positive unless its polarity was
// inverted.
GaugeProtocol mark10_protocol(const std::string& unit);
std::optional<GaugeAnswer> parse_mark10_reading(std::string_view line, const std::string& unit);

// Sauter FH and FL: the byte "9" asks; 7 ASCII bytes answer without terminator, of which the first
// is 0 in compression and 1 in tension and the rest the amount: "0011.70". Its unit is not sent.
// Source: Sauter FH interface description. Made positive in compression here.
GaugeProtocol sauter_protocol(const std::string& unit);
std::optional<GaugeAnswer> parse_sauter_reading(std::string_view bytes, const std::string& unit);

}  // namespace viscard
