#include "rig/run/run_control.h"

#include <algorithm>

namespace viscard {

void ProgressReport::begin_phase(const std::string& name, double planned_rest_s) {
  phase_ = name;
  phase_start_s_ = clock_.now_s();
  planned_rest_s_ = planned_rest_s;
  last_report_wall_s_ = 0.0;  // every phase is reported at least once, however fast it passes
}

void ProgressReport::report(double force_N, double position_m) {
  constexpr double kInterval_wall_s = 0.1;
  if (!control_.progress || monotonic_s() - last_report_wall_s_ < kInterval_wall_s) return;
  last_report_wall_s_ = monotonic_s();
  RunProgress progress;
  const double now_s = clock_.now_s();
  progress.time_s = now_s;
  progress.phase = phase_;
  progress.time_left_s = std::max(0.0, planned_rest_s_ - (now_s - phase_start_s_));
  progress.fraction = now_s / std::max(1e-9, now_s + progress.time_left_s);
  progress.force_N = force_N;
  if (contact_m_) {
    const double frame_m = frame_stiffness_N_m_ > 0.0 ? force_N / frame_stiffness_N_m_ : 0.0;
    progress.depth_m = std::max(0.0, position_m - *contact_m_ - frame_m);
  }
  control_.progress(progress);
}

}  // namespace viscard
