#pragma once

#include "models/material/ratio_model.h"

#include <string>
#include <vector>

namespace viscard {

struct MixingOptions {
  // Offered to the comparison: E0 up to this degree, in these variables.
  int max_degree = 2;  // 2 needs at least four ratios
  std::vector<RatioVariable> variables{RatioVariable::kLogRatio, RatioVariable::kRatio,
                                       RatioVariable::kCrosslinkerShare};
  // What must be the same at all ratios, whatever the data say.
  bool share_E0 = false, share_g = false, share_times = false;
  std::vector<std::string> shared;  // single ones: "g_1", "tau_2" ...
};

// Law of a material in its mixing ratio from fitted specimens, each with its covariance and ratio
// (fit/README.md, sect. 8): theta_s = X(r_s) beta + u_s + e_s, u_s between specimens and e_s the
// error of each specimen's own fit, known. Forms are compared by BIC at maximum likelihood;
// coefficients and spreads of the best are those of restricted maximum likelihood. A multivariate
// meta-regression: van Houwelingen, Arends & Stijnen, Statistics in Medicine 21 (2002) 589.
//
// Throws std::invalid_argument: fewer than two ratios or three specimens, numbers of terms that
// differ, a specimen without ratio or covariance, a shared parameter of no term.
RatioFit fit_mixing_ratio(const std::vector<Material>& specimens,
                          const MixingOptions& options = {});

// One form alone. `restricted`: REML instead of maximum likelihood.
RatioModel fit_ratio_form(const std::vector<Material>& specimens, const RatioForm& form,
                          bool restricted = true);

}  // namespace viscard
