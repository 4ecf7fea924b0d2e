#pragma once

#include "io/flow/fit_file.h"

#include <iosfwd>
#include <vector>

namespace viscard {

// Prints the fit as text: moduli with intervals, the table of orders, flags.
void print_fit(const FittedFile& fitted, std::ostream& out);

// A line for each flag, "  ! NAME: TEXT". What several terms share is one line that names the other terms.
void print_flags(const std::vector<MaterialFlag>& flags, std::ostream& out);

}  // namespace viscard
