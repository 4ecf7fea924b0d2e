#pragma once

#include "io/flow/fit_file.h"

#include <nlohmann/json_fwd.hpp>

#include <ostream>

namespace viscard {

// The object that `viscard fit --json` prints; its keys are those of FitResult with the unit in the
// name. Numbers that are not finite become null.
nlohmann::ordered_json json_from_fit(const FittedFile& fitted);

// Prints the fit as text: moduli with intervals, the table of orders, flags.
void print_fit(const FittedFile& fitted, std::ostream& out);

}  // namespace viscard
