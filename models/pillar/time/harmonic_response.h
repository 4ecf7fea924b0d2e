#pragma once

#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Steady oscillation u(t) = Re[u exp(i omega t)] of a viscoelastic body (eq. 22):
//   [elastic + G*(omega)/G_0 shear + K*(omega)/K_0 bulk - omega^2 M] u = load.
// Source: Christensen, Theory of Viscoelasticity (1982), ch. 2.

// Sparse elimination of the whole body, tens of ms per frequency: for few frequencies, and as a
// check. Throws std::runtime_error exactly on an undamped pole.
Eigen::VectorXcd solve_harmonic(const ViscoelasticSystem& body, const Eigen::VectorXd& load,
                                double omega_rad_s);
// The same for several loads with one elimination.
std::vector<Eigen::VectorXcd> solve_harmonics(const ViscoelasticSystem& body,
                                              const std::vector<Eigen::VectorXd>& loads,
                                              double omega_rad_s);

// Solves a small body (ReducedBody) by dense elimination, in microseconds per frequency.
class HarmonicSolver {
 public:
  explicit HarmonicSolver(const ViscoelasticSystem& small);
  // Each column of `loads` gives a solution, which is huge (or not finite) at an undamped pole.
  Eigen::MatrixXcd solve(double omega_rad_s, const Eigen::MatrixXcd& loads) const;

 private:
  std::vector<MaterialTerm> terms_;
  Eigen::MatrixXd elastic_, shear_, bulk_, mass_;
};

}  // namespace viscard
