#include "rig/stages/polled_stage.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/who_answers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kStatusTimeout_wall_s = 0.25;
constexpr double kForgetQuestion_wall_s = 1.0;  // no answer is expected after this time
// A planner begins and joins moves in its own way (10 ms were seen with Marlin), and the resonator
// of an AVR board may be off by half a percent.
constexpr double kUsualLag_wall_s = 0.03;
constexpr double kUsualLagShare = 0.01;  // of the duration of a move
constexpr double kTimesPrompt = 4.0;     // timeout over the mean time of prompt answers

}  // namespace

PolledStage::PolledStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                         RecordSink sink, double patience)
    : transport_(transport),
      config_(config),
      clock_(clock),
      sink_(std::move(sink)),
      patience_(patience),
      toward_(config.toward_specimen < 0 ? -1.0 : 1.0) {}

void PolledStage::receive() {
  const Chunk chunk = transport_.read_available();
  if (chunk.bytes.empty()) return;
  sink_(RawBytes{Device::kStage, false, chunk.time_s, chunk.bytes});
  split(chunk);
}

void PolledStage::split(const Chunk& chunk) {
  // No wire time is subtracted: a report bounds the start of a move, and only the stamp is safe.
  splitter_.feed(chunk.bytes, chunk.time_s);
}

void PolledStage::note(double time_s, const std::string& name, const std::string& value,
                       const std::string& text) const {
  sink_(RunEvent{time_s, name, value, text});
}

bool PolledStage::wait_for(const std::function<bool()>& is_there, const Pump& pump,
                           double wall_s) const {
  const double deadline_s = clock_.awake_s() + wall_s * patience_;
  while (!is_there()) {
    if (clock_.awake_s() > deadline_s) return false;
    pump();
  }
  return true;
}

void PolledStage::await_report(const Pump& pump, double wall_s, const std::string& remedy) {
  const std::size_t before = n_reports_;
  polls_ = true;
  next_poll_s_ = clock_.now_s();
  if (wait_for([&] { return n_reports_ > before; }, pump, wall_s)) return;
  throw RigError("the stage on '" + transport_.name() + "' does not report its position. " +
                 remedy);
}

void PolledStage::hear(const std::string& line) {
  constexpr std::size_t kMost = 12;
  if (heard_.size() < kMost && !trimmed(line).empty()) heard_.push_back(line);
}

void PolledStage::throw_no_answer(const std::string& what, const std::string& if_unreadable,
                                  const std::string& otherwise) const {
  const bool is_noise = splitter_.n_bytes() > 20 && splitter_.unprintable_fraction() > 0.2;
  const std::string known = is_noise ? "" : who_answers(heard_);
  throw RigError("no " + what + " answered on '" + transport_.name() + "' (" +
                 std::to_string(splitter_.n_bytes()) + " bytes received). " +
                 (is_noise ? "They are mostly unreadable: " + if_unreadable
                           : quoted_lines(heard_) + (known.empty() ? otherwise : known)));
}

void PolledStage::take_report(double time_s, double position_m, const std::string& state) {
  reported_m_ = position_m + 0.0;  // no negative zero
  ++n_reports_;
  sink_(StageReport{time_s, reported_m_, state});
}

void PolledStage::asked(double now_s) {
  asked_s_.push_back(now_s);
  is_answered_since_ = false;
  is_last_missed_ = false;
}

std::optional<double> PolledStage::question_answered(double time_s) {
  if (asked_s_.empty()) return std::nullopt;
  const double asked_s = asked_s_.front();
  if (asked_s_.size() == 1) take_latency(asked_s, time_s);
  asked_s_.pop_front();
  n_missed_ = 0;
  is_last_missed_ = false;
  is_answered_since_ = !asked_s_.empty();
  return asked_s;
}

void PolledStage::forget_questions() {
  asked_s_.clear();
  is_last_missed_ = false;
  n_missed_ = 0;
}

bool PolledStage::awaits_report(double now_s) {
  if (asked_s_.empty()) return false;
  if (now_s - asked_s_.back() <= clock_.from_wall_s(kStatusTimeout_wall_s)) return true;
  // On a line with prompt answers, the report that was taken for the answer to an older question
  // answered this one, and the older one was lost. From here on questions and answers match again.
  const bool is_prompt = latency_.n > 0 && kTimesPrompt * latency_.mean_s < kStatusTimeout_wall_s;
  if (is_answered_since_ && is_prompt) {
    latency_.n_lost += static_cast<int>(asked_s_.size());
    forget_questions();
    return false;
  }
  if (!is_last_missed_) {
    is_last_missed_ = true;
    count_miss();
  }
  const double oldest_s = now_s - clock_.from_wall_s(kForgetQuestion_wall_s);
  while (!asked_s_.empty() && asked_s_.front() < oldest_s) {
    asked_s_.pop_front();
    ++latency_.n_lost;
  }
  return false;
}

void PolledStage::take_latency(double asked_s, double time_s) {
  const double took_s = (time_s - asked_s) / clock_.speed();
  latency_.mean_s += (took_s - latency_.mean_s) / ++latency_.n;
  latency_.longest_s = std::max(latency_.longest_s, took_s);
}

void PolledStage::count_miss() {
  constexpr int kMostMisses = 20;  // times 250 ms without any report: it is gone
  if (++n_missed_ < kMostMisses) return;
  throw RigError("the stage has stopped answering on '" + transport_.name() +
                 "'. Check its cable and supply; it may still be moving");
}

void PolledStage::plan_poll(double now_s, double every_s) {
  next_poll_s_ = now_s + every_s;
  if (is_moving() && expected_end_s_ > now_s) {
    next_poll_s_ = std::min(next_poll_s_, expected_end_s_ + 2e-3);
  }
}

