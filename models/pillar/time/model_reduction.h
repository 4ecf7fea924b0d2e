#pragma once

#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace viscard {

// A body restricted to motions in the span of a few of its own solutions (Galerkin), so small that
// thousands of time steps or frequencies take little time. The restriction of symmetric positive
// matrices is symmetric and positive, so the small body is a viscoelastic body too and cannot gain
// energy with any basis. Source: Antoulas, Approximation of Large-Scale Dynamical Systems (2005),
// ch. 11 (rational Krylov spaces, moment matching).
struct ReducedBody {
  ViscoelasticSystem system;  // full lower triangles, basis.cols() unknowns
  Eigen::MatrixXd basis;      // unknowns x size, orthonormal in the instantaneous stiffness
  double error = 0.0;         // largest tested estimate, relative: of an output without inertia,
                              // of the energy norm with it
  double error_of_solutions = 0.0;  // without inertia: largest of a solution, in the energy norm
  double sound_up_to_rad_s = 0.0;   // dynamics: the highest tested frequency that met the tolerance

  // A load (force vector) or a linear output of the full body as one of the small body.
  Eigen::VectorXd load(const Eigen::VectorXd& full) const { return basis.transpose() * full; }
};

// What a reduction without inertia must get right: linear outputs of the body under system.load, as
// vectors times its unknowns. The motion along the load is always one of them.
struct QuasiStaticGoals {
  std::vector<Eigen::VectorXd> outputs;
  double tolerance = 1e-4;  // relative to each output
  // Bounds the energy norm of the error of each solution and dual solution too; derivatives of the
  // outputs by the matrices converge with these norms, the outputs themselves with their products.
  double of_solutions = std::numeric_limits<double>::infinity();
};

// Reduction without inertia, under system.load. The basis holds solutions at real Laplace variables
// s, K(s) u = load, and the dual solutions of the outputs, K(s) z = output. New ones are added where
// the error of an output is largest until it is below the tolerance for every tau. By Galerkin
// orthogonality that error is at most the product of the two residuals in the norm of K(s)^-1
// (Becker & Rannacher, Acta Numerica 10 (2001) 1). It is tested at twice as many s as solutions may be
// taken at. Outputs that cross zero are judged relative to a thousandth of their largest value.
// With constant Poisson ratio and no film the first solution is exact.
ReducedBody reduce_quasi_static(const ViscoelasticSystem& system, const QuasiStaticGoals& goals);

// A basis for bodies near this one, which then have their outputs to first order in the difference: the
// error of an output is at most the product of the primal and the dual residual, and both vanish at this
// body if the span holds the solutions and the dual ones. `solutions` are those of the outputs of the
// motion (output_of_motion()); the potentials that `outputs` cause as charges at rest are added.
Eigen::MatrixXd nearby_basis(const ViscoelasticSystem& system, const Eigen::MatrixXd& solutions,
                             const std::vector<Eigen::VectorXd>& outputs);

// The body restricted to the span of the columns of any basis.
ReducedBody restricted_to(const ViscoelasticSystem& system, Eigen::MatrixXd basis);

// An output as a vector that is zero at the potentials of a film and has the same value for every
// motion on which no charge acts from outside: potentials follow the motion. With it as a load the
// dual solution is such a motion too, and has a positive energy.
Eigen::VectorXd output_of_motion(const ViscoelasticSystem& system, const Eigen::VectorXd& output);

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
// frequencies so high that a basis for all frequencies up to them would be too large.
ReducedBody reduce_at(const ViscoelasticSystem& system, const std::vector<Eigen::VectorXd>& loads,
                      const std::vector<double>& omega_rad_s);

}  // namespace viscard
