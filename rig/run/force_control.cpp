#include "rig/run/force_control.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

ForceControl::ForceControl(const Options& options) : options_(options) {
  if (!(options.target_N > 0.0) || !(options.stiffness_N_m > 0.0) ||
      !(options.largest_step_m > 0.0)) {
    throw std::invalid_argument("force control needs a positive force, stiffness and largest step");
  }
}

double ForceControl::step_m(double force_N) {
  constexpr double kShare = 0.7;
  // A response above this many standard deviations determines the stiffness.
  constexpr double kSureSigmas = 6.0;
  if (last_force_N_ && last_step_m_ != 0.0) {
    const double response_N = force_N - *last_force_N_;
    // Relaxation makes the response to a step toward the specimen too small and to a step away from
    // it too large, so only the former is a lower bound of the stiffness.
    if (last_step_m_ > 0.0 && response_N > kSureSigmas * options_.noise_N) {
      options_.stiffness_N_m = std::max(options_.stiffness_N_m, response_N / last_step_m_);
    }
  }
  last_force_N_ = force_N;
  const double gap_N = options_.target_N - force_N;
  last_step_m_ = std::abs(gap_N) <= options_.tolerance_N
                     ? 0.0
                     : std::clamp(kShare * gap_N / options_.stiffness_N_m, -options_.largest_step_m,
                                  options_.largest_step_m);
  return last_step_m_;
}

}  // namespace viscard
