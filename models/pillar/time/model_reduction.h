#pragma once

#include "models/pillar/time/reduced_body.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Without inertia, under system.load: answers at real Laplace variables s, added where the residual
// is largest until the energy norm of the error is below the tolerance for all relaxation times.
// With constant Poisson ratio and no film the first is exact.
ReducedBody reduce_quasi_static(const ViscoelasticSystem& system, double tolerance);

// With inertia, under any of the loads, from rest to the highest frequency: Krylov vectors
// (K^-1 M)^j K^-1 load at the instantaneous moduli and, where shapes change as the material
// relaxes, answers of the whole body, until the residual at test frequencies says that the energy
// norm of the error is below the tolerance. Basis vectors are real, so the same basis serves
// frequency and time.
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

// With inertia, at a few frequencies only: the answers of the whole body there, by elimination,
// which the small body then returns exactly. For frequencies so high that a basis for all up to
// them would be too large. Throws std::invalid_argument for an incompressible body.
ReducedBody reduce_at(const ViscoelasticSystem& system, const std::vector<Eigen::VectorXd>& loads,
                      const std::vector<double>& omega_rad_s);

}  // namespace viscard
