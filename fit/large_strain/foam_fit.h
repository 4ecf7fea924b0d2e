#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "fit/large_strain/large_strain_result.h"

#include <vector>

namespace viscard {

// Fits foams of the numbers of terms of the options to all tests together. Laws of two and more terms have
// one nu for all of them, or one for each if BIC is lower by 2. Stresses count by the largest one of their
// test, lateral strains by theirs. Flags beside those of rubber: poisson-ratio-given, one-poisson-ratio (all
// terms have one). Throws std::runtime_error if neither lateral stretches nor a confined or volumetric test
// beside another one show nu and it is not given.
LargeStrainResult fit_foam(const std::vector<LargeStrainTest>& tests,
                           const LargeStrainOptions& options);

}  // namespace viscard
