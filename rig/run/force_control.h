#pragma once

#include <optional>

namespace viscard {

// Computes the steps of a stage that hold a force; knows no device. After each step the caller
// takes the mean force at rest; the next step is a share s of what would close the gap at the
// assumed stiffness. This is an integral controller in discrete time: if the true stiffness is r
// times the assumed one, each step multiplies the error by 1 - s r, so the loop is stable for
// s r < 2 and does not overshoot for s r <= 1. If a step shows that the contact is stiffer than
// assumed, the assumed stiffness is raised at once. It is never lowered: a value that is too high
// only makes the loop slower. Source: Astrom & Wittenmark, Computer-Controlled Systems, 3rd ed.
// (1997), ch. 3.
class ForceControl {
 public:
  struct Options {
    double target_N = 0.0;
    double stiffness_N_m = 0.0;  // assumed, of punch, specimen and frame in series
    double tolerance_N = 0.0;    // no step while the error is within it
    double largest_step_m = 0.0;
    double noise_N = 0.0;  // standard deviation of one mean force
  };
  // Throws std::invalid_argument unless target, stiffness and largest step are positive.
  explicit ForceControl(const Options& options);

  // The step to make after this mean force; 0 to stay.
  double step_m(double force_N);

  double stiffness_N_m() const { return options_.stiffness_N_m; }

 private:
  Options options_;
  std::optional<double> last_force_N_;
  double last_step_m_ = 0.0;
};

}  // namespace viscard
