#include "fit/assembly/assemble_result.h"
#include "fit/assembly/bench_doubt.h"
#include "fit/assembly/fast_doubt.h"
#include "fit/assembly/spectral_fit.h"
#include "fit/assembly/stage_specimen.h"
#include "fit/assembly/two_point_modulus.h"
#include "fit/curves/stage_model.h"
#include "fit/fit_indentation.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/left_out.h"
#include "fit/samples/clean_data.h"
#include "fit/samples/contact_onset.h"
#include "fit/search/separable.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Time scales of the fastest loading and of the sampling: shorter relaxation times are flagged
// (tau-below-ramp, tau-below-sampling).
constexpr double kShownIntervals = 3.0;
constexpr double kShownShare = 0.2;

// Places of the contact position and of the speed among the nuisances of StageModel.
Index contact_nuisance(const IndentationData& data) {
  return static_cast<Index>(data.moves.size());
}
Index speed_nuisance(const IndentationData& data) {
  return contact_nuisance(data) + 1;
}

// Averages of measured and fitted force in contact for plots, in log time from each motion's start.
void fill_curves(const StageModel& model, const AveragedRun& run, const SpectralState& state,
                 const Eigen::VectorXd& residual_N, FitResult& result) {
  const IndentationData& data = run.rows;
  FitCurves& curves = result.curves;
  for (std::size_t m = 0; m < data.moves.size(); ++m) {
    curves.motion_start_s.push_back(data.moves[m].start_time_s +
                                    state.nuisance[static_cast<Index>(m)]);
  }
  constexpr double kRatio = 1.0592537251772889;  // 10^(1/40)
  for (std::size_t begin = 0; begin < data.time_s.size();) {
    const double t = data.time_s[begin];
    if (!(t > curves.motion_start_s.front()) || t > data.contact_to_s) {
      ++begin;
      continue;
    }
    double since_s = 0.0;
    double next_motion_s = data.contact_to_s;
    for (const double start_s : curves.motion_start_s) {
      if (start_s < t) since_s = t - start_s;
      if (start_s >= t) next_motion_s = std::min(next_motion_s, start_s);
    }
    std::size_t end = begin + 1;
    while (end < data.time_s.size() && data.time_s[end] - t < since_s * (kRatio - 1.0) &&
           data.time_s[end] < next_motion_s && model.is_moving()[end] == model.is_moving()[begin]) {
      ++end;
    }
    const auto count = static_cast<double>(run.begins[end] - run.begins[begin]);
    double time = 0.0, force_N = 0.0, residual = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double share = run.count(static_cast<Index>(i)) / count;
      time += share * data.time_s[i];
      force_N += share * data.force_N[i];
      residual += share * residual_N[static_cast<Index>(i)];
    }
    curves.add(time, force_N, force_N - residual,
               model.sigma_N()[static_cast<Index>(begin)] / std::sqrt(count));
    begin = end;
  }
  curves.unit = "N";
}

// The two-point modulus of loading, with the depth from the stage minus the frame's deflection.
std::optional<TwoPointModulus> two_points(const IndentationData& data, const SpectralState& state,
                                          double offset_N, double sigma_N) {
  if (!data.contact) return std::nullopt;
  const StageMove ramp =
      timed(data.moves.front(), state.nuisance[0], state.nuisance[speed_nuisance(data)]);
  const double contact_m = state.nuisance[contact_nuisance(data)];
  const double direction = ramp.to_m > ramp.from_m ? 1.0 : -1.0;
  std::vector<double> time_s, force_N, depth_m;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    const double t = data.time_s[i];
    if (t > ramp.start_time_s + duration_s(ramp)) break;
    const double pressed_m = direction * (position_m(ramp, t) - contact_m);
    if (t < ramp.start_time_s || !(pressed_m > 0.0)) continue;
    time_s.push_back(t);
    force_N.push_back(data.force_N[i] - offset_N);
    depth_m.push_back(pressed_m - (data.frame_stiffness_N_m > 0.0
                                       ? force_N.back() / data.frame_stiffness_N_m
                                       : 0.0));
  }
  return two_point_modulus(time_s, force_N, depth_m, *data.contact, sigma_N);
}

