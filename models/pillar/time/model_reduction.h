#pragma once

#include "models/pillar/time/reduced_body.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Reduction without inertia, under system.load. The basis holds solutions at real Laplace variables
// s. New ones are added where the residual is largest until the energy norm of the error is below
// the tolerance for all relaxation times. With constant Poisson ratio and no film the first
// solution is exact.
ReducedBody reduce_quasi_static(const ViscoelasticSystem& system, double tolerance);

// Reduction with inertia, under any of the loads, from rest to the highest frequency. The basis
// holds Krylov vectors (K^-1 M)^j K^-1 load at the instantaneous moduli and, if shapes change as
// the material relaxes, solutions of the whole body. It grows until the residual at test
// frequencies shows that the energy norm of the error is below the tolerance. Basis vectors are
// real, so the same basis serves frequency and time.
struct DynamicRange {
  double lowest_rad_s = 0.0;
  double highest_rad_s = 0.0;
  double tolerance = 1e-4;
  double corner_rad_s = 0.0;         // above it (if > 0) the tolerance grows as omega^2
  double second_corner_rad_s = 0.0;  // and above this one (if > 0) as omega^3
  int largest_basis = 120;
};
ReducedBody reduce_dynamic(const ViscoelasticSystem& system,
                           const std::vector<Eigen::VectorXd>& loads, const DynamicRange& range);

// Reduction with inertia for a few frequencies only. The basis holds the solutions of the whole
// body there, by elimination, and the small body then reproduces them exactly. Use it for
// frequencies so high that a basis for all frequencies up to them would be too large. Throws
// std::invalid_argument for an incompressible body.
ReducedBody reduce_at(const ViscoelasticSystem& system, const std::vector<Eigen::VectorXd>& loads,
                      const std::vector<double>& omega_rad_s);

}  // namespace viscard
