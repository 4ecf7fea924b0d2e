#pragma once

#include "io/flow/fit_file.h"

#include <iosfwd>

namespace viscard {

// Prints the fit as text: moduli with intervals, the table of orders, flags.
void print_fit(const FittedFile& fitted, std::ostream& out);

}  // namespace viscard
