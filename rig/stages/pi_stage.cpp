#include "rig/stages/pi_stage.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

const std::string kPiMovingWord(1, kPiIsMoving);
const std::string kPiReadyWord(1, kPiIsReady);

}  // namespace

PiStage::PiStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                 RecordSink sink)
    : AskedStage(transport, config, clock, std::move(sink),
                 {.name = "PI controller",
                  .settings = "Under [stage] of the rig file baud and device must be those of its "
                              "switches (C-863: 5 and 6, 1 to 4)",
                  .name_question = "*IDN?",
                  .position_question = "POS? " + std::to_string(config.axis_number),
                  .speed_question = "VEL? " + std::to_string(config.axis_number),
                  .target_question = "MOV? " + std::to_string(config.axis_number),
                  .error_question = "ERR?",
                  .soft_stop = "HLT " + std::to_string(config.axis_number),
                  .hard_stop = std::string(1, kPiStop),
                  .limits = "TMN?, TMX?"}),
      axis_(" " + std::to_string(config.axis_number)) {}

std::string PiStage::of_axis(const std::string& words) const {
  return words + axis_;
}

std::string PiStage::bytes_of(const std::string& words) const {
  return format_pi_command(config_.device, words);
}

bool PiStage::is_question(const std::string& words) const {
  return words.find('?') != std::string::npos || words == kPiMovingWord || words == kPiReadyWord;
}

std::optional<std::string> PiStage::answer_in(const std::string& question,
                                              const std::string& line) const {
  const auto answer = pi_answer_text(line, config_.device);
  if (!answer) return std::nullopt;
  if (question == kPiReadyWord) return parse_pi_ready(*answer) ? answer : std::nullopt;
  if (question == kPiMovingWord) {
    return parse_pi_moving(*answer, config_.axis_number) ? answer : std::nullopt;
  }
  if (question == dialect_.error_question) return parse_pi_error(*answer) ? answer : std::nullopt;
  const auto value = pi_value_of_axis(*answer, config_.axis_number);
  return value && number_from_text(*value) ? value : std::nullopt;
}

std::string PiStage::speed_words(double speed_mm_s) const {
  return of_axis("VEL") + " " + text_from_number(speed_mm_s, 7);
}

std::string PiStage::move_words(double target_mm) const {
  return of_axis("MOV") + " " + text_from_number(target_mm, 7);
}

std::string PiStage::trouble_in(const std::string& answer) const {
  const int error = parse_pi_error(answer).value_or(0);
  return error == 0 || error == kPiStopped ? "" : pi_error_text(error);
}

// The position is asked for after the motion, so that it is the one at rest.
void PiStage::plan_round() {
  round_ = {kPiMovingWord, dialect_.position_question};
}

void PiStage::take_state(const std::string& question, const std::string& answer) {
  if (question == kPiMovingWord) {
    seen_.is_moving = parse_pi_moving(answer, config_.axis_number).value_or(true);
    if (seen_.is_moving) return;
    for (const char* words : {"SVO?", "FRF?", "ONT?"}) round_.push_back(of_axis(words));
    round_.push_back(dialect_.error_question);
    return;
  }
  const bool is_one = number_from_text(answer) == 1.0;
  if (question == of_axis("SVO?")) seen_.holds = is_one;
  if (question == of_axis("FRF?")) seen_.has_reference = is_one;
  if (question == of_axis("ONT?")) seen_.is_on_target = is_one;
  if (question == dialect_.error_question) seen_.trouble = trouble_in(answer);
}

// A parameter that the controller has not is answered by silence and an error.
double PiStage::parameter(const std::string& id, double otherwise, const Pump& pump) {
  const auto answer = ask_if_known(of_axis("SPA?") + " " + id, pump, 2);
  if (answer) return number_from_text(*answer).value_or(otherwise);
  ask(dialect_.error_question, pump);
  return otherwise;
}

