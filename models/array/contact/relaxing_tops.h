#pragma once

#include "models/array/contact/press_array.h"

#include <Eigen/Core>

#include <cstddef>
#include <numeric>
#include <vector>

namespace viscard {

// A step of time of pillars that relax with one relative modulus e(t) = e_inf + sum g_i exp(-t/tau_i). A
// motion u that is linear in the step has branches b_i <- kept_i b_i + gained_i (u - u_0), and relaxes to
// e_inf u + sum b_i. A jump has kept_i = 1 and gained_i = g_i.
struct RelaxationStep {
  double equilibrium = 1.0;  // e_inf
  std::vector<double> kept, gained;
  double all_gained() const { return std::accumulate(gained.begin(), gained.end(), 0.0); }
};

// The tops of pillars that relax under a shape, step by step: contact may grow, shrink and come back.
// A top forgets nothing: where the shape leaves it, it goes on moving towards its rest (eq. T6).
class RelaxingTops {
 public:
  // Branches of all steps: `terms` of them. The shape must outlive the tops.
  RelaxingTops(const std::vector<TouchedPillar>& pillars, std::vector<TopContact> classes,
               const RigidShape& shape, std::size_t terms);

  // The end of the next step, by the depth of the shape or by its force. All steps are from rest on.
  PressedArray to_depth(const RelaxationStep& step, double depth_m);
  PressedArray with_force(const RelaxationStep& step, double force_N, double first_guess_m);

  // Where the point (x, y) of the shape is at the end of the steps that follow.
  void move_shape(double x_m, double y_m);
  // The part of the last step in which the shape touched a top that it touches at the end, with a
  // gap that is linear in time before it.
  double touched_part(std::size_t pillar) const { return tops_[pillar].touched_part; }

 private:
  struct Top {
    const TopContact* contact = nullptr;
    TouchedPillar place;
    Eigen::MatrixXd reach_m;  // of the surface at depth 0 below the top at rest, rings x angles
    Eigen::MatrixXd softness_m_N;  // of points that the surface covers in part, or empty
    double largest_reach_m = 0.0;  // at most; reach_m is empty if it is not needed
    double opening_m = 0.0;        // the least gap at the end of the last step
    double touched_part = 1.0;
    bool is_touched = false;  // in any step up to now; the rest is empty before
    Eigen::MatrixXd motion_m;
    std::vector<Eigen::MatrixXd> branch_m;
    // Of the step that is tried: forces are those of elastic tops under now * overlap + carried.
    Eigen::MatrixXd carried_m, force_N;
  };

  void find_reach(Top& top) const;
  void begin(const RelaxationStep& step);
  PressedArray pressed_at(double depth_m);
  void accept(const RelaxationStep& step);
  double resting_m() const;  // the depth at which the shape only just touches
  void press(Top& top, double depth_m) const;
  void set_opening(Top& top) const;
  // Of a top that the shape leaves alone in the step, which moves to -carried/now.
  double reach_at_rest_m(const Top& top) const;

  const RigidShape* shape_;
  double moved_x_m_ = 0.0, moved_y_m_ = 0.0;
  std::vector<TopContact> classes_;
  std::vector<Top> tops_;
  double now_ = 1.0;
  double last_m_ = 0.0;
  bool is_first_ = true;
};

}  // namespace viscard
