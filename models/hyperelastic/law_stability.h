#pragma once

#include "models/hyperelastic/hyperelastic_law.h"

namespace viscard {

// Range of measured stretches about 1 in which a law is stable.
struct StableRange {
  double low = 0.0, high = 0.0;  // stretches
  // The law may hold beyond: the search ended there.
  bool low_is_open = false, high_is_open = false;
  // True for a stretch within the range.
  bool contains(double stretch) const {
    return (low_is_open || stretch >= low) && (high_is_open || stretch <= high);
  }
};

// Drucker's postulate for an incompressible body whose third principal stress is zero: for every
// change of the logarithmic strains, the change of the stresses does positive work. Its matrix is the
// second derivative of W by the first two logarithmic strains, the third being minus their sum. The
// range ends where its smaller eigenvalue reaches zero, or at the law's largest stretch. The search
// goes from 1 to `least` and `most` (0.1 and 10 are usual in finite-element codes).
StableRange stable_range(const HyperelasticLaw& law, Deformation deformation, double least = 0.1,
                         double most = 10.0);

// The smaller eigenvalue of that matrix, Pa.
double drucker_stiffness_Pa(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain);

}  // namespace viscard
