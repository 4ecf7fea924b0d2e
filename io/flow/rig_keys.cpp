#include "io/flow/rig_keys.h"

#include "models/maths/result_visitor.h"

namespace viscard {
namespace {

// The message also contains the final position of the punch, which the reason gives after the
// cause.
CommandError error_of_run(const RunOutcome& outcome) {
  const bool has_cause = !outcome.cause.empty() && outcome.reason.rfind(outcome.cause, 0) == 0;
  CommandError error = command_error(outcome.code.empty() ? "failed" : outcome.code,
                                     has_cause ? outcome.cause : outcome.reason, outcome.phase);
  if (has_cause) error.message += outcome.reason.substr(outcome.cause.size());
  return error;
}

void show_stage(ResultVisitor& v, const RigCheck& found) {
  v("identity", found.stage_identity, "what the controller calls itself");
  v("steps_per_m", found.dynamics.steps_per_m, "steps for a metre");
  v("acceleration_m_s2", found.dynamics.acceleration_m_s2, "its acceleration");
  v("min_speed_m_s", found.dynamics.min_speed_m_s, "slowest speed");
  v("max_speed_m_s", found.dynamics.max_speed_m_s, "fastest speed");
  v("position_m", found.position_m, "where it stands");
  v("latency_mean_s", found.latency.mean_s, "mean time of an answer");
  v("latency_longest_s", found.latency.longest_s, "longest time of an answer");
  v("reports", found.latency.n, "answers received");
  v("reports_lost", found.latency.n_lost, "answers that did not come");
}

void show_load_cell(ResultVisitor& v, const RigCheck& found) {
  v("rate_Hz", found.rate_Hz, "readings in a second");
  v("jitter_s", found.jitter_s, "largest delay of a reading");
  v("falls_behind", found.falls_behind,
    "seconds by which a reading is later than the one a second before; above 0: the line is too "
    "slow");
  v("line_bytes", found.line_bytes, "bytes of a reading");
  v("missing", found.stream.missing, "readings that did not come");
  v("unreadable", found.stream.unreadable, "lines that are no reading");
  v("reads_as", found.reads_as, "the column that was taken as the reading");
  v("force_N", found.force_N, "mean force at rest");
  v("noise_N", found.noise_N, "standard deviation of a reading");
}

void show_readings(ResultVisitor& v, const StreamCounts& stream) {
  v("expected", stream.expected(), "by the rate");
  v("received", stream.received, "that came");
  v("missing", stream.missing, "that did not come");
  v("duplicate", stream.duplicate, "that came twice");
  v("glitch", stream.glitch, "taken out as glitches");
  v("saturated", stream.saturated, "at the end of the range");
  v("unreadable", stream.unreadable, "lines that are no reading");
  v("implausible", stream.implausible, "outside what a load cell can do");
  v("longest_gap_s", stream.longest_gap_s, "longest time without a reading");
  v("longest_gap_at_s", stream.longest_gap_at_s, "when that was");
}

void show_run(ResultVisitor& v, const RunOutcome& outcome) {
  v("peak_force_N", outcome.peak_force_N, "largest force");
  v("expected_peak_force_N", outcome.expected.peak_force_N,
    "the peak that the check before the run predicted");
  v("limit_N", outcome.expected.limit_N, "limit of force of the test");
  v("depth_m", outcome.achieved_depth_m, "depth that was reached");
  v.word("depth_is", outcome.depth_is, {"measured", "counted", "compared"},
         "measured by the stage's encoder, or counted in steps; compared: counted, and the stage "
         "stood there when it was homed after the lift");
  v("count_off_m",
    number_or_null(outcome.count ? std::optional(outcome.count->off_m) : std::nullopt),
    "the count over the way made since the stage was homed; null: not compared");
  v("contact_position_m", number_or_null(outcome.contact_position_m),
    "where the punch touched; null: nowhere");
  v("noise_N", outcome.noise_N, "standard deviation of a reading at rest");
  v("hidden_error_N", outcome.hidden_error_N, "error of force that readings at rest do not show");
  v("is_doubtful", !outcome.doubts.empty(), "whether anything limits the trust in the record");
  v("doubts", outcome.doubts, "what limits the trust in the record");
  v("line_format", outcome.line_format, "how lines of the load cell were read");
  v("temperature", outcome.temperature, "measured during the run");
  v.when(!outcome.thermometer_trouble.empty(), [&] {
    v("thermometer_trouble", outcome.thermometer_trouble, "why there is no temperature");
  });
  v.object("computer_late", "delays of this computer", [&] {
    v("times", outcome.n_late, "how often");
    v("longest_s", outcome.longest_late_s, "the longest");
  });
  v.object("readings", "of the load cell", [&] { show_readings(v, outcome.stream); });
}

}  // namespace

void show_keys(ResultVisitor& v, const StageMoved& moved) {
  v("from_m", moved.from_m, "position of the controller before the move, toward the specimen");
  v("to_m", moved.to_m, "position after it");
  v("force_before_N", moved.force_before_N, "force by the calibration before the move");
  v("force_after_N", moved.force_after_N, "force after it");
  v("is_stopped_by_force", moved.is_stopped_by_force, "the change of force reached --limit");
  v("zero_m", number_or_null(moved.zero_m),
    "position of the controller that counts as 0 for a person (rig set-zero); null: none, or this "
    "stage does not keep it");
  v("note", moved.note, "what to know of the position from now on; empty: nothing");
}

void show_keys(ResultVisitor& v, const ZeroedForce& zeroed) {
  v("force_before_N", zeroed.before_N, "force by the calibration before the instrument's zero");
  v("force_after_N", zeroed.after_N, "force after it");
}

void show_keys(ResultVisitor& v, const RigCheck& found) {
  v("is_usable", found.is_usable, "whether a test can begin");
  v("is_proven", found.is_proven, "whether the readings show the noise of a converter");
  v.object("stage", "measured of the stage", [&] { show_stage(v, found); });
  v.object("load_cell", "measured of the load cell", [&] { show_load_cell(v, found); });
  v("advice", found.advice, "what to change");
  v.when(found.has_thermometer, [&] {
    v.object("thermometer", "measured of the thermometer", [&] {
      v("temperature_C", number_or_null(found.temperature_C), "newest reading; null: none came");
      v("readings", found.n_temperatures, "their number");
      v("trouble", found.thermometer_trouble, "why none came");
    });
  });
  v.when(!found.is_usable, [&] {
    const std::string why =
        found.advice.empty() ? "the rig is not fit for a test" : found.advice.back();
    v("error", command_error("unfit", why), "why the rig is not fit for a test");
  });
}

std::string status_of(const CaptureOfSeries& capture) {
  return capture.run ? capture.run->status : capture.status;
}

std::optional<CommandError> error_of(const CaptureOfSeries& capture) {
  if (!capture.run || capture.run->status == "finished") return capture.error;
  return error_of_run(*capture.run);
}

void show_keys(ResultVisitor& v, const CaptureOfSeries& capture) {
  const RunOutcome run = capture.run.value_or(RunOutcome{});
  v("file", capture.file, "the capture");
  v.word("status", status_of(capture),
         {"finished", "interrupted", "stopped", "not begun", "finished before"},
         "how the run ended");
  v.when(capture.run.has_value(), [&] { v("reason", run.reason, "why it ended"); });
  v("error", error_of(capture),
    "why it did not finish, or lacks what homing at the end of its series has shown");
  v.when(capture.run.has_value(), [&] { show_run(v, run); });
  v.when(!capture.specimen.empty(),
         [&] { v("specimen", capture.specimen, "id of the specimen, with --repeat"); });
  v.when(capture.touch > 0,
         [&] { v("touch", capture.touch, "number of the touch, with --repeat"); });
}

}  // namespace viscard
