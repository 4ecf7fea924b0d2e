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
  Eigen::VectorXd output(const std::function<double(const Eigen::VectorXd&)>& linear) const;
  // A load (force vector) of the full body as a load of the small body.
  Eigen::VectorXd load(const Eigen::VectorXd& full) const { return basis.transpose() * full; }
};

}  // namespace viscard
