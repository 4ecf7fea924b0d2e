#pragma once

#include "io/cli/fit/fit_input.h"

#include <nlohmann/json_fwd.hpp>

#include <ostream>

namespace viscard {

// The object that `viscard fit --json` prints; keys as in FitResult, units in the name. Numbers
// that are not finite become null.
nlohmann::ordered_json json_from_fit(const FittedFile& fitted);

// The same for a person: moduli with intervals, the table of orders, flags.
void print_fit(const FittedFile& fitted, std::ostream& out);

}  // namespace viscard
