#pragma once

#include "fit/laws/nested_likelihood.h"
#include "fit/laws/ratio_estimates.h"
#include "models/material/ratio_model.h"
#include "models/material/scatter.h"

#include <string>
#include <vector>

namespace viscard {

// The three variance components of a nested random model with known errors of the records
// (fit/laws/README.md, eq. 8.2):
//   y = X(ratio) beta + a(ratio) + s(specimen) + t(touch) + e,
// by restricted maximum likelihood (Patterson & Thompson, Biometrika 58 (1971) 545), for any
// unbalanced design. With known errors this is the three-level meta-analysis of Konstantopoulos,
// Research Synthesis Methods 2 (2011) 61. 95 % intervals come from the profile of the restricted
// likelihood, with Bartlett's correction for the few degrees of freedom of each level. A level
// without degrees of freedom is reported as not identified, and the level above contains it.
//
// law: the law about which the ratios scatter; only its variable and its ratios are used, with a
// polynomial of this degree.
Scatter scatter_of(const std::string& quantity, const std::vector<NestedRecord>& records,
                   const RatioModel& law, int degree);

// The scatter of ln E0 and, if there are terms, of sum g.
std::vector<Scatter> scatter_levels(const std::vector<RatioEstimate>& records,
                                    const RatioModel& law);

}  // namespace viscard
