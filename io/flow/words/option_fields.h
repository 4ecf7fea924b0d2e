#pragma once

#include "io/flow/words/fit_words.h"
#include "io/flow/words/predict_words.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// The members of a struct of options by their names on the command line ("punch-diameter"), from which
// the command and the Python module fill it. The struct must outlive them.
struct OptionFields {
  std::vector<std::pair<const char*, std::optional<std::string>*>> texts;
  std::vector<std::pair<const char*, bool*>> flags;
  std::vector<std::pair<const char*, std::vector<std::string>*>> lists;
  std::vector<std::pair<const char*, std::optional<int>*>> whole_numbers;
};
// All options except "poisson-ratio" and "ratio", which are numbers.
OptionFields option_fields(FitWords& words);
// All options.
OptionFields option_fields(PredictWords& words);

}  // namespace viscard
