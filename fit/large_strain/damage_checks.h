#pragma once

#include "fit/large_strain/hyperelastic_search.h"
#include "fit/large_strain/large_strain_result.h"

#include <Eigen/Core>

namespace viscard {

// Fills fitted.damage: constants with intervals, what is left on each kind of branch. covariance: of moduli,
// shapes, r, m and beta in Pa. Adds its flags: one-maximum (beta held at 0), held-at-zero (m or beta ended at
// 0), branch-misfit (above 10 % on unloading or reloading), and shallow-unloading (r is not determined),
// which makes the law untrustworthy.
void add_damage(const std::vector<LargeStrainTest>& tests, const FoundDamage& found,
                double stress_scale_Pa, const Eigen::MatrixXd& covariance, FittedRubber& fitted);

}  // namespace viscard
