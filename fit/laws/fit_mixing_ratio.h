#pragma once

#include "models/material/ratio_model.h"

#include <string>
#include <vector>

namespace viscard {

struct MixingOptions {
  // Candidate laws: E0 up to this degree, in these variables.
  int max_degree = 2;  // degree 2 needs at least four ratios
  std::vector<RatioVariable> variables{RatioVariable::kLogRatio, RatioVariable::kRatio,
                                       RatioVariable::kCrosslinkerShare};
  // Parameters forced to be the same at all ratios.
  bool share_E0 = false, share_g = false, share_times = false;
  std::vector<std::string> shared;  // single parameters: "g_1", "tau_2" ...
};

// Law of a material in its mixing ratio, from fitted specimens with their covariances and ratios
// (fit/laws/README.md, eq. 8.1): theta_s = X(r_s) beta + u_s + e_s, where u_s is the scatter
// between specimens and e_s the known error of each specimen's own fit. Forms are compared by BIC
// at maximum likelihood. The coefficients and spreads of the best form are restricted maximum
// likelihood (REML) estimates. A multivariate meta-regression: van Houwelingen, Arends & Stijnen,
// Statistics in Medicine 21 (2002) 589.
//
// Throws std::invalid_argument for fewer than two ratios or three specimens, numbers of terms that
// differ, a specimen without ratio or covariance, a shared parameter of a term that does not exist.
RatioFit fit_mixing_ratio(const std::vector<Material>& specimens,
                          const MixingOptions& options = {});

}  // namespace viscard