// Flags missing samples where the force changes fast: during the ramp and just after it.
void flag_gap_in_ramp(const IndentationData& data, const SpectralState& state, FitResult& result) {
  const StageMove& ramp = data.moves.front();
  const double from_s = ramp.start_time_s + state.nuisance[0];
  const double to_s = from_s + duration_s(ramp);
  const double usual_s = usual_step_s(data.time_s);
  for (std::size_t i = 1; i < data.time_s.size(); ++i) {
    const bool in_ramp = data.time_s[i] > from_s && data.time_s[i - 1] < to_s;
    const double step_s = data.time_s[i] - data.time_s[i - 1];
    if (!in_ramp || step_s < std::max(4.0 * usual_s, 0.05 * duration_s(ramp))) continue;
    add_defect(result, "gap-in-ramp",
               "no readings for " + text_of(step_s, 3) + " s during the ramp (" +
                   text_of(data.time_s[i - 1] - from_s, 3) + " s after it began)");
    return;
  }
}

// The move during or after which the fitted force is negative: a punch cannot pull, so it lifted.
std::optional<std::size_t> move_losing_contact(const IndentationData& data,
                                               const SpectralState& state, double offset_N,
                                               const Eigen::VectorXd& residual_N, double sigma_N) {
  const auto begin_s = [&](std::size_t m) {
    return data.moves[m].start_time_s + state.nuisance[static_cast<Index>(m)];
  };
  const double ramp_end_s = begin_s(0) + duration_s(data.moves.front());
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] < ramp_end_s || data.time_s[i] > data.contact_to_s) continue;
    const double fitted_N = data.force_N[i] - residual_N[static_cast<Index>(i)] - offset_N;
    if (fitted_N > -3.0 * sigma_N) continue;
    std::size_t move = 0;
    while (move + 1 < data.moves.size() && begin_s(move + 1) <= data.time_s[i]) ++move;
    return move;
  }
  return std::nullopt;
}

// A fit of a run while in contact, and the move that loses contact, if there is one.
struct ContactFit {
  FitResult result;
  std::optional<std::size_t> lost_by_move;
};

void flag_stage_misfit(const IndentationData& data, FitResult& result) {
  const QuietForce quiet = quiet_force(data);
  const double peak_N =
      *std::max_element(data.force_N.begin(), data.force_N.end()) - quiet.before_N;
  flag_misfit(result.noise.sigma, quiet.sigma_N, quiet.n, peak_N, result);
}

// The speed is the last parameter.
void report_stage_speed(const SpectralFit& fit, FitResult& result) {
  constexpr double kUnusual = 4e-3;  // two standard deviations of the prior of StageModel
  const double ln_speed = fit.state.nuisance[fit.state.nuisance.size() - 1];
  const Index last = fit.covariance.rows() - 1;
  result.stage_speed = std::exp(ln_speed);
  result.stage_speed_se = std::sqrt(std::max(0.0, fit.covariance(last, last)));
  if (std::abs(ln_speed) < kUnusual) return;
  result.flags.push_back(
      {"stage-speed", 0,
       "the stage moved " + text_of(100.0 * std::abs(*result.stage_speed - 1.0), 2) + " % " +
           (ln_speed > 0.0 ? "faster" : "slower") +
           " than commanded; the fit takes it into account. Check the clock of its controller and "
           "that of the amplifier"});
}

// The fastest loading or unloading. Corrections of the position are too small to show fast terms.
void report_fastest(const IndentationData& data, const SpectralFit& fit, FitResult& result) {
  const StageMove& ramp = data.moves.front();
  result.fastest_s = duration_s(ramp);
  for (const StageMove& move : data.moves) {
    if (is_correction(move, ramp, fit.state.nuisance[contact_nuisance(data)])) continue;
    result.fastest_s = std::min(result.fastest_s, duration_s(move));
  }
}

