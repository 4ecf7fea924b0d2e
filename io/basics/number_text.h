#pragma once

#include <string>
#include <string_view>

namespace viscard {

// Numbers and cells as files and solvers read them: ASCII, with a decimal point in every locale.

// A text as a cell of a CSV file: in quotes, with those inside doubled (RFC 4180).
std::string csv_cell(std::string_view text);

// Returns the shortest text that reads back as exactly this double.
std::string text_from_number(double value);

// As many digits as fit in `columns` characters, for free formats that silently cut longer numbers.
std::string number_within(double value, int columns);

// The text of at most `columns` characters that reads back nearest to value, for fixed columns: no
// leading zero (".00516"), no "+", no padding of the exponent. `columns` is 8 to 30.
std::string nearest_number(double value, int columns);

}  // namespace viscard
