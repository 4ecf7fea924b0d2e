#pragma once

#include "models/maths/branch_step.h"
#include "models/maths/dense.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Steps a small viscoelastic body with inertia (ReducedBody). The motion uses the trapezoidal rule
// (Newmark 1/4, 1/2), the memory the exact exponential recursion for displacement linear per step
// (eq. 24). For any step size, energy_J() changes over a step by the work of the load, (F0 + F1)/2
// . (change of u), less sum (x/4) (d_0 + d_1)' K_i (d_0 + d_1), x = dt/tau_i, so it never grows without
// work: with d_1 = e^-x d_0 + phi_1 du, (d_0 + d_1)(d_1 - e^-x d_0)/(2 phi_1) - c (d_1^2 - d_0^2)/2 is a
// square for c = (x/2) coth(x/2). Sources: Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67; Taylor, Pister
// & Goudreau, IJNME 2 (1970) 45.
class InertialStepper {
 public:
  // The body must outlive the stepper, have no constraints and have mass.
  explicit InertialStepper(const ViscoelasticSystem& small);

  void set_step(double dt_s);  // factors again only when the length changes
  void advance(const Eigen::VectorXd& force_at_start, const Eigen::VectorXd& force_at_end);

  const Eigen::VectorXd& displacement() const { return u_; }
  const Eigen::VectorXd& velocity() const { return v_; }
  // Kinetic energy, elastic energy and the energy stored in the branches. A branch counts (x/2)
  // coth(x/2) >= 1 times its own energy, x = dt/tau; the factor tends to 1 for short steps.
  double energy_J() const;

 private:
  Eigen::VectorXd restoring(const Eigen::MatrixXd& memory) const;

  Eigen::MatrixXd lasting_;              // stiffness that does not relax
  std::vector<Eigen::MatrixXd> branch_;  // stiffness of each Maxwell branch
  std::vector<double> tau_s_;
  Eigen::MatrixXd mass_;
  double dt_s_ = 0.0;
  std::vector<BranchStep> steps_;
  Cholesky factor_;
  Eigen::VectorXd u_, v_;
  Eigen::MatrixXd memory_;  // unknowns x branches
};

}  // namespace viscard
