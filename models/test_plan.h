#pragma once

#include <string>

namespace viscard {

// What test.toml says (data/demo/02_test.toml is the commented example): one stress-relaxation
// indentation. SI.
struct TestPlan {
  std::string name;
  // approach
  double approach_speed_m_s = 0.05e-3;
  double approach_limit_m = 5e-3;  // give up if nothing is touched within this way
  double contact_force_N = 0.01;   // force above the baseline that counts as touched
  double gap_m = 20e-6;            // backed off to this distance from contact before the ramp
  double baseline_s = 10.0;        // recorded out of contact before the ramp, and after retract
  // ramp and hold
  double depth_m = 0.13e-3;  // indentation of the specimen at the ramp's end
  double ramp_s = 1.0;       // from contact to full depth
  double hold_s = 60.0;
  // quick unloading to a share of the depth, still in contact, and a second hold: it shows the fast
  // terms that a slow ramp hides. recovery_s = 0 leaves it out.
  double unload_to_fraction = 0.10;
  double unload_speed_m_s = 4e-3;
  double recovery_s = 20.0;
  double retract_speed_m_s = 1e-3;
  double retract_m = 0.5e-3;  // clear of the surface
};

}  // namespace viscard
