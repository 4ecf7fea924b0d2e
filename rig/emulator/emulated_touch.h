#pragma once

#include "models/experiment/emulated_specimen.h"

#include <string>

namespace viscard {

// The truth of one touch (from 1) on one specimen, if the truth lets specimens and touches scatter:
//   E0 x exp(specimen_scatter n),  contact_factor = exp(alignment_scatter n'),
//   surface_position_m + surface_scatter_m n''
// with normal deviates n that depend only on the seed and the specimen, n' and n'' also on the
// touch. Later touches have noise of their own. The first touch of a truth without scatter is the
// truth itself.
EmulatedTruth truth_of_touch(const EmulatedTruth& truth, const std::string& specimen_id, int touch);

}  // namespace viscard
