#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/run/run_control.h"

#include <optional>
#include <string>

namespace viscard {

// Reports a run to the person watching, at most ten times a second.
class ProgressReport {
 public:
  // frame_stiffness_N_m: 0 for a rigid frame.
  ProgressReport(const RunControl& control, double frame_stiffness_N_m)
      : control_(control), clock_(*control.clock), frame_stiffness_N_m_(frame_stiffness_N_m) {}

  // planned_rest_s: how long this phase and all later ones should take.
  void begin_phase(const std::string& name, double planned_rest_s);
  void set_contact_m(double contact_m) { contact_m_ = contact_m; }
  bool has_contact() const { return contact_m_.has_value(); }

  void report(double force_N, double position_m);

 private:
  const RunControl& control_;
  const RigClock& clock_;
  double frame_stiffness_N_m_;
  std::string phase_ = "connect";
  double phase_start_s_ = 0.0;
  double planned_rest_s_ = 0.0;
  double last_report_wall_s_ = 0.0;
  std::optional<double> contact_m_;
};

}  // namespace viscard
