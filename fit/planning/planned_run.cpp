#include "fit/planning/planned_run.h"

#include "models/contact/punch_contact.h"
#include "models/experiment/test_phases.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Kind = TestPhase::Kind;

// A run measures the uncertainty of its starts (start_uncertainty_s), which the fit then uses; here
// it is assumed.
constexpr double kStartLate_s = 0.02;

void require_planned(bool is_good, const std::string& text) {
  if (!is_good) throw std::invalid_argument(text);
}

// Walks through the phases of a test and makes the moves of the stage.
class StageWalk {
 public:
  StageWalk(const TestPlan& plan, const RigPerformance& performance, double travel_per_depth)
      : plan_(plan),
        performance_(performance),
        travel_per_depth_(travel_per_depth),
        position_m_(-plan.gap_m) {}

  void add(const TestPhase& phase) {
    if (phase.kind == Kind::kMove) {
      const double to_m = phase.depth_m * travel_per_depth_;
      // The first ramp goes from the gap at the speed that takes move_s from contact.
      const double way_m = moves_.empty() ? to_m : std::abs(to_m - position_m_);
      add_move(to_m, phase.move_s > 0.0 ? way_m / phase.move_s : phase.speed_m_s);
    } else if (phase.kind == Kind::kApproach) {
      time_s_ += performance_.approach_s;
    } else if (phase.kind == Kind::kRetract) {
      retract_s_ = time_s_;
      n_in_contact_ = moves_.size();
      add_move(-plan_.retract_m, plan_.retract_speed_m_s);
      free_s_ = time_s_ + kStartLate_s + kStartEarly_s + kFreeAgain_s;
    } else {
      require_planned(
          phase.kind != Kind::kLoad && phase.kind != Kind::kHoldForce,
          "tests with a given force (preload, protocols creep and compliance) cannot be "
          "planned; take one with given depths");
    }
    time_s_ += phase.duration_s;
    if (phase.kind == Kind::kApproach) still_s_ = time_s_;
  }

  // Readings at rest before contact, in contact, and after it; the moves in contact.
  IndentationData data(double rate_Hz) const {
    IndentationData data;
    require_planned(n_in_contact_ > 0, "the test has no move in contact, so it shows no modulus");
    data.moves.assign(moves_.begin(), moves_.begin() + static_cast<std::ptrdiff_t>(n_in_contact_));
    data.start_early_s = kStartEarly_s;
    data.start_late_s = kStartLate_s;
    data.contact_from_s = data.moves.front().start_time_s;
    data.contact_to_s = retract_s_ - kStartEarly_s;
    for (double k = 0.5; k / rate_Hz < time_s_; k += 1.0) {
      const double t = k / rate_Hz;
      if ((t > still_s_ && t <= data.contact_to_s) || t > free_s_) data.time_s.push_back(t);
    }
    data.force_N.assign(data.time_s.size(), 0.0);
    return data;
  }

  double total_s() const { return time_s_; }

 private:
  void add_move(double to_m, double speed_m_s) {
    moves_.push_back({time_s_, position_m_, to_m, speed_m_s, performance_.acceleration_m_s2});
    validate(moves_.back());
    time_s_ += duration_s(moves_.back());
    position_m_ = to_m;
  }

  const TestPlan& plan_;
  const RigPerformance& performance_;
  double travel_per_depth_;
  double time_s_ = 0.0, position_m_;  // counted from contact
  double still_s_ = 0.0, retract_s_ = 0.0, free_s_ = 0.0;
  std::vector<StageMove> moves_;
  std::size_t n_in_contact_ = 0;
};

}  // namespace

PlannedRun planned_run(const TestPlan& plan, const Bench& bench) {
  const RigConfig& rig = bench.rig;
  const Specimen& specimen = bench.specimen;
  require_planned(specimen.modulus_guess_Pa > 0.0,
                  "the specimen has no modulus_guess, so the travel of the stage is not known");
  require_planned(rig.load_cell.expected_rate_Hz > 0.0,
                  "expected_rate of the load cell must be positive");
  const double specimen_N_m =
      force_per_modulus_and_depth_m(specimen.contact) * specimen.modulus_guess_Pa;
  const double frame_N_m = rig.frame.stiffness_N_m;
  StageWalk walk(plan, bench.performance, 1.0 + (frame_N_m > 0.0 ? specimen_N_m / frame_N_m : 0.0));
  const std::vector<TestPhase> phases = phases_from_plan(plan);
  for (const TestPhase& phase : phases) walk.add(phase);
  PlannedRun run{walk.data(rig.load_cell.expected_rate_Hz), walk.total_s(),
                 specimen_N_m * deepest_m(phases)};
  run.data.frame_stiffness_N_m = frame_N_m;
  run.data.frame_stiffness_relative_u = rig.frame.stiffness_relative_u;
  run.data.force_relative_u = gain_relative_u(rig.calibration, run.peak_force_N);
  run.data.contact = specimen.contact;
  return run;
}

}  // namespace viscard
