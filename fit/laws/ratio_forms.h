#pragma once

#include "models/material/ratio_model.h"

#include <string>
#include <vector>

namespace viscard {

// Which laws in the mixing ratio are compared.
struct MixingOptions {
  // Candidate laws: E0 up to this degree, in these variables.
  int max_degree = 2;  // degree 2 needs at least four ratios
  std::vector<RatioVariable> variables{RatioVariable::kLogRatio, RatioVariable::kRatio,
                                       RatioVariable::kCrosslinkerShare};
  // Parameters forced to be the same at all ratios.
  bool share_E0 = false, share_g = false, share_times = false;
  std::vector<std::string> shared;  // single parameters: "g_1", "tau_2" ...
  // The number of terms may differ between ratios; then only E0 can follow a law.
  bool own_terms = false;
};

// Throws std::invalid_argument if the options share a parameter that does not exist, or terms that
// may differ in number.
void check_forms(const MixingOptions& options, int n_terms);

// All forms that these data can distinguish. The named ones come first, so that they win ties.
// shape: numbers of terms and ratios.
std::vector<RatioForm> forms_to_try(const RatioModel& shape, const MixingOptions& options);

// True if the form holds between the measured ratios too; with own_terms, if that of E0 does.
bool reaches_all_ratios(const RatioModel& shape, const RatioForm& form);

}  // namespace viscard
