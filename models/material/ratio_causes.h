#pragma once

#include "models/material/material_causes.h"
#include "models/material/ratio_model.h"

namespace viscard {

// Causes of the uncertainty of a new specimen of material_at_ratio(): the error of the law, the
// scatter between specimens, and the systematic part. All deviations are widened so that their 95 %
// intervals of E0 are those of Student's t with the number of specimens. Throws as
// material_at_ratio() does.
MaterialCauses causes_at_ratio(const RatioFit& fit, double ratio);

}  // namespace viscard
