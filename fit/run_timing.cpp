#include "fit/run_timing.h"

#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "fit/samples/contact_onset.h"

#include <cstddef>
#include <exception>
#include <optional>

namespace viscard {
namespace {

// Start of the retraction. With time reversed, the retraction is a first move into the specimen.
std::optional<double> retraction_start_s(const IndentationData& data, const CommandedMove& retract,
                                         double still_since_s) {
  const StageMove& move = retract.move;
  const double end_s = move.start_time_s + duration_s(move);
  IndentationData backwards;
  for (std::size_t i = data.time_s.size(); i-- > 0;) {
    if (data.time_s[i] < still_since_s) break;
    backwards.time_s.push_back(-data.time_s[i]);
    backwards.force_N.push_back(data.force_N[i]);
  }
  backwards.moves = {{-end_s, move.to_m, move.from_m, move.speed_m_s, move.acceleration_m_s2}};
  backwards.start_early_s = retract.start_uncertainty_s;
  backwards.start_late_s = data.start_early_s;
  backwards.contact_from_s = -end_s - retract.start_uncertainty_s;
  backwards.contact_to_s = -still_since_s;
  try {
    return move.start_time_s - contact_onset(backwards).shift_s;
  } catch (const std::exception&) {
    return std::nullopt;  // no force is left from which the start of the retraction could be found
  }
}

// All readings on the clock, also those that indentation_from_capture() leaves out.
IndentationData all_readings(const CapturedRun& run, const RunTiming& timing,
                             const IndentationData& data) {
  IndentationData all = data;
  all.time_s.clear();
  all.force_N.clear();
  for (std::size_t i = 0; i < run.load_samples.size(); ++i) {
    const std::optional<double> force_N = usable_force_N(run.load_samples[i], run.rig);
    if (!force_N) continue;
    all.time_s.push_back(timing.sample_s[i]);
    all.force_N.push_back(*force_N);
  }
  return all;
}

// Replaces the recorded starts by fitted ones where the fit has them.
void fit_starts(const CapturedRun& run, RunTiming& timing) {
  const IndentationData data = indentation_from_capture(run);
  const FitResult fit = fit_indentation(data);
  const std::vector<double>& fitted_s = fit.curves.motion_start_s;
  timing.move_speed = fit.stage_speed.value_or(1.0);
  std::size_t next = 0;
  double still_since_s = 0.0;
  for (std::size_t m = 0; m < run.moves.size(); ++m) {
    const CommandedMove& move = run.moves[m];
    if (next < fitted_s.size() && move.move.start_time_s == data.moves[next].start_time_s) {
      timing.move_start_s[m] = fitted_s[next++];
      still_since_s = timing.move_start_s[m] + duration_s(move.move) / timing.move_speed;
    } else if (next == data.moves.size() && move.purpose == "retract") {
      timing.move_start_s[m] =
          retraction_start_s(all_readings(run, timing, data), move, still_since_s)
              .value_or(timing.move_start_s[m]);
    }
  }
}

}  // namespace

RunTiming timing_from_capture(const CapturedRun& run) {
  RunTiming timing;
  timing.sample_s = sample_times_s(run);
  for (const CommandedMove& move : run.moves) timing.move_start_s.push_back(move.move.start_time_s);
  timing.description =
      "time_s is the time of the reading on the clock that the fit uses; the moves in contact "
      "start when the force shows it";
  try {
    fit_starts(run, timing);
  } catch (const std::exception& error) {
    timing.description =
        "time_s is the time of the reading on the clock that the fit uses; the moves start when "
        "they were commanded, because the run cannot be fitted: " +
        std::string(error.what());
  }
  return timing;
}

}  // namespace viscard
