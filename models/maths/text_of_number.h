#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Numbers as text and text as numbers. Nothing here depends on the locale.

// A number for a message: "1e-14", "0.495", "nan". std::to_string prints the first as 0.000000.
std::string text_of(double value, int significant_digits = 6);

// A length: "12.5 um".
std::string micrometres(double value_m, int significant_digits = 6);

// As many digits as the standard error allows, two of its own: 18.76 +- 0.83 becomes "18.76", and
// 2.17e-3 with an error of 5e-4 becomes "0.00217". Six digits if the error is not positive.
std::string text_with_error(double value, double standard_error);

// "1 term", "2 terms".
std::string counted(std::size_t count, const std::string& one);

// Fixed notation, "-1.23457"; a value that rounds to zero has no minus sign, because some
// instruments cannot read "-0.000".
std::string text_from_number(double value, int decimals);

// The number in `text`, or nothing if anything but blanks is beside it. nan and inf are refused.
std::optional<double> number_from_text(std::string_view text);
std::optional<long long> integer_from_text(std::string_view text);

// `text` without blanks, line ends and NULs at either end.
std::string_view trimmed(std::string_view text);

// The parts between the separators; an empty text has one empty part.
std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace viscard
