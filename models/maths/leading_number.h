#pragma once

#include <string>
#include <string_view>

namespace viscard {

// Numbers in texts of others. Nothing here depends on the locale.

// The decimal number that `text` begins with, behind blanks and a sign, and what follows it in `rest`, as
// strtod reads it but with a point in every locale; 0 if it begins with none, `rest` is then `text`.
double leading_number(std::string_view text, std::string_view* rest = nullptr);

// As SCPI instruments print numbers: "+1.880E+00" with three decimals.
std::string scpi_text(double value, int decimals);

}  // namespace viscard
