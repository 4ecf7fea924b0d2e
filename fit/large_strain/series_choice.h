#pragma once

#include "fit/large_strain/hyperelastic_search.h"
#include "fit/large_strain/large_strain_result.h"

#include <vector>

namespace viscard {

// The order of a path (rubber_series.h) by BIC, which counts n_effective readings. As in the linear fit an
// order with a time at the end of its range is not eligible, and one with a time above a third of the
// longest test is replaced by a smaller one unless BIC supports it by 6. Fills `orders`.
std::size_t choose_series(const std::vector<HyperelasticPoint>& path, const LargeStrainRows& rows,
                          double n_effective, std::vector<RubberOrder>& orders);

}  // namespace viscard
