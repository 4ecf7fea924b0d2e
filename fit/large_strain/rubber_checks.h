#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "fit/large_strain/large_strain_result.h"

namespace viscard {

// Throws std::runtime_error for tests that cannot be fitted (fit_large_strain.h).
void check_large_strain(const std::vector<LargeStrainTest>& tests,
                        const LargeStrainOptions& options);

// Judges a fitted law; adds its flags and is_trustworthy. bounds: the parameters at the end of their range,
// and what holds them.
void add_rubber_flags(const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options,
                      bool is_converged, bool is_on_bound, const std::string& bounds,
                      FittedRubber& fitted);

std::vector<RubberTestSummary> summaries_of(const std::vector<LargeStrainTest>& tests,
                                            const FittedRubber& fitted);

// Sum of squared residuals and stresses, in Pa^2.
void add_residuals(const std::vector<LargeStrainTest>& tests, FittedRubber& fitted);

// Index of the law with the lowest BIC among those to be trusted, or of all if none is.
std::size_t best_law(const std::vector<FittedRubber>& laws);

// What the data cannot show by themselves.
std::vector<MaterialFlag> notes_of(const std::vector<LargeStrainTest>& tests);

}  // namespace viscard
