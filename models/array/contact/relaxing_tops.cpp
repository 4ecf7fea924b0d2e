#include "models/array/contact/relaxing_tops.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

constexpr double kForceIsMet = 1e-9;  // relative

}  // namespace

RelaxingTops::RelaxingTops(const std::vector<TouchedPillar>& pillars,
                           std::vector<TopContact> classes, const RigidShape& shape,
                           std::size_t terms)
    : shape_(&shape), classes_(std::move(classes)) {
  for (const TouchedPillar& one : pillars) {
    Top top;
    top.contact = &classes_[static_cast<std::size_t>(one.of_class)];
    top.place = one;
    find_reach(top);
    top.branch_m.resize(terms);
    tops_.push_back(std::move(top));
  }
}

// A shape that moved by (x, y) reaches what it reached before at a pillar that stands at less by (x, y).
void RelaxingTops::find_reach(Top& top) const {
  const double x0_m = top.place.x_m - moved_x_m_, y0_m = top.place.y_m - moved_y_m_;
  TopContact::PointOverlap points = top.contact->overlaps([&](double x_m, double y_m) {
    return top.place.above_m - height_m(*shape_, x0_m + x_m, y0_m + y_m);
  });
  top.reach_m = std::move(points.overlap_m);
  top.softness_m_N = std::move(points.softness_m_N);
  top.largest_reach_m = top.reach_m.maxCoeff();
}

// Tops that are far out of reach need no search of their points.
void RelaxingTops::move_shape(double x_m, double y_m) {
  constexpr double kFar = 0.1;  // of a top's radius
  moved_x_m_ = x_m - shape_->x_m;
  moved_y_m_ = y_m - shape_->y_m;
  for (Top& top : tops_) {
    const double R_m = top.contact->radius_m();
    top.largest_reach_m = top.place.above_m - least_height_m(*shape_, top.place.x_m - moved_x_m_,
                                                             top.place.y_m - moved_y_m_, R_m);
    top.reach_m.resize(0, 0);
    if (top.is_touched || top.largest_reach_m + last_m_ > -kFar * R_m) find_reach(top);
  }
}

PressedArray RelaxingTops::to_depth(const RelaxationStep& step, double depth_m) {
  begin(step);
  PressedArray array = pressed_at(depth_m);
  accept(step);
  return array;
}

PressedArray RelaxingTops::with_force(const RelaxationStep& step, double force_N,
                                      double first_guess_m) {
  begin(step);
  const double rest_m = resting_m();
  PressedArray array;
  const auto force_at = [&](double depth_m) {
    array = pressed_at(depth_m);
    return array.force_N;
  };
  if (force_N > 0.0) {
    const double guess_m = is_first_ ? first_guess_m : last_m_;
    const double first_m = std::max(guess_m - rest_m, 1e-3 * std::abs(first_guess_m));
    depth_of_force(force_at, {rest_m, rest_m + first_m, force_N, kForceIsMet});
  } else {
    force_at(rest_m);
  }
  accept(step);
  return array;
}

// Forces at the end are K (now u + carried): the part of the branches that does not depend on u.
void RelaxingTops::begin(const RelaxationStep& step) {
  const double gained = step.all_gained();
  now_ = step.equilibrium + gained;
  for (Top& top : tops_) {
    if (!top.is_touched) continue;
    top.carried_m = -gained * top.motion_m;
    for (std::size_t i = 0; i < step.kept.size(); ++i) {
      top.carried_m += step.kept[i] * top.branch_m[i];
    }
  }
}

void RelaxingTops::press(Top& top, double depth_m) const {
  if (!top.is_touched && !(depth_m + top.largest_reach_m > 0.0)) {
    top.force_N.resize(0, 0);
    return;
  }
  if (top.reach_m.size() == 0) find_reach(top);
  Eigen::MatrixXd overlap_m = now_ * (top.reach_m.array() + depth_m).matrix();
  if (top.is_touched) overlap_m += top.carried_m;
  top.force_N = top.contact->pushing_forces(overlap_m, top.force_N, top.softness_m_N);
}

PressedArray RelaxingTops::pressed_at(double depth_m) {
  PressedArray array{.depth_m = depth_m};
  for (Top& top : tops_) {
    press(top, depth_m);
    array.add(top.force_N.size() > 0 ? top.contact->pressure_of(top.force_N) : TopPressure{});
  }
  last_m_ = depth_m;
  return array;
}

void RelaxingTops::accept(const RelaxationStep& step) {
  is_first_ = false;
  for (Top& top : tops_) {
    set_opening(top);
    if (top.force_N.size() == 0) continue;
    Eigen::MatrixXd motion_m = top.contact->motion(top.force_N);
    if (!top.is_touched) {
      top.motion_m = Eigen::MatrixXd::Zero(motion_m.rows(), motion_m.cols());
      top.carried_m = top.motion_m;
      for (Eigen::MatrixXd& branch : top.branch_m) branch = top.motion_m;
      top.is_touched = true;
    }
    motion_m = ((motion_m - top.carried_m) / now_).eval();
    for (std::size_t i = 0; i < step.kept.size(); ++i) {
      top.branch_m[i] = step.kept[i] * top.branch_m[i] + step.gained[i] * (motion_m - top.motion_m);
    }
    top.motion_m = std::move(motion_m);
  }
}

void RelaxingTops::set_opening(Top& top) const {
  const double overlap_m = reach_at_rest_m(top) + last_m_;
  top.touched_part =
      overlap_m > 0.0 && top.opening_m > 0.0 ? overlap_m / (overlap_m + top.opening_m) : 1.0;
  top.opening_m = std::max(-overlap_m, 0.0);
}

double RelaxingTops::reach_at_rest_m(const Top& top) const {
  return top.is_touched ? (top.reach_m + top.carried_m / now_).maxCoeff() : top.largest_reach_m;
}

double RelaxingTops::resting_m() const {
  double rest_m = std::numeric_limits<double>::infinity();
  for (const Top& top : tops_) rest_m = std::min(rest_m, -reach_at_rest_m(top));
  return rest_m;
}

}  // namespace viscard
