// The exchanges of ZaberStage that wait for answers: connecting, settings, recovery.
#include "models/maths/text_of_number.h"
#include "rig/stages/zaber_stage.h"

namespace viscard {
namespace {

constexpr double kReply_wall_s = 3.0;
constexpr double kHome_wall_s = 180.0;
constexpr double kRest_wall_s = 5.0;

}  // namespace

// Sends one command and returns the data of its answer. Throws RigError if it is rejected.
std::string ZaberStage::ask(const std::string& words, const Pump& pump) {
  action_data_.reset();
  action_rejection_.clear();
  asked_words_ = words;
  actions_.push_back(words);
  wait_for([&] { return action_data_ || !action_rejection_.empty(); }, pump, kReply_wall_s);
  asked_words_.reset();
  if (action_data_) return *action_data_;
  if (!action_rejection_.empty()) {
    throw RigError("the stage refused '" + words + "': " + action_rejection_);
  }
  throw RigError("the stage on '" + transport_.name() + "' did not answer '" + words + "'");
}

double ZaberStage::number(const std::string& setting, const Pump& pump) {
  const std::string data = ask("get " + setting, pump);
  const auto value = number_from_text(data);
  if (!value) {
    throw RigError("the stage answered '" + data + "' when asked for " + setting +
                   ". Check axis_number under [stage] of the rig file");
  }
  return *value;
}

void ZaberStage::wait_for_rest(const Pump& pump, double wall_s) {
  const double deadline_s = clock_.awake_s() + wall_s;
  do {
    ask("", pump);
    if (clock_.awake_s() > deadline_s) throw_no_rest();
  } while (is_busy_);
}

void ZaberStage::ask_position(const Pump& pump) {
  question_.reset();
  await_report(pump, kReply_wall_s, "Check its cable and supply");
}

void ZaberStage::read_settings(const Pump& pump) {
  identity_ = "Zaber, firmware " + ask("get version", pump);
  max_speed_data_ = number("maxspeed", pump);
  acceleration_data_ = number("accel", pump);
  const StageDynamics found = dynamics();
  if (!(found.acceleration_m_s2 > 0.0) || !(found.max_speed_m_s > 0.0)) {
    throw RigError("the stage reports maxspeed or accel 0. Set both on the controller");
  }
}

void ZaberStage::connect(const Pump& pump) {
  try {
    ask("", pump);
  } catch (const RigError&) {
    throw_no_answer("Zaber controller of address " + std::to_string(config_.device),
                    "is the baud rate right?",
                    "Is this the stage's port, is it switched on, is it set to the ASCII protocol "
                    "at 115200 baud?");
  }
  wait_for_rest(pump, kRest_wall_s);
  read_settings(pump);
  if (is_zaber_fault(flag_)) throw RigError("the stage reports " + zaber_flag_text(flag_));
  if (config_.home) {
    stopped_by_error([&] {
      ask("home", pump);
      wait_for_rest(pump, kHome_wall_s);
    });
  }
  if (lacks_reference()) throw_no_reference();
  ask_position(pump);
  is_referenced_ = true;
  exact_m_ = reported_m_;
  start_m_ = reported_m_;
  is_recovering_ = false;
}

void ZaberStage::recover(const Pump& pump) {
  is_recovering_ = true;
  polls_ = false;
  question_.reset();
  // A port that came back found the stage still moving.
  if (active_ && !active_->is_stopping) stop_hard();
  wait_for_rest(pump, kRest_wall_s);
  identity_ =
      "Zaber, firmware " + ask("get version", pump);  // the port may have come back with another
  ask("warnings clear", pump);
  if (flag_ == "FO" || flag_ == "FD") ask("driver enable", pump);
  ask_position(pump);
  if (active_) end_move(reported_m_);
  exact_m_ = reported_m_;
  is_referenced_ = !lacks_reference();  // after a cut of the supply it counts from where it stands
  flag_.clear();                        // so that a fault that is still there is reported again
  is_recovering_ = false;
}

std::vector<std::string> ZaberStage::advice() const {
  std::vector<std::string> advice;
  if (dynamics().max_speed_m_s < 1e-3) {
    advice.push_back("maxspeed lets the stage go no faster than " +
                     text_from_number(dynamics().max_speed_m_s * 1e3, 3) +
                     " mm/s: retracting takes long; set maxspeed higher on the controller");
  }
  if (dynamics().acceleration_m_s2 < 0.1) {
    advice.push_back("accel is " + text_from_number(dynamics().acceleration_m_s2 * 1e3, 0) +
                     " mm/s2: stops and ramps are slow; set accel for at least 100");
  }
  return advice;
}

}  // namespace viscard