// Fills window, flags and the two-point modulus.
void report_stage_fit(const StageModel& model, const IndentationData& data,
                      const IndentationData& rows, const SpectralFit& fit,
                      const Eigen::VectorXd& residual_N, ContactFit& out) {
  FitResult& result = out.result;
  const StageMove& ramp = data.moves.front();
  result.fit_from_s = ramp.start_time_s + fit.state.nuisance[0];
  result.fit_to_s = data.contact_to_s;
  add_identifiability_flags(
      model, fit.state, fit.covariance,
      {usual_step_s(data.time_s), 0.0, 0.0, result.fit_to_s - result.fit_from_s}, result);
  flag_gap_in_ramp(data, fit.state, result);
  for (Index j = 0; j < model.n_common(); ++j) {
    if (model.common()[static_cast<std::size_t>(j)].name != "offset_N") continue;
    const double offset_N = fit.state.coefficients[j];
    out.lost_by_move =
        move_losing_contact(rows, fit.state, offset_N, residual_N, result.noise.sigma);
    result.two_point = two_points(data, fit.state, offset_N, result.noise.sigma);
  }
  flag_stage_misfit(data, result);
  if (!model.has_drift()) {
    result.flags.push_back({"drift-unseen", 0,
                            "no readings out of contact after the test: drift of the load cell "
                            "cannot be separated from slow relaxation; E_inf and the slowest term "
                            "may include it, their intervals do not"});
  }
}

// Start values and noise from preliminary fits with a few terms: the first with equal weights. If
// the time stamps scatter, a second one follows, because their errors distort the first.
struct Preparation {
  Eigen::VectorXd start;
  StageNoise noise;
  Course touch;
  SpectralState state;  // of the last of these fits
};

// The depth of the punch in the approach and until the ramp ends; for the latter the punch counts as lifted. The
// points lie close after every stop, where the force changes fast.
Course punch_before_ramp(const IndentationData& data, const SpectralState& state) {
  constexpr double kLifted_m = -1.0, kFinest_s = 5e-3, kShareOfRest = 0.02;
  Course course;
  const StageMove& ramp = data.moves.front();
  const double direction = ramp.to_m > ramp.from_m ? 1.0 : -1.0;
  const double contact_m = state.nuisance[contact_nuisance(data)];
  std::size_t first = 0;  // that reaches the surface
  const auto depth_m = [&](double position) { return direction * (position - contact_m); };
  while (first < data.approach.size() && depth_m(data.approach[first].to_m) <= 0.0 &&
         depth_m(data.approach[first].from_m) <= 0.0) {
    ++first;
  }
  for (std::size_t m = first; m < data.approach.size(); ++m) {
    const bool is_last = m + 1 == data.approach.size();
    const StageMove& move = data.approach[m];
    const double moved_s = move.start_time_s + duration_s(move);
    const double until_s = is_last ? ramp.start_time_s + duration_s(ramp) + data.start_late_s
                                   : data.approach[m + 1].start_time_s;
    for (double t = move.start_time_s; t < until_s;
         t += std::max(kFinest_s, kShareOfRest * (t - moved_s))) {
      course.push_back({t + state.nuisance[0],
                        is_last && t > moved_s ? kLifted_m : depth_m(position_m(move, t))});
    }
  }
  return course;
}

// The surface before the ramp, if it is that of this fit. The moves begin as late as the ramp.
Course touch_of_approach(const IndentationData& data, const StageModel& model,
                         const SpectralState& state, bool is_liquid) {
  const Course punch_m = punch_before_ramp(data, state);
  if (punch_m.empty()) return {};
  return earlier_touch(punch_m, relaxation_series_of(model, is_liquid)(state));
}

Preparation prepared(const IndentationData& data, const AveragedRun& run,
                     const FitOptions& options) {
  Preparation now{.start = nuisance_start(data)};
  OrderPathOptions path_options;
  path_options.max_terms = 4;
  for (int pass = 0; pass < 2; ++pass) {
    const StageModel model(run, data, now.start, now.noise, options);
    const std::vector<SpectralState> path = order_path(model, path_options);
    if (path.empty()) {
      throw std::runtime_error(
          "no model fits these readings: every fitted modulus is zero or not finite. Check the "
          "sign of the force, the calibration and the moves of the capture");
    }
    const SpectralState& state = now.state = path.back();
    now.start = state.nuisance;
    StageResidual left{run.rows.time_s, model.is_moving(), model.is_out_of_contact(), {}, {}};
    left.fitted_N = model.fitted(state).cwiseProduct(model.row_sigma());
    left.residual_N = model.reading_residuals_N(state);
    now.noise = stage_noise(left);
    if (now.noise.stamp_s == 0.0) break;
  }
  return now;
}

