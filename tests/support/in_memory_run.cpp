#include "tests/support/in_memory_run.h"

#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace viscard::test {
namespace {

constexpr double kVoltsPerNewton = 0.7255;
constexpr double kVoltsPerCount = 5.0 / 16777216.0;
constexpr double kCapacity_N = 0.250 * 9.80665;

// Specimen under the punch and frame spring, moved by the stage.
class Bench {
 public:
  explicit Bench(const EmulatedTruth& truth) : truth_(truth), specimen_(stiffness(truth)) {}

  // Moves the stage to z in dt. Without contact, the surface recovers under zero force.
  double advance_N(double dt_s, double z_m) {
    const double press_m = z_m - truth_.surface_position_m;
    const double algorithmic = specimen_.algorithmic_modulus_Pa(dt_s);
    const double carried = specimen_.carried_Pa(dt_s);
    const double k = truth_.frame_stiffness_N_m;
    double depth_m = (press_m - carried / k) / (1.0 + algorithmic / k);
    if (algorithmic * depth_m + carried < 0.0) depth_m = -carried / algorithmic;
    return specimen_.advance(dt_s, depth_m);
  }

 private:
  static PronySeries stiffness(const EmulatedTruth& truth) {
    const double factor_m = force_per_modulus_and_depth_m(truth.contact);
    PronySeries series = young_series(truth.material);
    series.equilibrium_modulus_Pa *= factor_m;
    for (MaxwellTerm& term : series.terms) term.modulus_Pa *= factor_m;
    return series;
  }
  const EmulatedTruth& truth_;
  HereditaryStress specimen_;
};

// A move as the stage carries it out on a clock of its own.
StageMove at_true_speed(StageMove move, double speed) {
  move.speed_m_s *= speed;
  move.acceleration_m_s2 *= speed * speed;
  return move;
}

struct Plan {
  std::vector<CommandedMove> moves;  // true starts, speeds as commanded
  double end_s = 0.0;
};

Plan true_moves(const EmulatedTruth& truth, const TestPlan& plan, const RunConditions& conditions,
                std::mt19937_64& random) {
  const double factor_m = force_per_modulus_and_depth_m(truth.contact);
  const double k_N_m = factor_m * truth.material.E0_Pa;
  const double guess_N_m = conditions.guess_over_truth * k_N_m;
  const double share = 1.0 + guess_N_m / truth.frame_stiffness_N_m;
  std::uniform_real_distribution<double> within(-0.5, 0.5);
  // The contact search ends a few micrometres from the surface, and the rig uses that position.
  const double guess_error_m = conditions.touched_N * (1.0 / k_N_m - 1.0 / guess_N_m);
  const double believed_m = truth.surface_position_m + guess_error_m + 4e-6 * within(random);
  const double from_m = quantised_m(believed_m - plan.gap_m, truth.steps_per_m);
  const double full_m = quantised_m(believed_m + plan.depth_m * share, truth.steps_per_m);
  const double partial_m =
      quantised_m(believed_m + plan.unload_to_fraction * plan.depth_m * share, truth.steps_per_m);
  const double away_m = quantised_m(believed_m - plan.retract_m, truth.steps_per_m);
  Plan result;
  const bool with_touch = conditions.touch_m > 0.0;
  double t = with_touch ? 0.5 : plan.baseline_s;
  const auto add = [&](const char* purpose, double a_m, double b_m, double speed, double then_s) {
    CommandedMove move;
    move.move = {t, a_m, b_m, speed, truth.acceleration_m_s2};
    move.purpose = purpose;
    result.moves.push_back(move);
    t += duration_s(at_true_speed(move.move, conditions.stage_speed)) + then_s;
  };
  if (with_touch) {
    const double deep_m =
        quantised_m(truth.surface_position_m + conditions.touch_m, truth.steps_per_m);
    add("approach", from_m, deep_m, 0.2e-3, conditions.touch_s);
    add("back off", deep_m, from_m, plan.retract_speed_m_s, plan.baseline_s);
  }
  const double speed = plan.depth_m * share / plan.ramp_s;
  add("ramp", from_m, full_m, speed, plan.hold_s);
  if (plan.recovery_s > 0.0) {
    add("unload", full_m, partial_m, plan.unload_speed_m_s, plan.recovery_s);
  }
  add("retract", result.moves.back().move.to_m, away_m, plan.retract_speed_m_s, plan.baseline_s);
  result.end_s = t;
  return result;
}

// Position of the motor: whole steps from the start of the move.
double stepped_m(const std::vector<StageMove>& moves, double time_s, double steps_per_m,
                 bool when_due) {
  const double z_m = position_m(moves, time_s);
  if (!when_due) return quantised_m(z_m, steps_per_m);
  double direction = 1.0;
  for (const StageMove& move : moves) {
    if (time_s >= move.start_time_s) direction = move.to_m >= move.from_m ? 1.0 : -1.0;
  }
  constexpr double kOfAStep = 1e-6;  // rounding
  return direction * std::floor(direction * z_m * steps_per_m + kOfAStep) / steps_per_m;
}

// True force at every reading: fine steps while the stage moves, one step a reading while it rests.
std::vector<double> true_forces_N(const EmulatedTruth& truth, const Plan& plan,
                                  const RunConditions& conditions,
                                  const std::vector<double>& times_s) {
  std::vector<StageMove> moves;
  for (const CommandedMove& move : plan.moves) {
    moves.push_back(at_true_speed(move.move, conditions.stage_speed));
  }
  const auto is_moving = [&](double t) {
    for (const StageMove& move : moves) {
      if (t > move.start_time_s - 0.02 && t < move.start_time_s + duration_s(move) + 0.02)
        return true;
    }
    return false;
  };
  Bench bench(truth);
  std::vector<double> forces_N;
  double t = 0.0;
  double force_N = 0.0;
  for (const double reading_s : times_s) {
    const double dt_s = reading_s - t;
    const int steps =
        is_moving(reading_s) ? std::max(1, static_cast<int>(std::ceil(dt_s / 0.25e-3))) : 1;
    for (int i = 1; i <= steps; ++i) {
      const double z_m =
          stepped_m(moves, t + dt_s * i / steps, truth.steps_per_m, conditions.steps_when_due);
      force_N = bench.advance_N(dt_s / steps, z_m);
    }
    t = reading_s;
    forces_N.push_back(force_N);
  }
  return forces_N;
}

}  // namespace

