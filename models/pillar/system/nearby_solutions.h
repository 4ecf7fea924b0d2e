#pragma once

#include "models/pillar/system/stiffness_factor.h"

#include <vector>

namespace viscard {

// A factored matrix K0 and some of its solutions, from which those of a matrix K close to it follow:
// with u0 of K0 u0 = f0 and a load f close to f0,
//   u = u0 + K0^-1 (f - K u0),
// one step of iterative refinement. Its value at K = K0 and its derivatives,
//   u' = K0^-1 (f' - K' u0),
// are those of K^-1 f, so differences of it give the derivatives of the solution with no further
// factorisation. Source: Haftka & Gurdal, Elements of Structural Optimization (1992), 7.2.
struct NearbySolutions {
  StiffnessFactor factor;
  std::vector<Eigen::VectorXd> loads, solutions, sources;  // sources of the pressures

  // Solves for a load and keeps the solution.
  void add(const Eigen::VectorXd& load);
};

}  // namespace viscard