void PolledStage::watch_path(const StageMove& move, double slack_m, int& n_astray) {
  constexpr int kMostAstray = 2;  // a single one may have a garbled digit
  const double low_m = std::min(move.from_m, move.to_m) - slack_m;
  const double high_m = std::max(move.from_m, move.to_m) + slack_m;
  if (reported_m_ >= low_m && reported_m_ <= high_m) {
    n_astray = 0;
    return;
  }
  next_poll_s_ = clock_.now_s();
  if (++n_astray < kMostAstray) return;
  stop_hard();
  throw StageAlarm("the stage was sent to " + text_from_number(move.to_m * 1e3, 3) +
                   " mm and is at " + text_from_number(reported_m_ * 1e3, 3) +
                   " mm, outside of its path: it was stopped at once. Check its cable for "
                   "interference, then start the run again");
}

void PolledStage::watch_end(double now_s, const StageMove& move, double late_before_s,
                            std::optional<double> progress_s) const {
  constexpr double kNoEnd_wall_s = 5.0;
  now_s -= clock_.late_s() - late_before_s;  // nobody listened meanwhile
  const double patience_s = clock_.from_wall_s(patience_ * kNoEnd_wall_s);
  if (now_s < expected_end_s_ + 0.5 * duration_s(move) + patience_s) return;
  if (progress_s && now_s < *progress_s + patience_s) return;
  throw RigError(
      "the stage should have come to rest " + text_from_number(now_s - expected_end_s_, 1) +
      " s ago and does not report that it has. Switch it off and on, home it, then start "
      "the run again");
}

void PolledStage::stopped_by_error(const std::function<void()>& part) {
  try {
    part();
  } catch (...) {
    try {
      stop_hard();
    } catch (const RigError&) {
      // The port is gone, and the first error says more.
    }
    throw;
  }
}

void PolledStage::throw_elsewhere(double target_m, const std::string& state,
                                  const std::string& look_for) const {
  throw RigError("the stage stands at " + text_from_number(reported_m_ * 1e3, 4) +
                 " mm and did not reach " + text_from_number(target_m * 1e3, 4) + " mm (" + state +
                 "). Look for " + look_for + ", then start the run again");
}

void PolledStage::throw_reference_lost() {
  exact_m_.reset();
  throw DeviceRestarted(
      "the stage lost its reference position in the middle of the run (was its supply cut?). "
      "Home it, then start the run again");
}

void PolledStage::throw_no_rest() const {
  throw RigError("the stage on '" + transport_.name() +
                 "' does not come to rest: IT MAY STILL PRESS. Lift the punch by hand");
}

void PolledStage::hand_out(const std::optional<MoveTracker>& tracker, const std::string& purpose,
                           double end_m) {
  exact_m_ = end_m;
  lag_s_ = 0.0;
  if (!tracker) return;
  CommandedMove commanded = tracker->best(end_m);
  commanded.purpose = purpose;
  if (const int n = tracker->n_contradictions(); n >= 2) {
    const double lag_s = tracker->lag_s();
    const double usual_s =
        clock_.from_wall_s(kUsualLag_wall_s) + kUsualLagShare * duration_s(tracker->move());
    lag_s_ = lag_s > usual_s ? lag_s : 0.0;
    note(clock_.now_s(), "move_doubtful", purpose,
         std::to_string(n) +
             " position reports do not agree with the speed and acceleration in the controller's "
             "settings: the move was " +
             (lag_s > 0.0 ? "up to " + text_from_number(lag_s, 3) + " s late" : "ahead of them"));
  }
  sink_(commanded);
}

void throw_no_reference() {
  throw RigError(
      "the stage has no reference position since it was switched on. Clear the way and set home = "
      "true under [stage] of the rig file, or home it by its own software");
}

void check_travel(double to_m, double start_m, double travel_m) {
  if (to_m <= start_m + travel_m) return;
  throw RigError("the move to " + text_from_number((to_m - start_m) * 1e3, 3) +
                 " mm goes beyond the stage's travel of " + text_from_number(travel_m * 1e3, 3) +
                 " mm from where it started. Bring the punch nearer to the specimen by hand, or "
                 "raise travel in the rig file");
}

double within_travel_m(double from_m, double to_m, const StageDynamics& dynamics,
                       const std::string& settings) {
  constexpr double kSlack = 1e-6;  // of a step: rounding of the limits themselves
  const double slack_m = kSlack / dynamics.steps_per_m;
  if (from_m < dynamics.lowest_m - slack_m || from_m > dynamics.highest_m + slack_m) {
    throw RigError("the stage stands at " + text_from_number(from_m * 1e3, 3) +
                   " mm, outside of the travel that the controller allows (" + settings +
                   "), so it refuses every move. Home it (home = true under [stage] of the rig "
                   "file), or change these settings");
  }
  if (to_m < from_m && to_m < dynamics.lowest_m) {
    const double step = std::ceil(dynamics.lowest_m * dynamics.steps_per_m - kSlack);
    return std::min(from_m, step / dynamics.steps_per_m);
  }
  if (to_m > from_m && to_m > dynamics.highest_m + slack_m) {
    throw RigError("the move to " + text_from_number(to_m * 1e3, 3) +
                   " mm goes beyond the controller's own travel, which ends at " +
                   text_from_number(dynamics.highest_m * 1e3, 3) + " mm (" + settings +
                   "). Bring the punch nearer to the specimen by hand, or "
                   "correct these settings");
  }
  return to_m;
}

}  // namespace viscard
