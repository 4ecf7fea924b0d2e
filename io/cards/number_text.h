#pragma once

#include <string>

namespace viscard {

// Numbers as solvers read them, locale-free and ASCII, in a limited width. Without a limit, writers
// use fmt's "{}": the shortest text that reads back as exactly the same double.

// At most `columns` characters, with as many digits as fit, for free formats that silently cut
// longer numbers.
std::string number_within(double value, int columns);

// The text of at most `columns` characters that reads back nearest to value, for fixed columns: no
// leading zero (".00516"), no "+", no padding of the exponent. `columns` is 8 to 30.
std::string nearest_number(double value, int columns);

}  // namespace viscard
