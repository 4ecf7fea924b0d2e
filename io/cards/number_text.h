#pragma once

#include <string>

namespace viscard {

// Numbers as solvers read them. All are locale-free and ASCII.

// The shortest text that reads back as exactly this double: "1.88", "9.65e-10".
std::string shortest_number(double value);

// At most `columns` characters, as many digits as fit, for free formats that cut longer numbers
// silently: Abaqus and CalculiX read 20 characters of a field and no more.
std::string number_within(double value, int columns);

// The text of at most `columns` characters that reads back nearest to value, for fixed columns: no
// leading zero (".00516"), no "+", no padding of the exponent. `columns` is 8 to 30.
std::string nearest_number(double value, int columns);

}  // namespace viscard
