#include "models/array/contact/sliding_top.h"

namespace viscard {

// Force = k (now u + carried).
struct SlidingTop::Linear {
  double now = 1.0;
  Eigen::Vector2d carried_m;
};

SlidingTop::SlidingTop(double stiffness_N_m, std::size_t terms)
    : stiffness_N_m_(stiffness_N_m), branch_m_(terms, Eigen::Vector2d::Zero()) {}

SlidingTop::Linear SlidingTop::begin(const RelaxationStep& step) const {
  const double gained = step.all_gained();
  Linear linear{step.equilibrium + gained, -gained * motion_m_};
  for (std::size_t i = 0; i < branch_m_.size(); ++i) {
    linear.carried_m += step.kept[i] * branch_m_[i];
  }
  return linear;
}

// The return map is one division, because the force is linear in the motion and alike in both directions.
void SlidingTop::drag(const RelaxationStep& step, const Eigen::Vector2d& way_m, double limit_N) {
  const Linear linear = begin(step);
  const Eigen::Vector2d stuck_m = motion_m_ + way_m;
  Eigen::Vector2d motion_m = stuck_m;
  force_N_ = stiffness_N_m_ * (linear.now * stuck_m + linear.carried_m);
  const double trial_N = force_N_.norm();
  slides_ = trial_N > limit_N;
  if (slides_) {
    force_N_ *= limit_N / trial_N;
    motion_m = (force_N_ / stiffness_N_m_ - linear.carried_m) / linear.now;
    slip_m_ += (stuck_m - motion_m).norm();
  }
  accept(step, motion_m);
}

void SlidingTop::leave(const RelaxationStep& step) {
  const Linear linear = begin(step);
  force_N_.setZero();
  slides_ = false;
  accept(step, -linear.carried_m / linear.now);
}

void SlidingTop::accept(const RelaxationStep& step, const Eigen::Vector2d& motion_m) {
  for (std::size_t i = 0; i < branch_m_.size(); ++i) {
    branch_m_[i] = step.kept[i] * branch_m_[i] + step.gained[i] * (motion_m - motion_m_);
  }
  motion_m_ = motion_m;
}

}  // namespace viscard
