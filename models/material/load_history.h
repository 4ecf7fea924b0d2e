#pragma once

#include "models/material/prony_series.h"

#include <vector>

namespace viscard {

// A test as the history of its input: the strain of a relaxation test, the stress of a creep test.
// The input is zero before the first corner and linear from corner to corner. Two corners at one
// time are a jump, and so is a first corner that is not zero.
struct LoadHistory {
  bool is_stress = false;
  std::vector<double> time_s, value;  // strain, or stress in Pa
};

// Throws std::invalid_argument if there is no corner, the columns differ in length, a value is not
// finite or time runs backwards.
void validate(const LoadHistory& history);

// Response at each corner, after its jump: the stress in Pa (eq. 5), or the strain if the input is
// a stress (eq. 33). Exact for any spacing of the corners. Throws what validate() throws.
std::vector<double> response(const PronySeries& series, const LoadHistory& history);

// The same history with additional corners at the given times; its course does not change. Times
// before the first corner are ignored, and so are times that are corners already.
LoadHistory with_corners_at(const LoadHistory& history, std::vector<double> time_s);

// One motion of the input to `target` within duration_s (0: a jump).
struct LoadStep {
  double duration_s = 0.0;
  double target = 0.0;  // strain, or stress in Pa
};
// The history from zero at t = 0. A motion from and to one value is a hold, whose corners are
// evenly spaced in the logarithm of the time since it began, from first_s on; other motions have
// evenly spaced corners. points: number of corners of each motion.
LoadHistory history_of_steps(bool is_stress, const std::vector<LoadStep>& steps, double first_s,
                             int points);

// For each corner, whether it depends only on the relaxation modulus between t_min_s and t_max_s.
// False if the input has changed by more than a twentieth of its largest value within the last
// t_min_s, or if loading (the first twentieth) began more than t_max_s ago.
std::vector<bool> is_within_window(const LoadHistory& history, double t_min_s, double t_max_s);

}  // namespace viscard
