#pragma once

#include "models/hyperelastic/foam_law.h"

#include <array>
#include <initializer_list>

namespace viscard::test {

// A foam of terms {mu in MPa, alpha, nu}.
inline FoamLaw foam_of(std::initializer_list<std::array<double, 3>> terms) {
  FoamLaw law;
  const auto n = static_cast<Eigen::Index>(terms.size());
  law.mu_Pa.resize(n);
  law.alpha.resize(n);
  law.nu.resize(n);
  Eigen::Index i = 0;
  for (const auto& [mu_MPa, alpha, nu] : terms) {
    law.mu_Pa[i] = 1e6 * mu_MPa;
    law.alpha[i] = alpha;
    law.nu[i++] = nu;
  }
  return law;
}

}  // namespace viscard::test
