#include "models/material/fit_defects.h"

#include <algorithm>
#include <array>

namespace viscard {

bool is_defect(const std::string& flag_name) {
  constexpr std::array kDefects{"not-converged", "saturated",        "gap-in-ramp", "contact-lost",
                                "E0-unknown",    "contradicts-data", "misfit"};
  return std::find(kDefects.begin(), kDefects.end(), flag_name) != kDefects.end();
}

}  // namespace viscard
