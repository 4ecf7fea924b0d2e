#pragma once

#include "models/material/prony_series.h"
#include "models/maths/branch_step.h"
#include "models/maths/course.h"

namespace viscard {

// How deep the surface stood before the contact that is fitted: pressed by an earlier touch, then recovering
// without force. The relaxation that the touch began goes on in the fitted contact, which meets the surface
// where it then stands. Depths count from the contact position.

// The surface under a punch, whose depth is below 0 out of contact. Empty if it never touches. The scale of the series
// does not matter.
Course earlier_touch(const Course& punch_m, const PronySeries& series);

// State of a branch that the touch has left at a time.
BranchState left_by(const Course& touch, double time_s, double tau_s);

// Largest difference of two courses over the deepest point of both.
double relative_change(const Course& a, const Course& b);
inline constexpr double kSameTouch =
    1e-3;  // of it: what such a change does to a modulus is beyond any reading

}  // namespace viscard
