#include "rig/stages/grbl_stage.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kFirstPoll_s = 0.1;  // rig time after a move was written

int axis_index(char axis) {
  constexpr std::string_view kAxes = "XYZABC";
  const std::size_t index = kAxes.find(axis);
  if (index == std::string_view::npos) {
    throw RigError(std::string("stage axis '") + axis + "' is none of X Y Z A B C");
  }
  return static_cast<int>(index);
}

}  // namespace

GrblStage::GrblStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                     RecordSink sink, double patience)
    : PolledStage(transport, config, clock, std::move(sink), patience),
      axis_(axis_index(config.axis)) {}

double GrblStage::setting(int number, double otherwise) const {
  const auto found = settings_.find(number);
  return found == settings_.end() ? otherwise : found->second;
}

// gnea/grbl moves no slower than 1 mm/min (config.h, MINIMUM_FEED_RATE), and no slower than one
// step in 8 periods of a 16-bit timer at 16 MHz (stepper.c: cycles_per_tick at AMASS level 3).
// grblHAL runs on other processors and has no such limit.
double GrblStage::least_speed_m_s() const {
  if (is_hal_) return 0.0;
  constexpr double kLeastFeed_m_s = 1e-3 / 60.0;
  constexpr double kLeastSteps_s = 16e6 / (8.0 * 65535.0);
  return std::max(kLeastFeed_m_s, kLeastSteps_s / (setting(100 + axis_, 0.0) * 1e3));
}

StageDynamics GrblStage::dynamics() const {
  StageDynamics found{setting(100 + axis_, 0.0) * 1e3, setting(120 + axis_, 0.0) * 1e-3,
                      setting(110 + axis_, 0.0) / 60e3, least_speed_m_s()};
  // With $20=1 a target outside of 0 to -$130 is refused (system.c, system_check_travel_limits).
  // grblHAL may count from the other end, so it is not checked here.
  if (setting(20, 0.0) != 0.0 && !is_hal_) {
    const double far_m = -toward_ * setting(130 + axis_, 0.0) * 1e-3;
    found.lowest_m = std::min(0.0, far_m);
    found.highest_m = std::max(0.0, far_m);
  }
  return found;
}

// Reports have three decimals of a mm ($13=1: four of an inch), and the motor stands within half a
// step of its count.
double GrblStage::resolution_m() const {
  const double decimals_m = setting(13, 0.0) != 0.0 ? 1.27e-6 : 0.5e-6;
  return decimals_m + 1.0 / dynamics().steps_per_m;
}

void GrblStage::send_line(const std::string& line, bool is_awaited) {
  pending_.push_back({line, is_awaited});
  sink_(RawBytes{Device::kStage, true, clock_.now_s(), line + "\n"});
  transport_.write(line + "\n");
}

void GrblStage::send_realtime(char c) {
  transport_.write(std::string_view(&c, 1));
  sink_(RawBytes{Device::kStage, true, clock_.now_s(), std::string(1, c)});
}

void GrblStage::service() {
  receive();
  while (const auto line = splitter_.next()) take_line(*line);
  if (polls_) poll_status();
}

void GrblStage::take_line(const ReceivedLine& line) {
  if (const auto welcome = parse_grbl_welcome(line.text)) {
    return take_welcome(*welcome, line.time_s);
  }
  if (!is_connected_) return hear(line.text);  // sent before the controller started
  if (const auto status = parse_grbl_status(line.text)) return take_status(*status, line.time_s);
  if (is_grbl_ok(line.text)) return take_answer(std::nullopt, line.time_s);
  if (const auto error = parse_grbl_error(line.text)) return take_answer(*error, line.time_s);
  if (const auto alarm = parse_grbl_alarm(line.text)) return take_alarm(*alarm, line.time_s);
  if (const auto entry = parse_grbl_setting(line.text)) {
    settings_[entry->number] = entry->value;
  } else if (const auto options = parse_grbl_build_options(line.text)) {
    build_options_ = options;
  } else if (const auto message = parse_grbl_message(line.text)) {
    note(line.time_s, "stage_message", *message, "The stage says: " + *message);
  } else if (!is_grbl_push(line.text)) {
    note(line.time_s, "stage_unreadable", shown_bytes(line.text, 256),
         "A line from the stage could not be read");
  }
}

