#pragma once

#include "models/material/prony_series.h"
#include "models/maths/course.h"

#include <vector>

namespace viscard {

// A test as the course of its input: the strain of a relaxation test, the stress in Pa of a creep test. The input is
// zero before the first corner, and a first corner that is not zero is a jump. All functions here throw
// std::invalid_argument for a course without corners, a value that is not finite and a time that runs backwards.

// Response at each corner, after its jump: the stress in Pa (eq. 5), or the strain if the input is
// a stress (eq. 33). Exact for any spacing of the corners.
std::vector<double> response(const PronySeries& series, const Course& input, bool is_stress);

// The same course with additional corners at the given times. Times before the first corner are ignored, and so are
// times that are corners already.
Course with_corners_at(const Course& input, std::vector<double> time_s);

// One motion of the input to `target` within duration_s (0: a jump).
struct LoadStep {
  double duration_s = 0.0;
  double target = 0.0;  // strain, or stress in Pa
};
// The course from zero at t = 0. A motion from and to one value is a hold, whose corners are
// evenly spaced in the logarithm of the time since it began, from first_s on; other motions have
// evenly spaced corners. points: number of corners of each motion.
Course course_of_steps(const std::vector<LoadStep>& steps, double first_s, int points);

// For each corner, whether it depends only on the relaxation modulus between t_min_s and t_max_s.
// False if the input has changed by more than a twentieth of its largest value within the last
// t_min_s, or if loading (the first twentieth) began more than t_max_s ago.
std::vector<bool> is_within_window(const Course& input, double t_min_s, double t_max_s);

}  // namespace viscard
