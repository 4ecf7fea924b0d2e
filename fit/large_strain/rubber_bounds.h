#pragma once

#include "fit/large_strain/hyperelastic_search.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

// Indices of the parameters (moduli, shapes, then the g and ln tau or r, m and beta) that are not held where
// they ended: a modulus at zero with its shape, a shape or r at its bound.
std::vector<Eigen::Index> free_parameters(HyperelasticForm form, const LargeStrainRows& rows,
                                          const HyperelasticPoint& point);

// What binds, and by how much the sum of squares would fall with moduli of either sign.
std::string bound_text(HyperelasticForm form, const LargeStrainRows& rows,
                       const HyperelasticPoint& point, const std::vector<Eigen::Index>& free);

}  // namespace viscard
