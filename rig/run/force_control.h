#pragma once

#include <optional>

namespace viscard {

// How far a stage should step so that a force is held, apart from any device. After each step the
// mean force at rest is taken; the next step is a share of what closes the gap at the stiffness
// believed. That is an integral controller in discrete time: with a share s and a true stiffness
// r times the one believed the error shrinks by 1 - s r a step, so it is stable for s r < 2 and
// does not overshoot for s r <= 1. Where a step shows the contact to be stiffer than believed, the
// belief is raised at once; it is never lowered, which only makes it slower. Source: Astrom &
// Wittenmark, Computer-Controlled Systems, 3rd ed. (1997), ch. 3.
class ForceControl {
 public:
  struct Options {
    double target_N = 0.0;
    double stiffness_N_m = 0.0;   // of punch, specimen and frame in series, as believed
    double tolerance_N = 0.0;     // no step while the force is this near
    double largest_step_m = 0.0;  // of one step, whatever the gap
    double noise_N = 0.0;         // of one mean force
  };
  // Throws std::invalid_argument unless target, stiffness and largest step are positive.
  explicit ForceControl(const Options& options);

  // The step that should follow on this mean force; 0 to stay.
  double step_m(double force_N);

  double stiffness_N_m() const { return options_.stiffness_N_m; }

 private:
  Options options_;
  std::optional<double> last_force_N_;
  double last_step_m_ = 0.0;
};

}  // namespace viscard
