#pragma once

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// How far the force goes beyond a limit before the stage stands, on the emulated rig with GRBL's
// real queueing (six segments of at least 1.25 steps or 10 ms run on after a jog cancel; a reset
// stops at once: rig/emulator/emulated_motion.h), at the true speed of clock, host and 80
// readings/s. The specimen is the elastic half-space E = 1.5 MPa, nu = .5 under a punch of 4.4
// mm, 8.8 N/mm, and the limit 1 N.
struct OvershootRow {
  double steps_per_m = 0.0;
  double acceleration_m_s2 = 0.0;
  double speed_m_s = 0.0;
  double gentle_N = 0.0;    // jog cancel alone
  double ladder_N = 0.0;    // as a run does it: jog cancel, and reset if the force still rises
  double reset_N = 0.0;     // reset at the limit
  double expected_N = 0.0;  // of the jog cancel: stiffness x (speed x 1.5 periods + stop distance)
};

struct OvershootSpeeds {
  std::vector<double> speeds_m_s{0.1e-3, 0.5e-3, 1e-3, 2e-3};
  // steps per m, m/s2: fine and quick, then what controllers come with
  std::vector<std::pair<double, double>> drives{{3200e3, 0.2}, {250e3, 0.01}};
};

// Takes some seconds per row. progress may be empty.
std::vector<OvershootRow> study_overshoot(const OvershootSpeeds& what,
                                          const std::function<void(double)>& progress = {});

}  // namespace viscard
