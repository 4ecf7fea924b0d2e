#include "rig/stages/zaber_stage.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

constexpr double kAnswer_wall_s = 0.25;
constexpr int kMostSends = 4;
constexpr const char* kAskPosition = "get pos";

}  // namespace

ZaberStage::ZaberStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                       RecordSink sink)
    : PolledStage(transport, config, clock, std::move(sink)) {
  if (!(config_.microstep_m > 0.0)) {
    throw RigError(
        "a Zaber stage counts microsteps, and the rig file does not give their length. Set "
        "microstep under [stage], such as \"0.047625 um\", from the maker's page of the stage");
  }
}

ZaberStage::~ZaberStage() {
  if (speed_data_ == 0 || static_cast<double>(speed_data_) == max_speed_data_) return;
  try {
    send("set maxspeed " + text_from_number(max_speed_data_, 0));
  } catch (...) {
    // The stage is gone.
  }
}

StageDynamics ZaberStage::dynamics() const {
  return {1.0 / config_.microstep_m,
          microsteps_s2_from_zaber(acceleration_data_) * config_.microstep_m,
          microsteps_s_from_zaber(max_speed_data_) * config_.microstep_m};
}

ZaberStage::Sent ZaberStage::send(const std::string& words) {
  next_id_ = (next_id_ + 1) % 100;
  const std::string line =
      format_zaber_command(config_.device, config_.axis_number, next_id_, words);
  Sent sent{next_id_, words, clock_.now_s(), 1};
  sink_(RawBytes{Device::kStage, true, sent.written_s, line});
  transport_.write(line);
  return sent;
}

void ZaberStage::service() {
  const double now_s = clock_.now_s();  // what was answered before has been sent by then
  receive();
  while (const auto line = splitter_.next()) take_line(*line);
  drive(now_s);
}

void ZaberStage::take_line(const ReceivedLine& line) {
  if (trimmed(line.text).empty()) return;
  const auto message = parse_zaber_message(line.text);
  if (!message) {
    hear(line.text);
    note(line.time_s, "stage_unreadable", shown_bytes(line.text, 80),
         "A line from the stage could not be read or has a wrong checksum");
    return;
  }
  if (message->device != config_.device) return;  // another device on the chain
  if (message->kind == ZaberMessage::Kind::kReply) return take_reply(*message, line.time_s);
  if (message->kind == ZaberMessage::Kind::kInfo) {
    note(line.time_s, "stage_message", message->data, "The stage says: " + message->data);
  } else {
    next_poll_s_ = line.time_s;  // an alert: something has changed, so ask at once
  }
}

void ZaberStage::take_reply(const ZaberMessage& reply, double time_s) {
  const auto is_answered = [&](const std::optional<Sent>& sent) {
    return sent && reply.id == sent->id;
  };
  if (is_answered(question_)) {
    const Sent question = *std::exchange(question_, std::nullopt);
    take_flag(reply, time_s);
    take_position(question, reply, time_s);
  } else if (is_answered(action_)) {
    const Sent action = *std::exchange(action_, std::nullopt);
    take_flag(reply, time_s);
    take_action_reply(action, reply, time_s);
  } else {
    note(time_s, "stage_unexpected_answer", reply.data,
         "A reply of the stage to no open question was ignored");
  }
}

void ZaberStage::take_flag(const ZaberMessage& reply, double time_s) {
  is_busy_ = reply.is_busy;
  if (reply.flag == flag_) return;
  flag_ = reply.flag;
  if (flag_ == "--") return;
  note(time_s, "stage_warning", flag_, "The stage warns: " + zaber_flag_text(flag_));
  if (is_recovering_) return;
  if (is_zaber_fault(flag_)) {
    exact_m_.reset();
    throw StageAlarm("the stage stopped with " + zaber_flag_text(flag_));
  }
  if (is_referenced_ && lacks_reference()) throw_reference_lost();
}

void ZaberStage::take_action_reply(const Sent& action, const ZaberMessage& reply, double time_s) {
  const bool is_asked_for = asked_words_ == action.words;
  const bool is_move = action.words.rfind("move abs", 0) == 0;
  // A move that was sent again after its reply was lost: the stage is carrying it out.
  const bool is_under_way =
      is_move && reply.is_rejected && reply.data == "STATUSBUSY" && action.n_sent > 1;
  if (reply.is_rejected && !is_under_way) {
    const std::string reason = zaber_rejection_text(reply.data);
    if (action.words == "estop" && reply.data == "BADCOMMAND") {
      action_ = send("stop");  // firmware without estop
      return;
    }
    if (is_asked_for) {
      action_rejection_ = reason;
      return;
    }
    actions_.clear();
    if (active_ && !active_->reply_s) active_.reset();
    throw RigError("the stage refused '" + action.words + "': " + reason);
  }
  if (is_asked_for) action_data_ = reply.data;
  if (active_ && !active_->reply_s && is_move) {
    active_->reply_s = time_s;
    active_->tracker->acknowledged(time_s);
    expected_end_s_ = active_->tracker->latest_end_s();
    next_poll_s_ = std::min(time_s + kPollMoving_s, expected_end_s_ + 2e-3);
  }
}

void ZaberStage::take_position(const Sent& question, const ZaberMessage& reply, double time_s) {
  take_latency(question.written_s, time_s);
  n_missed_ = 0;
  const auto microsteps = reply.is_rejected ? std::nullopt : number_from_text(reply.data);
  if (!microsteps) return;
  take_report(time_s, metres(*microsteps), reply.is_busy ? "BUSY" : "IDLE");
  if (active_) follow_move(question.written_s, time_s, reply.is_busy);
}

void ZaberStage::drive(double now_s) {
  const double answer_s = clock_.from_wall_s(kAnswer_wall_s);
  if (question_ && now_s - question_->written_s > answer_s) {
    question_.reset();  // a late answer is recognised by its id
    ++latency_.n_lost;
    count_miss();
  }
  if (action_ && now_s - action_->written_s > answer_s) {
    if (action_->n_sent >= kMostSends) {
      throw RigError("the stage did not answer '" + action_->words + "' on '" + transport_.name() +
                     "'. Check its cable and supply");
    }
    const int n_sent = action_->n_sent;
    action_ = send(action_->words);
    action_->n_sent = n_sent + 1;
  }
  start_action();
  if (active_ && active_->reply_s) watch_end(now_s, active_->planned, active_->late_before_s);
  if (!polls_ || question_ || now_s < next_poll_s_) return;
  question_ = send(kAskPosition);
  plan_poll(now_s, active_ ? kPollMoving_s : kPollResting_s);
}

}  // namespace viscard