// The touch of the approach and the fit depend on one another: the fit sees where the surface is and how it
// recovers. Both are found in turn, first with the terms of the preparation.
void settle_touch(const IndentationData& data, const AveragedRun& run, const FitOptions& options,
                  Preparation& now) {
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    const StageModel model(run, data, now.start, now.noise, options, now.touch);
    if (round > 0) now.state = quick_search(model, now.state, {.tolerance = 1e-10});
    now.start = now.state.nuisance;
    Course touch = touch_of_approach(data, model, now.state, options.is_liquid);
    const bool is_same = relative_change(touch, now.touch) <= kSameTouch;
    now.touch = std::move(touch);
    if (is_same) return;
  }
}

struct StageFit {
  std::unique_ptr<StageModel> model;
  SpectralFit fit;
};

StageFit settled_fit(const IndentationData& data, const AveragedRun& run, const FitOptions& options,
                     Preparation& now) {
  constexpr int kRounds = 4;
  settle_touch(data, run, options, now);
  for (int round = 1;; ++round) {
    StageFit of{std::make_unique<StageModel>(run, data, now.start, now.noise, options, now.touch),
                {}};
    of.fit =
        fit_spectrum(*of.model, log_time_blocks(run.rows.time_s, data.contact_from_s, 4), options);
    Course touch = touch_of_approach(data, *of.model, of.fit.state, options.is_liquid);
    if (round == kRounds || relative_change(touch, now.touch) <= kSameTouch) return of;
    now.touch = std::move(touch);
    now.start = of.fit.state.nuisance;
  }
}

ContactFit fit_in_contact(const IndentationData& data, const FitOptions& options) {
  const AveragedRun run = averaged_run(data, options.full_data);
  Preparation prepared_for = prepared(data, run, options);
  const StageFit settled = settled_fit(data, run, options, prepared_for);
  const StageModel& model = *settled.model;
  const SpectralFit& fit = settled.fit;

  ContactFit out;
  FitResult& result = out.result;
  result.kind = FitKind::kIndentation;
  result.is_stiffness = !data.contact;
  fill_result(model, fit, specimen_series_of(model, data, options.is_liquid), result);
  report_fastest(data, fit, result);
  carry_fast_doubt(
      model, fit, specimen_series_of(model, data, options.is_liquid),
      std::max(kShownShare * result.fastest_s, kShownIntervals * usual_step_s(data.time_s)),
      result);
  add_gain_drift(gain_drift_part(model, fit, data, result), result);
  result.noise.sigma = prepared_for.noise.resting_N;
  result.contact_position_m = fit.state.nuisance[contact_nuisance(data)];
  report_stage_speed(fit, result);
  const Eigen::VectorXd residual_N =
      (model.data() - model.fitted(fit.state)).cwiseProduct(model.row_sigma());
  report_stage_fit(model, data, run.rows, fit, residual_N, out);
  if (options.with_curves) fill_curves(model, run, fit.state, residual_N, result);
  return out;
}

}  // namespace

FitResult fit_stage_indentation(const IndentationData& data, const FitOptions& options) {
  if (!options.constraints.empty()) {
    throw std::runtime_error(
        "parameters of a captured run cannot be constrained: specimen and frame are fitted "
        "together; export the run and fit its table");
  }
  IndentationData kept = data;
  std::optional<std::size_t> lifting = first_lifting_move(kept);
  ContactFit fit;
  // Usually one round. The fit may detect a loss of contact that the force alone does not show.
  while (true) {
    if (lifting) kept = before_move(std::move(kept), *lifting);
    fit = fit_in_contact(kept, options);
    if (fit.lost_by_move.value_or(0) == 0) break;
    lifting = fit.lost_by_move;
  }
  if (fit.lost_by_move) {
    add_defect(fit.result, "contact-lost", "the punch loses contact during the first hold");
  }
  if (kept.moves.size() < data.moves.size()) {
    fit.result.flags.push_back({"unloading-left-out", 0,
                                "move " + std::to_string(kept.moves.size() + 1) +
                                    " of the test lifted the punch off the specimen; this move and "
                                    "all later ones were left out. Unload to a larger share of the "
                                    "depth, and check modulus_guess of the specimen"});
  }
  add_left_out(fit.result, left_out::kLifted, data.time_s.size() - kept.time_s.size());
  return fit.result;
}

}  // namespace viscard
