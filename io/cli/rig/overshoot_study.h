#pragma once

#include <functional>
#include <vector>

namespace viscard {

// The force beyond a limit before the stage stands still, on the emulated rig with 80 readings/s. The emulated GRBL queues as the real one does: after a jog cancel six segments of at
// least 1.25 steps or 10 ms are still carried out, a reset stops at once
// (rig/emulator/emulated_motion.h). The specimen is an elastic half-space with E = 1.5 MPa and nu =
// 0.5 under a punch of 4.4 mm diameter, 8.8 N/mm; the limit is 1 N.
struct OvershootRow {
  double steps_per_m = 0.0;
  double acceleration_m_s2 = 0.0;
  double speed_m_s = 0.0;
  double gentle_N = 0.0;    // with a jog cancel alone
  double ladder_N = 0.0;    // as in a run: jog cancel, then reset if the force still rises
  double reset_N = 0.0;     // with a reset at the limit
  double expected_N = 0.0;  // for a jog cancel: stiffness x (speed x 1.5 periods + stop distance)
};

struct OvershootSpeeds {
  std::vector<double> speeds_m_s{0.1e-3, 0.5e-3, 1e-3, 2e-3};
  // steps per m and m/s2: a fine and quick drive, then the defaults of many controllers
  std::vector<std::pair<double, double>> drives{{3200e3, 0.2}, {250e3, 0.01}};
};

// Takes a fraction of a second per row; progress, a fraction of the whole, may be empty.
std::vector<OvershootRow> study_overshoot(const OvershootSpeeds& what,
                                          const std::function<void(double)>& progress = {});

}  // namespace viscard
