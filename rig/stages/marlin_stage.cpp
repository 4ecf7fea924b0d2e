#include "rig/stages/marlin_stage.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kQuiet_wall_s = 0.05;  // an ok may follow a Resend within this time
constexpr double kPollPieces_s = 0.1;   // pieces share the line
constexpr double kPollAtRest_s = 0.2;
constexpr double kPlannerSpeed_m_s = 0.05e-3;  // MINIMUM_PLANNER_SPEED
constexpr double kPlannerSteps_s = 120.0;      // MINIMAL_STEP_RATE

}  // namespace

MarlinStage::MarlinStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                         RecordSink sink)
    : PolledStage(transport, config, clock, std::move(sink)) {}

double MarlinStage::setting(const std::string& name) const {
  const auto found = settings_.find(name);
  return found == settings_.end() ? 0.0 : found->second;
}

double MarlinStage::steps_per_m() const {
  return setting(std::string("M92") + config_.axis) * 1e3;
}

// Moves without an extruder use the acceleration of travel (M204 T), within that of the axis.
StageDynamics MarlinStage::dynamics() const {
  const double travel = settings_.count("M204T") > 0 ? setting("M204T") : setting("M204S");
  const double axis = setting(std::string("M201") + config_.axis);
  return {steps_per_m(), std::min(travel, axis) * 1e-3,
          setting(std::string("M203") + config_.axis) * 1e-3,
          std::max(kPlannerSpeed_m_s, kPlannerSteps_s / steps_per_m())};
}

void MarlinStage::write(const std::string& bytes) {
  sink_(RawBytes{Device::kStage, true, clock_.now_s(), bytes});
  transport_.write(bytes);
}

void MarlinStage::send(const std::string& command) {
  number_ = command.rfind("M110", 0) == 0 ? 0 : number_ + 1;
  was_piece_ = command.rfind("G1", 0) == 0;
  const double now_s = clock_.now_s();
  in_flight_ = Sent{command, number_, now_s, now_s, 1};
  write(format_marlin_line(number_, command));
}

// Without an answer a line may have been lost, or its answer. Its number tells the firmware which.
void MarlinStage::send_again(double now_s) {
  Sent& sent = *in_flight_;
  const bool is_asked_for = sent.again_at_s && now_s >= *sent.again_at_s;
  const double silence_wall_s = is_unsettled_ ? 1.5 * kStopped_wall_s : kSilence_wall_s;
  const bool is_overdue =
      !sent.again_at_s && now_s > sent.written_s + clock_.from_wall_s(silence_wall_s);
  if (!is_asked_for && !is_overdue) return;
  if (active_ && active_->is_stopping && sent.command.rfind("G1", 0) == 0) {
    return in_flight_.reset();  // no piece of a move may follow its stop
  }
  if (sent.command.rfind("G28", 0) == 0 && !is_asked_for) return;  // takes its time
  if (sent.n_sent >= kMostTries) {
    const std::string command = sent.command;
    in_flight_.reset();
    throw RigError("the stage did not answer '" + command + "' on '" + transport_.name() +
                   "'. Check its cable and supply");
  }
  if (sent.command == kAsk) ++latency_.n_lost;
  ++sent.n_sent;
  sent.written_s = now_s;
  sent.again_at_s.reset();
  write(format_marlin_line(sent.number, sent.command));
}

void MarlinStage::service() {
  const double now_s = clock_.now_s();  // what was answered before has been sent by then
  receive();
  while (const auto line = splitter_.next()) take_line(*line);
  drive(now_s);
}

void MarlinStage::take_line(const ReceivedLine& line) {
  const std::string text(trimmed(line.text));
  if (text.empty()) return;
  heard_s_ = line.time_s;
  if (firmware_.empty()) hear(text);
  if (is_marlin_start(text)) return take_start(line.time_s);
  if (is_marlin_ok(text)) return take_ok(line.time_s);
  if (const auto number = parse_marlin_resend(text)) return take_resend(*number, line.time_s);
  if (const auto count = parse_marlin_count(text, config_.axis)) {
    return take_count(*count, line.time_s);
  }
  take_other(text, line.time_s);
}

void MarlinStage::take_other(const std::string& text, double time_s) {
  if (is_marlin_busy(text)) {
    if (in_flight_) in_flight_->written_s = time_s;
    return;
  }
  if (const auto firmware = parse_marlin_firmware(text)) firmware_ = *firmware;
  has_emergency_parser_ = has_emergency_parser_ || has_marlin_emergency_parser(text);
  add_marlin_settings(text, settings_);
  const auto error = parse_marlin_error(text);
  const auto message = error ? error : parse_marlin_echo(text);
  if (message) last_message_ = shown_bytes(*message);
  if (message && !is_recovering_) {
    note(time_s, "stage_message", last_message_, "The stage says: " + last_message_);
  }
  if (is_marlin_endstop(text)) take_error("a limit switch (" + text + ")");
  if (error) take_error("'" + *error + "'");
}

void MarlinStage::take_error(const std::string& text) {
  if (is_recovering_) return;
  exact_m_.reset();
  throw StageAlarm("the stage stopped with " + text);
}

