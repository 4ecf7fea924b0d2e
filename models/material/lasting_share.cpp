#include "models/material/lasting_share.h"

#include <cmath>

namespace viscard {

double lasting_share(double sum) {
  constexpr double kOfRounding = 1e-12;
  return std::abs(1.0 - sum) <= kOfRounding ? 0.0 : 1.0 - sum;
}

}  // namespace viscard
