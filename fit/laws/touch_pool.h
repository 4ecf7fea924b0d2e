#pragma once

#include "fit/laws/ratio_estimates.h"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace viscard {

// Standard deviations of ln E0, of each ln g and of each ln tau.
using Spreads = std::array<double, 3>;

// Which of the three spreads row k of theta has: 0 ln E0, 1 ln g, 2 ln tau.
std::size_t kind_of_row(Eigen::Index k, Eigen::Index rows);

// Adds the squares of the spreads to the diagonal of a covariance of theta.
void add_spreads(const Spreads& spreads, Eigen::MatrixXd& covariance);

// The spread between touches on one specimen, by restricted maximum likelihood from the differences
// within specimens, which do not depend on the law. Zero if every specimen was touched once: the
// spread between specimens then contains it.
Spreads touch_spreads_of(const std::vector<RatioEstimate>& records);

// One estimate per specimen: the mean of its touches, each weighted by the inverse of the
// covariance of its own error and the touch spread. A single touch keeps its values.
std::vector<RatioEstimate> pooled_touches(const std::vector<RatioEstimate>& records,
                                          const Spreads& touch);

// The value of one spread at which f is largest: a scan of its logarithm and of zero, refined by
// golden section. f may have its maximum at zero.
double best_spread(const std::function<double(double spread)>& f);

}  // namespace viscard