void MarlinStage::take_start(double time_s) {
  ++n_starts_;
  in_flight_.reset();
  is_stop_open_ = is_piece_behind_ = is_unsettled_ = false;
  n_stale_ = 0;
  if (is_recovering_) return;
  note(time_s, "stage_welcome", firmware_, "The stage's controller started");
  exact_m_.reset();
  is_recovering_ = true;  // its banner follows
  throw DeviceRestarted(
      "the stage's controller restarted in the middle of the run (power dip, or its reset line); "
      "its position is lost. Check its supply, then start the run again");
}

void MarlinStage::take_ok(double time_s) {
  if (in_flight_) {
    if (in_flight_->again_at_s) return;  // the ok that follows a Resend in some versions
    // Answers come in order, so no ok after the report is a stale one.
    if (in_flight_->command == kAsk) {
      if (n_stale_ > 0 && !in_flight_->is_reported) {
        --n_stale_;
        return;
      }
      n_stale_ = 0;
      is_unsettled_ = false;
    }
    return answered(*std::exchange(in_flight_, std::nullopt), time_s);
  }
  if (time_s < quiet_until_s_) return;
  if (n_stale_ > 0) {
    --n_stale_;
    return;
  }
  if (is_stop_open_) {
    is_stop_open_ = false;
    stopped_s_ = time_s;
    quiet_until_s_ = time_s + clock_.from_wall_s(kQuiet_wall_s);  // of a stop that came twice
    n_stale_ = n_stops_ - 1;
    is_unsettled_ = is_unsettled_ || n_stops_ > 1;
    if (std::exchange(is_piece_behind_, false) && has_emergency_parser_) write_stop();
    return;
  }
  note(time_s, "stage_unexpected_answer", "ok",
       "An answer from the stage to no open line was ignored");
}

void MarlinStage::take_resend(long number, double time_s) {
  quiet_until_s_ = time_s + clock_.from_wall_s(kQuiet_wall_s);
  if (!in_flight_) return;
  Sent& sent = *in_flight_;
  const bool is_first = sent.command.rfind("M110", 0) == 0;
  if (number == sent.number + 1 && !is_first) {  // it had arrived, and its answer was lost
    return answered(*std::exchange(in_flight_, std::nullopt), time_s);
  }
  if (!is_first && number != sent.number && number != sent.number - 1) {
    return take_start(time_s);  // it counts lines from elsewhere: it restarted
  }
  // One less: the line before this one was lost, which a later piece or question replaces.
  if (!is_first) sent.number = number_ = number;
  sent.again_at_s = quiet_until_s_;
}

void MarlinStage::answered(const Sent& sent, double time_s) {
  // BLOCK_DELAY_FOR_1ST_MOVE: a single move begins up to 0.1 s (Prusa: 0.2 s) after its ok.
  constexpr double kFirstBlock_s = 0.25;
  if (awaited_ == sent.command) awaited_.reset();
  // Sent again, M110 is answered again; any other line is refused because of its number.
  if (sent.n_sent > 1 && sent.command.rfind("M110", 0) == 0) {
    quiet_until_s_ = time_s + clock_.from_wall_s(2.0 * kSilence_wall_s);
  }
  if (!active_ || !active_->tracker || sent.command.rfind("G1", 0) != 0) return;
  if (!active_->ok_s) active_->tracker->acknowledged(time_s, kFirstBlock_s);
  active_->ok_s = time_s;
}

void MarlinStage::take_count(long long count, double time_s) {
  if (!in_flight_ || in_flight_->command != kAsk) return;
  in_flight_->is_reported = true;
  if (!(steps_per_m() > 0.0)) return;  // asked only for the sake of the answer
  if (in_flight_->n_sent == 1 && !is_stop_open_) take_latency(in_flight_->first_s, time_s);
  if (!active_) rest_latency_s_ = std::max(rest_latency_s_, time_s - in_flight_->first_s);
  count_ = count;
  take_report(time_s, metres(count), active_ ? "moves" : "rests");
  if (active_) follow_move(in_flight_->first_s, time_s);
}

void MarlinStage::drive(double now_s) {
  if (active_ && active_->tracker && !active_->is_stopping) {
    watch_end(now_s, active_->planned, active_->late_before_s, active_->progress_s);
  }
  if (is_stop_open_) {
    if (in_flight_ && in_flight_->again_at_s) return send_again(now_s);
    if (now_s < stop_written_s_ + clock_.from_wall_s(kStopped_wall_s)) return;
    if (n_stops_ < (is_recovering_ ? kMostStopsAtStart : kMostStops)) return write_stop();
    is_stop_open_ = false;
    n_stale_ = n_stops_;
    is_unsettled_ = true;
    throw RigError("the stage on '" + transport_.name() +
                   "' does not answer a stop: IT MAY STILL PRESS. Lift the punch by hand");
  }
  if (in_flight_) return send_again(now_s);
  if (now_s < quiet_until_s_) return;
  if (is_unsettled_) return send(kAsk);
  if (!outbox_.empty()) {
    const std::string command = std::move(outbox_.front());
    outbox_.pop_front();
    return send(command);
  }
  // A line that is so slow that pieces are always wanted still needs a report now and then.
  const bool is_report_old = was_piece_ && polls_ && now_s > next_poll_s_ + kPollPieces_s;
  if (!is_report_old && wants_piece(now_s)) return send_piece();
  if (!polls_ || now_s < next_poll_s_) return;
  send(kAsk);
  plan_poll(now_s, active_ ? kPollPieces_s : kPollAtRest_s);
}

}  // namespace viscard
