#pragma once

namespace viscard {

// How a rig performs, as earlier runs show it: [performance] of rig.toml. For the planning of tests
// only (fit/planning); no run depends on it. SI.
struct RigPerformance {
  double noise_N = 0.0;         // standard deviation of one reading at rest; 0: not known
  double gain_drift_1_s = 0.0;  // relative change of the load cell's gain per second, of any sign
  double step_m = 0.0;          // of the stage; 0: so fine that it does not show
  double acceleration_m_s2 = 0.2;  // of the stage
  double max_speed_m_s = 10e-3;    // of the stage
  double approach_s = 30.0;        // from the start of a run to contact
  double handling_s = 0.0;         // to put in a specimen and to take it out
};

}  // namespace viscard
