#pragma once

#include "rig/protocols/gauge_protocol.h"

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Mark-10 series 4, 5 and 7. The query is "?" and CR. The answer is "-18.78 lbF" or, with the unit
// switched off in the gauge's menu, a number alone, to which `unit` applies. Answers such as "*10"
// are errors. Source: Mark-10 Series 4/5/7 user's guides, "Communications". Compression is positive
// unless the gauge's polarity was inverted. Throws RigError on an unknown unit.
GaugeProtocol mark10_protocol(const std::string& unit);
std::optional<GaugeAnswer> parse_mark10_reading(std::string_view line, const std::string& unit);

// Sauter FH and FL. The query is the byte "9". The answer is 7 ASCII bytes without terminator, such
// as "0011.70": the first is 0 in compression and 1 in tension, the rest is the absolute value. The
// unit is not sent. The parser returns compression as positive. Source: Sauter FH interface
// description. Throws RigError on an unknown unit.
GaugeProtocol sauter_protocol(const std::string& unit);
std::optional<GaugeAnswer> parse_sauter_reading(std::string_view bytes, const std::string& unit);

}  // namespace viscard
