#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"
#include "fit/joint_tests.h"

#include <Eigen/Core>

namespace viscard {

// Computes how far each test lies from the prediction of the others, and adds the defect
// tests-disagree if that distance is larger than chance and large enough to matter. If there are
// three or more tests, and one deviates while the others agree without it, only that one is marked.
//   freedom: degrees of freedom of the noise of each test.
void compare_tests(const JointTests& joint, const SpectralFit& fit, const Eigen::VectorXd& freedom,
                   FitResult& result);

}  // namespace viscard
