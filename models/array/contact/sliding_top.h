#pragma once

#include "models/array/contact/relaxing_tops.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// The top of a pillar that a surface drags along: it sticks until the force on it reaches Coulomb's limit,
// slides then, and may be left and touched again (eq. T12). The force is k times its motion relaxed, in
// both directions with the same moduli.
class SlidingTop {
 public:
  // The stiffness against a quick motion; branches of all steps: `terms` of them.
  SlidingTop(double stiffness_N_m, std::size_t terms);

  // The end of the next step, in which the surface on the top moved by (x, y); the limit is mu N at that end, infinite
  // where nothing slides.
  void drag(const RelaxationStep& step, const Eigen::Vector2d& way_m, double limit_N);
  // The end of a step in which nothing touches the top, which moves towards its rest.
  void leave(const RelaxationStep& step);

  const Eigen::Vector2d& force_N() const { return force_N_; }    // on the top
  const Eigen::Vector2d& motion_m() const { return motion_m_; }  // of the top over its foot
  double slip_m() const { return slip_m_; }  // way of the surface over the top, in all steps
  bool slides() const { return slides_; }    // in the last step

 private:
  struct Linear;  // of the force in the motion at the end of a step
  Linear begin(const RelaxationStep& step) const;
  void accept(const RelaxationStep& step, const Eigen::Vector2d& motion_m);

  double stiffness_N_m_;
  std::vector<Eigen::Vector2d> branch_m_;
  Eigen::Vector2d motion_m_ = Eigen::Vector2d::Zero(), force_N_ = Eigen::Vector2d::Zero();
  double slip_m_ = 0.0;
  bool slides_ = false;
};

}  // namespace viscard
