#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"
#include "fit/joint_tests.h"

#include <Eigen/Core>

namespace viscard {

// Fills in how far each test lies from what the others allow, and adds the defect tests-disagree if
// that is more than chance and matters. Of three and more tests, one that lies off while the others
// agree without it is the only one that disagrees.
//   freedom: of the noise of each test.
void compare_tests(const JointTests& joint, const SpectralFit& fit, const Eigen::VectorXd& freedom,
                   FitResult& result);

}  // namespace viscard
