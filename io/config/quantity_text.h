#pragma once

#include "models/uncertainty/uncertain_number.h"

#include <optional>
#include <string>

namespace viscard {

// The value in SI of a quantity in quotes, "40 um". A number without a unit is refused unless `unit` is
// "1", because the user may have meant any. Throws std::invalid_argument saying what is wrong.
double quantity_from_text(const std::string& text, const char* unit);

// An uncertain quantity, in SI: "40 um +- 1 um", "40 +- 1 um", "1.8 MPa +- 5 %", and with "normal"
// (the default), "uniform" or "lognormal" at the end. "±" may replace "+-". Nothing if the text has
// neither. Throws as above.
std::optional<UncertainNumber> uncertain_from_text(const std::string& text, const char* unit);

}  // namespace viscard
