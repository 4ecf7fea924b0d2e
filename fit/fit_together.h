#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/material_test.h"
#include "fit/samples/fit_data.h"

#include <vector>

namespace viscard {

// Fits one series to several tests of one material: relaxation, creep, oscillation and indentation, at
// least two. Each test counts by its own noise. Stiffnesses get a free factor to the moduli; if no
// test has moduli, the first one's is one. Tests that differ by more than chance and 0.5 % give the
// defect tests-disagree. Throws std::runtime_error for a test that cannot be used (captured run,
// master curve), std::invalid_argument for options that one test alone can have.
FitResult fit_together(const std::vector<MaterialTest>& tests, const FitOptions& options);

}  // namespace viscard
