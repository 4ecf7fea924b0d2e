#pragma once

#include "fit/laws/ratio_forms.h"
#include "models/material/ratio_model.h"

#include <vector>

namespace viscard {

// Law of a material in its mixing ratio, from fitted records with their covariances and ratios
// (fit/laws/README.md, eq. 8.1): theta_s = X(r_s) beta + u_s + e_s, where u_s is the scatter
// between specimens and e_s the error of the specimen: that of its own fit, and with repeated
// touches (records with the same specimen_id) also the scatter between touches. Forms are compared
// by BIC at maximum likelihood. The coefficients and spreads of the best form are restricted maximum
// likelihood (REML) estimates. A multivariate meta-regression: van Houwelingen, Arends & Stijnen,
// Statistics in Medicine 21 (2002) 589. RatioFit::scatter holds the three levels of scatter.
//
// Throws std::invalid_argument for fewer than two ratios or three specimens, numbers of terms that
// differ, a record without ratio or covariance, a shared parameter of a term that does not exist.
RatioFit fit_mixing_ratio(const std::vector<Material>& records, const MixingOptions& options = {});

}  // namespace viscard
