#pragma once

#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// A body restricted to motions in the span of a few of its own solutions (Galerkin), so small that
// thousands of time steps or frequencies take little time. The restriction of symmetric positive
// matrices is symmetric and positive, so the small body is a viscoelastic body too and cannot gain
// energy with any basis. Source: Antoulas, Approximation of Large-Scale Dynamical Systems (2005),
// ch. 11 (rational Krylov spaces, moment matching).
struct ReducedBody {
  ViscoelasticSystem system;       // full lower triangles, basis.cols() unknowns
  Eigen::MatrixXd basis;           // unknowns x size, orthonormal in the instantaneous stiffness
  double error = 0.0;              // largest tested estimate, relative in the energy norm
  double sound_up_to_rad_s = 0.0;  // dynamics: the highest tested frequency that met the tolerance

  // A linear output of the full body as a vector for the small one.
  Eigen::VectorXd output(const std::function<double(const Eigen::VectorXd&)>& linear) const {
    Eigen::VectorXd values(basis.cols());
    for (Eigen::Index i = 0; i < basis.cols(); ++i) values[i] = linear(basis.col(i));
    return values;
  }
  // A load (force vector) of the full body as a load of the small body.
  Eigen::VectorXd load(const Eigen::VectorXd& full) const { return basis.transpose() * full; }
};

// Reduction without inertia, under system.load. The basis holds solutions at real Laplace variables
// s. New ones are added where the residual is largest until the error's energy norm is below the
// tolerance for every tau. With constant Poisson ratio and no film the first solution is exact.
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
