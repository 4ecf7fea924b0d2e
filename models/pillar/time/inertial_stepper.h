#pragma once

#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <vector>

namespace viscard {

// Steps a small viscoelastic body with inertia (ReducedBody): trapezoidal (Newmark 1/4, 1/2) in the
// motion, the exact exponential recursion for displacement linear per step in the memory (eq. 24).
// Then, whatever the step, energy_J() changes over a step by the work of the load,
// (F0 + F1)/2 . (change of u), less a sum of squares: it never grows without work. Sources:
// Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67; Taylor, Pister & Goudreau, IJNME 2 (1970) 45.
class InertialStepper {
 public:
  // The body must outlive the stepper, be free of constraints and have mass.
  explicit InertialStepper(const ViscoelasticSystem& small);

  void set_step(double dt_s);  // factors anew only when the length changes
  void advance(const Eigen::VectorXd& force_at_start, const Eigen::VectorXd& force_at_end);

  const Eigen::VectorXd& displacement() const { return u_; }
  const Eigen::VectorXd& velocity() const { return v_; }
  // Kinetic, elastic and stored in the branches; a branch counts (x/2) coth(x/2) >= 1 times its
  // own, x = dt/tau, which tends to the energy itself for short steps.
  double energy_J() const;

 private:
  Eigen::VectorXd restoring(const Eigen::MatrixXd& memory) const;

  Eigen::MatrixXd lasting_;              // stiffness that does not relax
  std::vector<Eigen::MatrixXd> branch_;  // stiffness of each Maxwell branch
  std::vector<double> tau_s_;
  Eigen::MatrixXd mass_;
  double dt_s_ = 0.0;
  std::vector<double> decay_, weight_;  // exp(-x), phi_1(x)
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd u_, v_;
  Eigen::MatrixXd memory_;  // unknowns x branches
};

}  // namespace viscard
