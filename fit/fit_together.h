#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/material_test.h"
#include "fit/samples/fit_data.h"

#include <vector>

namespace viscard {

// Fits one series to at least two tests of one material: relaxation, creep, oscillation and
// indentation. Each test is weighted by its own noise. A stiffness gets a free factor to the
// modulus; if no test measures moduli, the factor of the first test is one. Tests that differ by
// more than chance and by more than 0.5 % give the defect tests-disagree. Throws std::runtime_error
// for a test that cannot be used (captured run, master curve), and std::invalid_argument for
// options that only a single test can have.
FitResult fit_together(const std::vector<MaterialTest>& tests, const FitOptions& options);

}  // namespace viscard
