#include "rig/stages/asked_stage.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <utility>

namespace viscard {
AskedStage::AskedStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                       RecordSink sink, Dialect dialect)
    : PolledStage(transport, config, clock, std::move(sink)), dialect_(std::move(dialect)) {}

std::vector<std::string> AskedStage::advice() const {
  if (dynamics_.acceleration_m_s2 >= 0.1) return {};
  return {"the acceleration is " + text_from_number(dynamics_.acceleration_m_s2 * 1e3, 1) +
          " mm/s2, so stops take long: set it higher on the controller if the stage allows that"};
}

double AskedStage::send(const std::string& words) {
  const std::string bytes = bytes_of(words);
  const double written_s = clock_.now_s();
  sink_(RawBytes{Device::kStage, true, written_s, bytes});
  transport_.write(bytes);
  return written_s;
}

void AskedStage::service() {
  const double now_s = clock_.now_s();  // what was answered before has been sent by then
  receive();
  while (const auto line = splitter_.next()) take_line(*line);
  drive(now_s);
}

void AskedStage::take_line(const ReceivedLine& line) {
  if (trimmed(line.text).empty()) return;
  if (is_name(line.text)) {
    identity_ = dialect_.name + ", " + std::string(trimmed(line.text));
    is_lost_ = false;
    return;
  }
  const auto answer =
      question_ && !is_lost_ ? answer_in(question_->job.words, line.text) : std::nullopt;
  if (!answer) {
    hear(line.text);
    note(line.time_s, "stage_unexpected_answer", shown_bytes(line.text, 80),
         "A line from the stage that answers no open question was ignored");
    return;
  }
  n_missed_ = 0;
  const Sent question = *std::exchange(question_, std::nullopt);
  take_answer(question, *answer, line.time_s);
}

void AskedStage::take_answer(const Sent& question, const std::string& answer, double time_s) {
  const std::string& words = question.job.words;
  if (question.job.origin == Origin::kAsk) asked_answer_ = answer;
  if (question.job.origin == Origin::kMove) take_move_answer(words, answer, time_s);
  if (question.job.origin != Origin::kRound) return;
  if (words == dialect_.position_question) {
    take_position(question, answer, time_s);
  } else {
    take_state(words, answer);
  }
  if (round_.empty()) judge();
}

void AskedStage::take_position(const Sent& question, const std::string& answer, double time_s) {
  take_latency(question.written_s, time_s);
  take_report(time_s, toward_ * number_from_text(answer).value_or(0.0) * 1e-3,
              seen_.is_moving ? "MOVING" : "REST");
  if (active_ && active_->tracker && !active_->is_stopping) {
    active_->tracker->reported(
        question.written_s, time_s,
        end_of_way_m(active_->planned, reported_m_, !seen_.is_moving, kNear_m));
  }
}

// Looks for the controller after a lost answer; true while it has not answered with its name.
bool AskedStage::find_again(double now_s) {
  constexpr double kAnswer_wall_s = 0.5;
  constexpr double kName_wall_s = 0.25;  // between questions for the name
  if (question_ && now_s - question_->written_s > clock_.from_wall_s(kAnswer_wall_s)) {
    Sent lost = *std::exchange(question_, std::nullopt);
    ++latency_.n_lost;
    count_miss();
    is_lost_ = true;
    next_name_s_ = now_s;
    const Origin origin = lost.job.origin;
    if (origin == Origin::kRound) round_.push_front(lost.job.words);
    if (origin == Origin::kMove || (origin == Origin::kAsk && --n_tries_left_ > 0)) {
      jobs_.push_front(std::move(lost.job));
    }
  }
  if (!is_lost_ || now_s < next_name_s_) return is_lost_;
  if (n_missed_ > 0) count_miss();
  send(dialect_.name_question);
  next_name_s_ = now_s + clock_.from_wall_s(kName_wall_s);
  return true;
}

void AskedStage::drive(double now_s) {
  if (active_ && active_->accepted_s) {
    watch_end(now_s, active_->planned, active_->late_before_s);
  }
  if (!may_write() || find_again(now_s)) return;
  while (!question_ && !jobs_.empty() && now_s >= free_at_s_) {
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    send_job(std::move(job));
  }
  if (!question_ && jobs_.empty() && now_s >= free_at_s_) ask_in_round(now_s);
}

void AskedStage::send_job(Job job) {
  const double written_s = send(job.words);
  if (is_question(job.words)) {
    question_ = Sent{std::move(job), written_s};
    return;
  }
  free_at_s_ = written_s + clock_.from_wall_s(dialect_.after_command_wall_s);
  if (!job.begins_move || !active_) return;
  active_->planned.start_time_s = written_s;
  active_->late_before_s = clock_.late_s();
  active_->tracker.emplace(active_->planned, 1.5 / dynamics_.steps_per_m);
  expected_end_s_ = written_s + duration_s(active_->planned);
}

void AskedStage::ask_in_round(double now_s) {
  if (!polls_) return;
  if (round_.empty()) {
    if (now_s < next_poll_s_) return;
    seen_ = Seen{};
    plan_round();
    plan_poll(now_s, active_ ? kPollMoving_s : kPollResting_s);
  }
  const std::string words = round_.front();
  round_.pop_front();
  const double written_s = send(words);
  if (seen_.asked_s == 0.0) seen_.asked_s = written_s;
  question_ = Sent{{words, Origin::kRound}, written_s};
}

void AskedStage::abort_round() {
  round_.clear();
  if (question_ && question_->job.origin != Origin::kAsk) {
    question_->job.origin = Origin::kDropped;
  }
}

std::optional<std::string> AskedStage::ask_if_known(const std::string& question, const Pump& pump,
                                                    int n_tries) {
  asked_answer_.reset();
  n_tries_left_ = n_tries;
  jobs_.push_back({question, Origin::kAsk});
  const double longest_wall_s = 3.0 * n_tries;
  wait_for([&] { return asked_answer_ || n_tries_left_ <= 0; }, pump, longest_wall_s);
  return asked_answer_;
}

std::string AskedStage::ask(const std::string& question, const Pump& pump) {
  constexpr int kTries = 4;
  const auto answer = ask_if_known(question, pump, kTries);
  if (answer) return *answer;
  throw RigError("the stage on '" + transport_.name() + "' did not answer '" +
                 shown_bytes(question) +
                 "'. Check its cable, and device and axis_number under [stage] of the rig file");
}

double AskedStage::number(const std::string& question, const Pump& pump) {
  const std::string answer = ask(question, pump);
  const auto value = number_from_text(answer);
  if (value) return *value;
  throw RigError("the stage answered '" + shown_bytes(answer) + "' when asked '" + question + "'");
}

void AskedStage::command(const std::string& words, const Pump& pump) {
  ask(dialect_.error_question, pump);  // an old error is not that of this command
  send_later(words);
  const std::string trouble = trouble_in(ask(dialect_.error_question, pump));
  if (!trouble.empty()) throw RigError("the stage refused '" + words + "': " + trouble);
}

bool AskedStage::await_name(const Pump& pump) {
  constexpr double kFirstAnswer_wall_s = 3.0;
  jobs_.clear();
  abort_round();
  question_.reset();
  is_lost_ = true;
  next_name_s_ = 0.0;
  return wait_for([&] { return !is_lost_; }, pump, kFirstAnswer_wall_s);
}

void AskedStage::restore_speed() {
  if (speed_mm_s_ == 0.0 || speed_mm_s_ == first_speed_mm_s_) return;
  try {
    send(speed_words(first_speed_mm_s_));
  } catch (...) {
    // The stage is gone.
  }
}

}  // namespace viscard
