#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "fit/large_strain/large_strain_result.h"

#include <vector>

namespace viscard {

// The largest number of terms to try: 0 for elastic laws. Adds a note if tests with times get none.
// Throws std::runtime_error if terms are asked for and a test has no times, or times that decrease.
int most_terms_of(const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options,
                  std::vector<MaterialFlag>& notes);

// True if the tests show relaxation apart from the law: a hold or an unloading in one of them, or mean
// rates of the stretch that differ by a factor of two or more.
bool has_several_rates(const std::vector<LargeStrainTest>& tests);

// Flags of the terms, with the limits and names of the linear fit (fit/intervals/README.md):
// tau-below-sampling, tau-below-ramp, tau-beyond-window, modulus-may-be-zero, terms-correlated (whose
// intervals then reach from 0 to their sum), fewer-terms; sum-of-g (the interval
// reaches 1: nothing may be left after all relaxation); step-before-record; one-rate, which makes the
// law untrustworthy, as a sum of g above 1 does.
void add_term_flags(const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options,
                    FittedRubber& fitted);

}  // namespace viscard
