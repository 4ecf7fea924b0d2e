#include "io/cli/rig/overshoot_study.h"

#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/run/preflight.h"
#include "rig/run/run_session.h"

#include <optional>

namespace viscard {
namespace {

constexpr double kLimit_N = 1.0;
constexpr double kPace = 500.0;  // the rig waits, so this changes no result
constexpr double kFarther_m =
    0.6e-3;  // deeper than the limit, so that only the limit ends the move

enum class Stop { kGentle, kLadder, kReset };

EmulatedRigOptions bench(const OvershootRow& row) {
  EmulatedRigOptions options;
  options.config = demo_rig();
  options.config.clock_speed = kPace;
  options.config.frame.stiffness_N_m = 0.0;
  options.truth = demo_truth(10.0, 1);
  options.truth.material.E0_Pa = 1.5e6;
  options.truth.material.nu = 0.5;
  options.truth.material.terms.clear();
  options.truth.contact = PunchContact{};
  options.truth.contact.punch_radius_m = 2.2e-3;
  options.truth.contact.poisson_ratio = 0.5;
  options.truth.frame_stiffness_N_m = 0.0;
  options.truth.overload_N = 0.0;
  // Far enough to reach full speed before contact.
  options.truth.surface_position_m =
      0.02e-3 + 0.5 * row.speed_m_s * row.speed_m_s / row.acceleration_m_s2;
  options.truth.steps_per_m = row.steps_per_m;
  options.truth.acceleration_m_s2 = row.acceleration_m_s2;
  return options;
}

SafetyConfig safety_for(Stop stop, double capacity_N) {
  const double limit = kLimit_N / capacity_N;
  SafetyConfig safety;
  safety.warn_fraction = limit;
  safety.soft_fraction = stop == Stop::kGentle ? 100.0 : limit;
  safety.hard_fraction = stop == Stop::kReset ? limit : 100.0;
  return safety;
}

double overshoot_N(const OvershootRow& row, Stop stop) {
  const EmulatedRigOptions options = bench(row);
  const EmulatedRig emulated(options);
  RigConfig rig = emulated.config();
  rig.safety = safety_for(stop, rig.calibration.capacity_N);
  const RigClock clock = emulated.clock();
  const RecordSink nowhere = [](const RunRecord&) {};
  RigDevices devices = open_ports(rig, clock);
  add_drivers(devices, rig, clock, nowhere);
  RunControl control;
  control.clock = &clock;
  RunSession session(*devices.stage, *devices.load_cell, rig, nowhere, control);
  session.connect();
  session.tare(0.3);
  try {
    session.move(options.truth.surface_position_m + kFarther_m, row.speed_m_s, "overshoot",
                 stop == Stop::kGentle ? std::optional(kLimit_N) : std::nullopt);
  } catch (const LimitReached&) {
  }
  session.make_safe(0.0, 2e-3);
  return emulated.outcome().peak_force_N - kLimit_N;
}

}  // namespace

std::vector<OvershootRow> study_overshoot(const OvershootSpeeds& what,
                                          const std::function<void(double)>& progress) {
  std::vector<OvershootRow> rows;
  const auto n = static_cast<double>(what.drives.size() * what.speeds_m_s.size());
  for (const auto& [steps_per_m, acceleration_m_s2] : what.drives) {
    for (const double speed_m_s : what.speeds_m_s) {
      OvershootRow row{steps_per_m, acceleration_m_s2, speed_m_s};
      row.gentle_N = overshoot_N(row, Stop::kGentle);
      row.ladder_N = overshoot_N(row, Stop::kLadder);
      row.reset_N = overshoot_N(row, Stop::kReset);
      const EmulatedTruth truth = bench(row).truth;
      const double stiffness_N_m =
          force_per_modulus_and_depth_m(truth.contact) * truth.material.E0_Pa;
      row.expected_N =
          stiffness_N_m * (1.5 * speed_m_s / truth.sample_rate_Hz +
                           stop_distance_m(speed_m_s, {steps_per_m, acceleration_m_s2}));
      rows.push_back(row);
      if (progress) progress(static_cast<double>(rows.size()) / n);
    }
  }
  return rows;
}

}  // namespace viscard
