#include "rig/stages/smc_stage.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <utility>

namespace viscard {

// ST is the hard stop, too: every faster way cuts the motor, which lets go of the punch.
SmcStage::SmcStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                   RecordSink sink)
    : AskedStage(transport, config, clock, std::move(sink),
                 {.name = "Newport SMC100",
                  .settings = "Under [stage] of the rig file baud must be 57600, and device its "
                              "address",
                  .name_question = "VE",
                  .position_question = "TP",
                  .speed_question = "VA?",
                  .target_question = "PA?",
                  .error_question = "TE",
                  .soft_stop = "ST",
                  .hard_stop = "ST",
                  .limits = "SL, SR",
                  .after_command_wall_s = 0.06}) {}

// The flow control stands between the bytes of the answers.
void SmcStage::split(const Chunk& chunk) {
  std::string text;
  for (const char c : chunk.bytes) {
    if (c == kSmcXoff) {
      held_since_s_ = clock_.now_s();
    } else if (c == kSmcXon) {
      held_since_s_.reset();
    } else {
      text += c;
    }
  }
  AskedStage::split({chunk.time_s, text});
}

bool SmcStage::may_write() {
  constexpr double kLongestHold_wall_s = 2.0;  // then the XON was lost
  const double now_s = clock_.now_s();
  if (held_since_s_ && now_s - *held_since_s_ > clock_.from_wall_s(kLongestHold_wall_s)) {
    held_since_s_.reset();
    note(now_s, "stage_flow_control", "", "The stage sent XOFF and no XON for 2 s");
  }
  return !held_since_s_;
}

std::string SmcStage::bytes_of(const std::string& words) const {
  return format_smc_command(config_.device, words);
}

bool SmcStage::is_question(const std::string& words) const {
  return words.back() == '?' || words == "TS" || words == dialect_.position_question ||
         words == dialect_.error_question;
}

bool SmcStage::is_name(const std::string& line) const {
  return smc_answer_text(line, config_.device, dialect_.name_question).has_value();
}

std::optional<std::string> SmcStage::answer_in(const std::string& question,
                                               const std::string& line) const {
  const auto answer = smc_answer_text(line, config_.device, question);
  if (!answer) return std::nullopt;
  const bool is_readable = question == "TS" ? parse_smc_state(*answer).has_value()
                           : question == dialect_.error_question
                               ? answer->size() == 1
                               : number_from_text(*answer).has_value();
  return is_readable ? answer : std::nullopt;
}

std::string SmcStage::speed_words(double speed_mm_s) const {
  return "VA" + text_from_number(speed_mm_s, 6);
}

std::string SmcStage::move_words(double target_mm) const {
  return "PA" + text_from_number(target_mm, 6);
}

std::string SmcStage::trouble_in(const std::string& answer) const {
  return smc_error_text(answer);
}

// The position is asked for after the state, so that it is the one at rest.
void SmcStage::plan_round() {
  round_ = {"TS", dialect_.position_question};
}

void SmcStage::take_state(const std::string&, const std::string& answer) {
  const SmcState state = *parse_smc_state(answer);  // answer_in() has read it
  seen_.is_moving = is_smc_moving(state);
  seen_.is_on_target = is_smc_ready(state);
  seen_.holds = !is_smc_disabled(state);
  seen_.has_reference = is_smc_referenced(state) || is_smc_homing(state);
  seen_.trouble = smc_fault_text(state.faults);
}

SmcState SmcStage::state(const Pump& pump) {
  return *parse_smc_state(ask("TS", pump));
}

// The controller homes only if it has no reference: OR is sent once and never repeated.
void SmcStage::home(const Pump& pump) {
  constexpr double kHome_wall_s = 300.0;
  const double deadline_s = clock_.awake_s() + kHome_wall_s;
  command("OR", pump);
  SmcState now = state(pump);
  while (is_smc_homing(now)) {
    if (clock_.awake_s() > deadline_s) throw RigError("the homing of the stage does not end");
    now = state(pump);
  }
  if (is_smc_referenced(now)) return;
  throw RigError("the homing of the stage failed: " +
                 (now.faults == 0 ? "it reports no fault" : smc_fault_text(now.faults)));
}

void SmcStage::switch_on(const Pump& pump) {
  if (!is_smc_disabled(state(pump))) return;
  command("MM1", pump);
  const SmcState now = state(pump);
  if (is_smc_ready(now)) return;
  throw RigError("the motor of the stage cannot be switched on: " + smc_fault_text(now.faults));
}

void SmcStage::read_dynamics(const Pump& pump) {
  first_speed_mm_s_ = number("VA?", pump);
  dynamics_.max_speed_m_s = first_speed_mm_s_ * 1e-3;
  dynamics_.acceleration_m_s2 = number("AC?", pump) * 1e-3;
  if (!(dynamics_.max_speed_m_s > 0.0) || !(dynamics_.acceleration_m_s2 > 0.0)) {
    throw RigError("the stage reports VA or AC 0. Set both on the controller");
  }
  const auto increment_mm = number_from_text(ask_if_known("SU?", pump).value_or("0"));
  has_encoder_ = increment_mm && *increment_mm > 0.0;  // an SMC100PP reports none
  const double step_m = has_encoder_ ? *increment_mm * 1e-3 : config_.microstep_m;
  if (!(step_m > 0.0)) {
    throw RigError(
        "an SMC100PP does not report the length of a microstep. Set microstep under [stage] of the "
        "rig file, such as \"0.1 um\", from the maker's page of the stage");
  }
  dynamics_.steps_per_m = 1.0 / step_m;
  const double ends_m[] = {toward_ * number("SL?", pump) * 1e-3,
                           toward_ * number("SR?", pump) * 1e-3};
  dynamics_.lowest_m = std::min(ends_m[0], ends_m[1]);
  dynamics_.highest_m = std::max(ends_m[0], ends_m[1]);
  jerk_time_s_ = number_from_text(ask_if_known("JR?", pump).value_or("0")).value_or(0.0);
  if (!ask_if_known("PA?", pump)) dialect_.target_question.clear();
  ask(dialect_.error_question, pump);  // of questions that it does not know
}

void SmcStage::set_up(const Pump& pump) {
  const SmcState now = state(pump);
  if (!is_smc_referenced(now)) {
    if (!config_.home) throw_no_reference();
    stopped_by_error([&] { home(pump); });
  }
  switch_on(pump);
  read_dynamics(pump);
}

void SmcStage::set_free(const Pump& pump) {
  if (!is_smc_referenced(state(pump))) {
    throw RigError(
        "the stage has lost its reference position, and without it the controller refuses every "
        "move: LIFT THE PUNCH BY HAND, then home the stage");
  }
  switch_on(pump);
}

std::vector<std::string> SmcStage::advice() const {
  constexpr double kMostJerkTime_s = 0.02;
  std::vector<std::string> advice = AskedStage::advice();
  if (jerk_time_s_ > kMostJerkTime_s) {
    advice.push_back("the jerk time JR is " + text_from_number(jerk_time_s_, 3) +
                     " s, so moves take longer by about that than the ramp of AC says: set JR to "
                     "0.01 or less on the controller");
  }
  return advice;
}

}  // namespace viscard
