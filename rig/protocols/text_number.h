#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Numbers on the wire, whatever the locale. The whole of `text` but blanks around it must be the
// number; nan and inf are refused.
std::optional<double> number_from_text(std::string_view text);
std::optional<long long> integer_from_text(std::string_view text);
std::string text_from_number(double value, int decimals);

std::string_view trimmed(std::string_view text);
std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace viscard
