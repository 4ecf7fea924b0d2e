#include "models/pillar/time/inertial_stepper.h"

#include "models/maths/dense.h"

#include <cmath>
#include <stdexcept>

namespace viscard {
InertialStepper::InertialStepper(const ViscoelasticSystem& small) {
  if (small.mass.size() == 0 || small.incompressible) {
    throw std::invalid_argument(
        "steps with inertia need masses and no constraint: reduce the body");
  }
  const Eigen::MatrixXd shear = dense(small.shear);
  const Eigen::MatrixXd bulk = dense(small.bulk);
  mass_ = dense(small.mass);
  lasting_ = dense(small.elastic) + shear + bulk;
  for (const MaterialTerm& term : small.terms) {
    const Eigen::MatrixXd stiffness = term.g * shear + term.k * bulk;
    lasting_ -= stiffness;
    branch_.push_back(stiffness);
    tau_s_.push_back(term.tau_s);
  }
  steps_.resize(tau_s_.size());
  const Eigen::Index n = mass_.rows();
  u_ = Eigen::VectorXd::Zero(n);
  v_ = Eigen::VectorXd::Zero(n);
  memory_ = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(branch_.size()));
}

void InertialStepper::set_step(double dt_s) {
  if (!(dt_s > 0.0) || !std::isfinite(dt_s)) {
    throw std::invalid_argument("a time step must be positive and finite");
  }
  if (std::abs(dt_s - dt_s_) <= 1e-12 * dt_s) return;
  dt_s_ = dt_s;
  Eigen::MatrixXd tangent = lasting_;
  for (std::size_t i = 0; i < branch_.size(); ++i) {
    steps_[i] = BranchStep(dt_s, tau_s_[i]);
    tangent += steps_[i].gain * branch_[i];
  }
  factor_ = Cholesky(2.0 / (dt_s * dt_s) * mass_ + 0.5 * tangent);
}

Eigen::VectorXd InertialStepper::restoring(const Eigen::MatrixXd& memory) const {
  Eigen::VectorXd force = lasting_ * u_;
  for (std::size_t i = 0; i < branch_.size(); ++i) {
    force += branch_[i] * memory.col(static_cast<Eigen::Index>(i));
  }
  return force;
}

void InertialStepper::advance(const Eigen::VectorXd& force_at_start,
                              const Eigen::VectorXd& force_at_end) {
  const Eigen::VectorXd at_start = restoring(memory_);
  for (std::size_t i = 0; i < branch_.size(); ++i) {
    memory_.col(static_cast<Eigen::Index>(i)) *= steps_[i].decay;
  }
  const Eigen::VectorXd carried = restoring(memory_);
  const Eigen::VectorXd impulse = 0.5 * (force_at_start + force_at_end) +
                                  2.0 / dt_s_ * (mass_ * v_) - 0.5 * (at_start + carried);
  const Eigen::VectorXd change = factor_.solve(impulse);
  u_ += change;
  v_ = 2.0 / dt_s_ * change - v_;
  for (std::size_t i = 0; i < branch_.size(); ++i) {
    memory_.col(static_cast<Eigen::Index>(i)) += steps_[i].gain * change;
  }
}

double InertialStepper::energy_J() const {
  double energy = 0.5 * v_.dot(mass_ * v_) + 0.5 * u_.dot(lasting_ * u_);
  for (std::size_t i = 0; i < branch_.size(); ++i) {
    const double half = 0.5 * dt_s_ / tau_s_[i];
    const double counted = half < 1e-8 ? 1.0 : half / std::tanh(half);
    const auto d = memory_.col(static_cast<Eigen::Index>(i));
    energy += 0.5 * counted * d.dot(branch_[i] * d);
  }
  return energy;
}

}  // namespace viscard
