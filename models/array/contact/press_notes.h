#pragma once

#include "models/array/contact/shape_press.h"

#include <cmath>
#include <string>
#include <vector>

namespace viscard {

// The pillar that uses the largest share of what is allowed for it.
struct AtLimit {
  std::string place;  // as people read it, "[2, 3]" of an array or "4" of a row
  double value = 0.0;
  double limit = HUGE_VAL;

  // Takes the place of this one if it uses a larger share.
  void consider(const std::string& other, double other_value, double other_limit) {
    if (std::isnan(other_value) || !(other_value / other_limit > value / limit)) return;
    *this = {other, other_value, other_limit};
  }
};

// What a pressed row or array has come to, as far as a linear answer of straight pillars leaves it out.
struct PressState {
  std::string body = "array";  // or "row"
  std::string force_unit = "N";
  bool touches = false;
  bool sticks = false;
  // Mean pressure on a top, Pa, over that at which the pillar buckles with a free top (of a shape that sticks: under
  // it); and the pressures at which that pillar buckles.
  AtLimit pressure;
  double free_Pa = HUGE_VAL, held_Pa = HUGE_VAL;  // with a free top; under the shape
  AtLimit shortening, stretch;                    // strains along the pillar
  AtLimit slope;                                  // of the shape over a touched top
  AtLimit sideways;                               // of a top, m, over half of the smallest gap
  AtLimit lean;                                   // of a dragged top, over the length
  AtLimit pull;                                   // over the pull-off force
  double work_J_m2 = 0.0;                         // behind that force
  bool adheres = false;
  int held = 0, let_go = 0;  // tops that adhesion pulls, and that have let go
};

// Largest strain and slope that a linear answer stands for.
constexpr double kLargestStrain = 0.05;
constexpr double kLargestSlope = 0.2;
// Largest lean of a dragged top over its foot, in lengths of the pillar.
constexpr double kLargestLean = 0.05;

// Sentences for the answer.
std::vector<std::string> press_notes(const PressState& state);

// A shape before anything is solved: what the elastic foundation of columns says of it.
struct PressPlan {
  double length_m = 0.0;    // of the longest pillar
  bool touches = true;      // a force can find a pillar
  double shortening = 0.0;  // of a pillar, over its length
  bool covers_all = true;   // there is a surface above every top
  bool feels_contact = true;
};
// Throw SceneMistake for a shape, without friction and adhesion, that makes no sense. The words are an example,
// "a force, such as force = \"5 mN\"".
void check_press_place(const ShapePress& press, const std::string& force_words, double length_m);
void check_press_plan(const ShapePress& press, const PressPlan& plan);
// The same for a shape that does not lie in the section of x and z.
void check_in_section(const RigidShape& shape);

}  // namespace viscard
