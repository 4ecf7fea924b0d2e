#pragma once

#include "io/flow/large_strain/large_strain_files.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard fit` that belong to tests at large strain, as a user gives them.
struct LargeStrainWords {
  // Not given: the default.
  using Text = std::optional<std::string>;
  Text model, weight, youngs_modulus, cycle, sheet, plausible;
  std::vector<std::string> column;
  std::optional<int> terms, max_terms;  // of relaxation
};

// What to fit and how. Throws OptionError for a value that is not allowed.
LargeStrainRequest large_strain_request(const LargeStrainWords& words,
                                        std::vector<LargeStrainFile> files);

}  // namespace viscard
