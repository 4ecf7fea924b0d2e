#pragma once

#include "models/array/contact/rigid_shape.h"

#include <vector>

namespace viscard {

// Between shape and tops.
enum class Friction {
  kNone,
  kStick,   // what touches does not slide
  kCoulomb  // of a shape that moves: tops stick until their shear reaches a share of their force
};

// A rigid shape that presses on the tops: its point (x, y) to a depth below the tops of the usual
// pillars, or with a force (of a section in the plane, per metre across it). The other one is 0.
struct ShapePress {
  RigidShape shape;
  double depth_m = 0.0;
  double force_N = 0.0;
  Friction friction = Friction::kNone;
  double friction_coefficient = 0.0;   // of kCoulomb; infinite: tops never slide
  double work_of_adhesion_J_m2 = 0.0;  // between shape and tops; 0: tops are not held
  std::vector<double> before_m;        // depths that the shape went through before, in turn
};

// The depths in turn, the last one that at which the answer is asked for.
inline std::vector<double> path_of(const ShapePress& press) {
  std::vector<double> path = press.before_m;
  path.push_back(press.depth_m);
  return path;
}

// Throws SceneMistake for a work of adhesion or depths gone through that make no sense, or beside a force.
void check_adhesion(const ShapePress& press);

}  // namespace viscard