void PiStage::read_dynamics(const Pump& pump) {
  first_speed_mm_s_ = number(of_axis("VEL?"), pump);
  double acceleration_mm_s2 = number(of_axis("ACC?"), pump);
  const double deceleration_mm_s2 = number(of_axis("DEC?"), pump);
  if (acceleration_mm_s2 != deceleration_mm_s2) {
    // One number describes both ramps of a move; the lower one is allowed for either.
    acceleration_mm_s2 = std::min(acceleration_mm_s2, deceleration_mm_s2);
    const std::string value = " " + text_from_number(acceleration_mm_s2, 6);
    command(of_axis("ACC") + value, pump);
    command(of_axis("DEC") + value, pump);
    acceleration_mm_s2 = number(of_axis("ACC?"), pump);
  }
  const double counts = parameter("0xE", 0.0, pump);  // counts per mm, as a fraction
  const double per_mm = parameter("0xF", 1.0, pump);
  dynamics_.steps_per_m = counts > 0.0 && per_mm > 0.0 ? counts / per_mm * 1e3
                          : config_.microstep_m > 0.0  ? 1.0 / config_.microstep_m
                                                       : 0.0;
  if (dynamics_.steps_per_m == 0.0) {
    throw RigError(
        "the stage does not report the counts of its encoder per mm (SPA? 0xE, 0xF). Set "
        "microstep = \"0.1 um\", the length of one count, under [stage] of the rig file");
  }
  dynamics_.acceleration_m_s2 = acceleration_mm_s2 * 1e-3;
  dynamics_.max_speed_m_s = parameter("0xA", first_speed_mm_s_, pump) * 1e-3;
  if (!(dynamics_.acceleration_m_s2 > 0.0) || !(dynamics_.max_speed_m_s > 0.0)) {
    throw RigError(
        "the stage reports a largest speed or an acceleration of 0. Set both on the "
        "controller");
  }
  const double ends_m[] = {toward_ * number(of_axis("TMN?"), pump) * 1e-3,
                           toward_ * number(of_axis("TMX?"), pump) * 1e-3};
  dynamics_.lowest_m = std::min(ends_m[0], ends_m[1]);
  dynamics_.highest_m = std::max(ends_m[0], ends_m[1]);
}

void PiStage::switch_on(const Pump& pump) {
  if (number(of_axis("SVO?"), pump) == 1.0) return;
  command(of_axis("SVO") + " 1", pump);
  if (number(of_axis("SVO?"), pump) == 1.0) return;
  throw RigError("the servo of the stage cannot be switched on (SVO? is 0). Look at its supply");
}

// While the reference move runs, the controller refuses everything but single bytes.
void PiStage::home(const Pump& pump) {
  constexpr double kHome_wall_s = 300.0;
  const double deadline_s = clock_.awake_s() + kHome_wall_s;
  send_later(of_axis("FRF"));
  while (!parse_pi_ready(ask(kPiReadyWord, pump)).value_or(false)) {
    if (clock_.awake_s() > deadline_s) {
      throw RigError("the reference move of the stage does not end. Stop it by its switch");
    }
  }
  const std::string trouble = trouble_in(ask(dialect_.error_question, pump));
  if (number(of_axis("FRF?"), pump) == 1.0) return;
  throw RigError("the reference move of the stage failed: " +
                 (trouble.empty() ? "no error is reported" : trouble) +
                 ". A stage without a reference switch is homed by its own software (FNL or FPL)");
}

void PiStage::set_up(const Pump& pump) {
  constexpr double kStart_wall_s = 10.0;
  const double deadline_s = clock_.awake_s() + kStart_wall_s;
  while (!parse_pi_ready(ask(kPiReadyWord, pump)).value_or(false)) {
    if (clock_.awake_s() > deadline_s) throw RigError("a reference move of the stage is running");
  }
  read_dynamics(pump);
  switch_on(pump);
  if (config_.home) stopped_by_error([&] { home(pump); });
  if (number(of_axis("FRF?"), pump) != 1.0) throw_no_reference();
  is_zero_declared_ = ask_if_known(of_axis("RON?"), pump).value_or("1") == "0";
  ask(dialect_.error_question, pump);  // of questions that it does not know
}

// Without a reference the stage moves only if its present position is declared: in the middle of its
// travel, so that no limit hinders the lift of the punch.
void PiStage::set_free(const Pump& pump) {
  send_later("");  // ends a command that the stop byte cut
  ask(dialect_.error_question, pump);
  switch_on(pump);
  if (number(of_axis("FRF?"), pump) == 1.0) return;
  command(of_axis("RON") + " 0", pump);
  start_m_ = 0.5 * (dynamics_.lowest_m + dynamics_.highest_m);
  command(of_axis("POS") + " " + text_from_number(toward_ * *start_m_ * 1e3, 7), pump);
}

std::vector<std::string> PiStage::advice() const {
  std::vector<std::string> advice = AskedStage::advice();
  if (is_zero_declared_) {
    advice.push_back(
        "the position was declared and not found at a reference switch (RON is 0), so the limits "
        "of travel TMN and TMX may be wrong: set RON to 1 and home the stage");
  }
  return advice;
}

}  // namespace viscard