void GrblStage::take_answer(std::optional<int> error, double time_s) {
  if (pending_.empty()) {
    note(time_s, "stage_unexpected_answer", error ? std::to_string(*error) : "ok",
         "An answer from the stage to no open line was ignored");
    return;
  }
  const Pending answered = std::move(pending_.front());
  pending_.pop_front();
  if (active_ && !active_->has_ok && answered.line.rfind("$J=", 0) == 0 && !error) {
    active_->has_ok = true;
    active_->ok_s = time_s;
    active_->tracker.acknowledged(time_s);
    expected_end_s_ = active_->tracker.latest_end_s();
    // A cancel that arrived before its jog had no effect, so it is sent again.
    if (active_->is_stopping) stop_soft();
  }
  if (!error) return;
  if (answered.is_awaited) {
    awaited_error_ = error;
    return;
  }
  active_.reset();
  throw RigError("the stage refused '" + answered.line + "': " + grbl_error_text(*error));
}

void GrblStage::take_alarm(int code, double time_s) {
  alarm_code_ = code;
  note(time_s, "stage_alarm", std::to_string(code), grbl_alarm_text(code, is_hal_));
  if (is_homing()) {
    pending_.clear();
    awaits_welcome_ = true;
    throw_homing_failed("with " + grbl_alarm_text(code, is_hal_));
  }
  if (is_recovering_ || awaits_welcome_) return;
  exact_m_.reset();
  throw StageAlarm("the stage stopped with " + grbl_alarm_text(code, is_hal_));
}

void GrblStage::take_welcome(const GrblWelcome& welcome, double time_s) {
  is_hal_ = welcome.is_hal;
  version_ = (welcome.is_hal ? "grblHAL " : "Grbl ") + welcome.version;
  ++n_welcomes_;
  const bool was_homing = is_homing();
  pending_.clear();
  forget_questions();
  work_offset_mm_.clear();
  const bool was_expected = awaits_welcome_;
  awaits_welcome_ = false;
  is_connected_ = true;
  note(time_s, "stage_welcome", version_, "The stage's controller started: " + version_);
  if (was_homing) throw_homing_failed("with a restart of its controller");
  if (!was_expected && !is_recovering_) {
    exact_m_.reset();
    throw DeviceRestarted(
        "the stage's controller restarted in the middle of the run (power dip, or its reset line); "
        "its position is lost. Check its supply, then start the run again");
  }
}

void GrblStage::begin_move(double to_m, double speed_m_s, const std::string& purpose) {
  if (active_) throw RigError("a move was asked for while the stage was still moving");
  const StageDynamics limits = dynamics();
  const double from_m = position_m();
  to_m = within_travel_m(from_m, quantised_m(to_m, limits.steps_per_m), limits,
                         "soft limits: $20, $130-132");
  if (start_m_) check_travel(to_m, *start_m_, config_.travel_m);
  expected_end_s_ = clock_.now_s();
  if (std::abs(to_m - from_m) < 0.5 / limits.steps_per_m) return;
  // Not below the smallest speed, so that the record states the true speed.
  const double held_m_s = std::max(std::min(speed_m_s, limits.max_speed_m_s), limits.min_speed_m_s);
  const double feed_mm_min = std::max(std::round(held_m_s * 60e6) * 1e-3, 0.001);
  const double written_s = clock_.now_s();
  const StageMove move{written_s, from_m, to_m, feed_mm_min / 60e3, limits.acceleration_m_s2};
  validate(move);
  active_ = ActiveMove{MoveTracker(move, resolution_m()), purpose};
  active_->progress_s = written_s;
  active_->late_before_s = clock_.late_s();
  expected_end_s_ = written_s + duration_s(move);
  next_poll_s_ = written_s + kFirstPoll_s;
  send_line(format_grbl_jog(config_.axis, toward_ * to_m * 1e3, feed_mm_min), false);
}

void GrblStage::stop_soft() {
  send_realtime(grbl::kJogCancel);
  if (!active_) return;
  active_->is_stopping = true;
  active_->stop_s = clock_.now_s();
  next_poll_s_ = active_->stop_s;
}

void GrblStage::stop_hard() {
  send_realtime(grbl::kSoftReset);
  awaits_welcome_ = true;
  is_recovering_ = true;
  pending_.clear();
  exact_m_.reset();
}

}  // namespace viscard