CapturedRun in_memory_run(const EmulatedTruth& truth, const TestPlan& plan,
                          const RunConditions& conditions) {
  std::mt19937_64 random(truth.seed);
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> delay(1.0 / conditions.message_delay_s);
  std::uniform_real_distribution<double> unit;
  const Plan moves = true_moves(truth, plan, conditions, random);
  std::vector<double> times_s;
  const double phase = unit(random);
  for (double k = phase; k / truth.sample_rate_Hz < moves.end_s; k += 1.0) {
    times_s.push_back(k / truth.sample_rate_Hz);
  }
  const std::vector<double> forces_N = true_forces_N(truth, moves, conditions, times_s);

  CapturedRun run;
  run.plan = plan;
  run.specimen.contact = truth.contact;
  run.specimen.modulus_guess_Pa = conditions.guess_over_truth * truth.material.E0_Pa;
  run.rig.calibration = {kVoltsPerNewton, 0.0, 0.0, kCapacity_N, "demo", ""};
  run.rig.load_cell.volts_per_count = kVoltsPerCount;
  run.rig.frame = {truth.frame_stiffness_N_m, 0.02};
  run.status = "finished";
  const double ramp_s = moves.moves[conditions.touch_m > 0.0 ? 2 : 0].move.start_time_s;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const double since_ramp_s = times_s[i] - ramp_s;
    const double noise_N = truth.force_noise_N * normal(random);
    const double late_s = delay(random);
    if (since_ramp_s > conditions.lost_from_s && since_ramp_s < conditions.lost_to_s) continue;
    const double seen_N = forces_N[i] * (1.0 + truth.drift_relative_per_s * times_s[i]) +
                          truth.force_offset_N + noise_N;
    LoadSample sample;
    sample.index = static_cast<std::int64_t>(i);
    const double clock_s = conditions.clock_offset_s + conditions.clock_rate * times_s[i];
    sample.device_time_s = 1e-6 * std::round(clock_s * 1e6);
    sample.host_time_s = times_s[i] + late_s;
    sample.counts = std::round(seen_N * kVoltsPerNewton / kVoltsPerCount);
    run.load_samples.push_back(sample);
  }
  run.moves = moves.moves;
  for (CommandedMove& move : run.moves) {
    move.move.start_time_s -= conditions.start_latency_s * unit(random);
    move.start_uncertainty_s = conditions.start_latency_s;
  }
  return run;
}

EmulatedTruth demo_truth(int mixing_ratio, std::uint64_t seed) {
  EmulatedTruth truth;
  switch (mixing_ratio) {
    case 10:
      truth.material.E0_Pa = 1.88e6;
      truth.material.terms = {{0.008206, 0.008206, 0.1945}, {0.01386, 0.01386, 2.403}};
      break;
    case 13:
      truth.material.E0_Pa = 1.65e6;
      truth.material.terms = {{0.01251, 0.01251, 0.1588}, {0.01355, 0.01355, 1.686}};
      break;
    case 20:
      truth.material.E0_Pa = 1.45e6;
      truth.material.terms = {{0.01219, 0.01219, 0.2247}, {0.01913, 0.01913, 2.581}};
      break;
    default:
      throw std::invalid_argument("the demo has ratios 10, 13 and 20");
  }
  truth.material.nu = 0.495;
  truth.contact = {2.2e-3, 11e-3, 0.495};
  truth.frame_stiffness_N_m = 10e3;
  truth.force_noise_N = 0.0002 * kCapacity_N;
  truth.force_offset_N = 0.013;
  truth.drift_relative_per_s = 1e-6;
  truth.seed = seed;
  return truth;
}

}  // namespace viscard::test
