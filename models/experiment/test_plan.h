#pragma once

#include <string>
#include <vector>

namespace viscard {

// One of several ramps, each followed by a hold.
struct DepthLevel {
  double depth_m = 0.0;  // indentation from contact, not from the level before
  double ramp_s = 1.0;
  double hold_s = 30.0;
};

// A constant force, held by moving the stage while the specimen creeps.
struct CreepPlan {
  double force_N = 0.0;
  double ramp_s = 1.0;
  double hold_s = 120.0;
  double tolerance_N = 0.0;    // the stage stays within it; 0: half a percent of the force
  double depth_limit_m = 0.0;  // the run ends beyond it; 0: twice the expected elastic depth
};

// Repeated loading and unloading.
struct CyclePlan {
  int count = 5;
  double depth_m = 0.0;
  double ramp_s = 1.0;  // each way
  double hold_s = 0.0;  // at full depth
  double rest_s = 0.0;  // after unloading
  double unload_to_fraction = 0.1;
};

// Equal steps up to a depth and, if is_down_too, down again.
struct StaircasePlan {
  int steps = 5;
  double depth_m = 0.0;  // at the highest step
  double step_s = 0.5;   // duration of one step's move
  double hold_s = 10.0;  // on each step
  bool is_down_too = true;
};

// Equal steps of force on a rigid block, to measure the compliance of the frame.
struct CompliancePlan {
  int steps = 6;
  double force_N = 0.0;  // at the highest step
  double hold_s = 2.0;
};

// The contents of test.toml (data/demo/02_test.toml and data/protocols/*.toml are commented
// examples). SI. test_phases.h turns it into the list of phases that is carried out.
struct TestPlan {
  std::string name;
  // "ramp-hold" (depth_m ... recovery_s below) | "levels" | "creep" | "cycles" | "staircase" |
  // "compliance"
  std::string protocol = "ramp-hold";
  std::vector<DepthLevel> levels;
  CreepPlan creep;
  CyclePlan cycles;
  StaircasePlan staircase;
  CompliancePlan compliance;
  // A small force that is held before the test to seat the punch; 0: no preload.
  double preload_N = 0.0;
  double preload_s = 10.0;
  // approach
  double approach_speed_m_s = 0.05e-3;
  double approach_limit_m = 5e-3;  // the run ends if nothing is touched within this distance
  // From the start to the surface, as a person has measured it; 0: not stated. A load cell that has
  // not shown that it measures is brought no further than surface_margin_m beyond.
  double surface_m = 0.0;
  double surface_margin_m = 50e-6;
  double contact_force_N = 0.01;  // force above the baseline that counts as contact
  double gap_m = 20e-6;           // distance from contact before the ramp
  double baseline_s = 10.0;       // recorded out of contact before the ramp, and after retract
  // ramp and hold (protocol "ramp-hold")
  double depth_m = 0.13e-3;  // indentation of the specimen at the ramp's end
  double ramp_s = 1.0;       // from contact to full depth
  double hold_s = 60.0;
  // Quick unloading to a share of the depth, still in contact, and a second hold: it shows fast
  // terms that a slow ramp hides. recovery_s = 0: none of it. The other protocols use only the
  // speed, for an unloading without a duration of its own.
  double unload_to_fraction = 0.10;
  double unload_speed_m_s = 4e-3;
  double recovery_s = 20.0;
  double retract_speed_m_s = 1e-3;
  double retract_m = 0.5e-3;         // clear of the surface
  bool accepts_implausible = false;  // of values that no bench can have (plausible = "off")
};

}  // namespace viscard
