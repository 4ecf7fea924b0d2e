#include "models/hyperelastic/law_stability.h"

#include <cmath>

namespace viscard {
namespace {

bool is_stable(const HyperelasticLaw& law, Deformation deformation, double log_stretch) {
  const Eigen::Vector3d log_strain = log_stretch * strain_direction(deformation);
  return is_within_limit(law, log_strain) && drucker_stiffness_Pa(law, log_strain) > 0.0;
}

// The end of the stable range between 1 and `last`, as a logarithm; is_open if there is none.
double end_of_range(const HyperelasticLaw& law, Deformation deformation, double last,
                    bool& is_open) {
  constexpr int kSteps = 400, kHalvings = 50;
  is_open = true;
  double good = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = last * i / kSteps;
    if (is_stable(law, deformation, at)) {
      good = at;
      continue;
    }
    is_open = false;
    double bad = at;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (good + bad);
      (is_stable(law, deformation, middle) ? good : bad) = middle;
    }
    return good;
  }
  return last;
}

}  // namespace

double drucker_stiffness_Pa(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain) {
  const Eigen::Matrix3d h = log_derivatives(law, log_strain).hessian;
  const double a = h(0, 0) - 2.0 * h(0, 2) + h(2, 2);
  const double b = h(0, 1) - h(0, 2) - h(1, 2) + h(2, 2);
  const double c = h(1, 1) - 2.0 * h(1, 2) + h(2, 2);
  const double largest = 0.5 * (a + c) + std::hypot(0.5 * (a - c), b);
  if (!(largest > 0.0)) return 0.5 * (a + c) - std::hypot(0.5 * (a - c), b);
  // The product of both is the determinant; their difference would lose the digits of the smaller. Of a
  // law whose energy is a sum over the stretches (Ogden) the matrix is diagonal, a = h1 + h3, b = h3 and
  // c = h2 + h3, and a c - b^2 would lose h1 h2 beside h3^2.
  const bool is_separable = h(0, 1) == 0.0 && h(0, 2) == 0.0 && h(1, 2) == 0.0;
  const double determinant =
      is_separable ? h(0, 0) * h(1, 1) + h(1, 1) * h(2, 2) + h(2, 2) * h(0, 0) : a * c - b * b;
  return determinant / largest;
}

StableRange stable_range(const HyperelasticLaw& law, Deformation deformation, double least,
                         double most) {
  StableRange range;
  range.low = std::exp(end_of_range(law, deformation, std::log(least), range.low_is_open));
  range.high = std::exp(end_of_range(law, deformation, std::log(most), range.high_is_open));
  return range;
}

}  // namespace viscard
