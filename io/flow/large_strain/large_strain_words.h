#pragma once

#include "io/flow/large_strain/large_strain_files.h"
#include "io/flow/words/fit_words.h"
#include "io/options/option.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard fit` that belong to tests at large strain, as a user gives them.
struct LargeStrainWords {
  // Not given: the default.
  using Text = std::optional<std::string>;
  Text model, weight, youngs_modulus, cycle, plausible;
  TableChoice table;
  SpecimenSize size;
  std::vector<std::string> column;
  std::optional<int> terms, max_terms;  // of relaxation
  std::optional<double> poisson_ratio;  // of a foam
  bool unverified = false;
};

// Its options that tests at small strain do not have.
void add_large_strain_options(OptionList& list, LargeStrainWords& words);
// The words with the options that all kinds of test share.
LargeStrainWords with_shared_options(LargeStrainWords words, const FitWords& fit);

// What to fit and how. Throws OptionError for a value that is not allowed.
LargeStrainRequest large_strain_request(const LargeStrainWords& words,
                                        std::vector<LargeStrainFile> files);

}  // namespace viscard
