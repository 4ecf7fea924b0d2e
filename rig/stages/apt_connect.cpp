// The exchanges of AptStage that wait for answers: connecting, homing, recovery.
#include "models/maths/text_of_number.h"
#include "rig/stages/apt_stage.h"

#include <cmath>

namespace viscard {
namespace {

constexpr double kRequest_wall_s = 0.75;
constexpr double kHoming_wall_s = 180.0;
constexpr double kHomeBegins_wall_s = 2.0;
constexpr double kHalt_wall_s = 10.0;
constexpr double kUsual = 1e-3;  // m/s and m/s^2, for a controller whose own values are 0

std::int32_t word_of(double value) {
  return static_cast<std::int32_t>(std::max(1LL, std::llround(value)));
}

}  // namespace

// Sends a request until it is answered. No request moves anything, so it may arrive twice.
AptMessage AptStage::ask(const std::string& request, std::uint16_t reply, const Pump& pump) {
  answer_.reset();
  awaited_ = reply;
  for (int i = 0; i < kMostSends && !answer_; ++i) {
    outbox_.push_back(request);
    wait_for([&] { return answer_.has_value(); }, pump, kRequest_wall_s);
  }
  awaited_ = 0;
  if (answer_) return *answer_;
  throw RigError("the stage on '" + transport_.name() +
                 "' does not answer. Check its cable and supply");
}

void AptStage::ask_position(const Pump& pump) {
  forget_questions();
  await_report(pump, 3.0, "Check its cable and supply");
}

// Stops the stage, also one that another program, or this one before a hang-up, has left moving.
void AptStage::halt(std::uint8_t mode, const Pump& pump) {
  const double deadline_s = clock_.awake_s() + kHalt_wall_s;
  stop(mode);
  ask_position(pump);
  double again_s = clock_.awake_s() + 1.0;
  while (!rests()) {
    if (clock_.awake_s() > deadline_s) throw_no_rest();
    if (clock_.awake_s() > again_s) {
      stop(mode);
      again_s = clock_.awake_s() + 1.0;
    }
    ask_position(pump);
  }
}

void AptStage::identify(const Pump& pump) {
  const auto info = parse_apt_info(ask(format_apt(apt::kAskInfo, 0, 0), apt::kInfo, pump));
  identity_ = "Thorlabs " + info->model + " " + std::to_string(info->serial) + ", firmware " +
              info->firmware;
  const auto units = apt_units(info->model);
  if (!units) {
    throw RigError("the stage on '" + transport_.name() + "' is a '" + shown_bytes(info->model) +
                   "', whose units of speed this driver does not know; known are " + apt_models());
  }
  units_ = *units;
}

// Some units have no speed or acceleration after power-up and would not move at all.
void AptStage::read_velocity(const Pump& pump) {
  const auto velocity =
      parse_apt_velocity(ask(format_apt(apt::kAskVelocity, 1, 0), apt::kVelocity, pump));
  if (!velocity) throw RigError("the stage does not report the speed of channel 1");
  found_ = *velocity;
  has_no_speed_ = found_.speed <= 0 || found_.acceleration <= 0;
  if (!has_no_speed_) return;
  found_.speed = word_of(kUsual / speed_m_s(1.0));
  found_.acceleration = word_of(kUsual / acceleration_m_s2(1.0));
}

void AptStage::enable(const Pump& pump) {
  for (int i = 0; i < kMostSends; ++i) {
    outbox_.push_back(format_apt(apt::kEnable, 1, 1));
    wait_for([&] { return outbox_.empty(); }, pump, kRequest_wall_s);
    ask_position(pump);
    if ((bits_ & apt::kIsEnabled) != 0) return;
  }
  throw RigError(
      "the motor of the stage stays switched off. Enable it at the controller, and "
      "check its supply");
}

void AptStage::home(const Pump& pump) {
  std::string data = ask(format_apt(apt::kAskHome, 1, 0), apt::kHome, pump).data;
  constexpr std::size_t kSpeedAt = 6;
  if (apt_i32(data, kSpeedAt) <= 0) {  // as for read_velocity()
    data.replace(kSpeedAt, 4, apt_bytes(static_cast<std::uint32_t>(found_.speed), 4));
    outbox_.push_back(format_apt(apt::kSetHome, data));
  }
  has_homed_ = false;
  const double before_m = reported_m_;
  const std::uint32_t before = bits_ & apt::kIsHomed;
  const auto has_begun = [&] {
    return has_homed_ || !rests() || reported_m_ != before_m || (bits_ & apt::kIsHomed) != before;
  };
  for (int i = 0; i < kMostSends && !has_begun(); ++i) {
    outbox_.push_back(format_apt(apt::kGoHome, 1, 0));
    wait_for(has_begun, pump, kHomeBegins_wall_s);
  }
  const auto is_home = [&] { return rests() && (bits_ & apt::kIsHomed) != 0; };
  if (has_begun() && wait_for(is_home, pump, kHoming_wall_s)) return;
  throw RigError(
      "the stage does not reach its home position. Clear its way, and home it with the "
      "maker's software");
}

void AptStage::connect(const Pump& pump) {
  outbox_ = {format_apt(apt::kNoFlashProgramming, 0, 0), format_apt(apt::kStopUpdates, 0, 0)};
  try {
    ask(format_apt(apt::kAskInfo, 0, 0), apt::kInfo, pump);
  } catch (const PortHungUp&) {
    throw;
  } catch (const RigError&) {
    throw_no_answer("Thorlabs APT controller", transport_.question() + " APT needs 115200",
                    "Is this the stage's port, and is the controller switched on? After a quick "
                    "reopening some need their supply off and on");
  }
  identify(pump);
  halt(apt::kWithRamp, pump);
  read_velocity(pump);
  enable(pump);
  if (const std::uint32_t errors = bits_ & apt::kAnyError; errors != 0) {
    throw RigError("the stage reports " + apt_error_text(errors));
  }
  if (config_.home) stopped_by_error([&] { home(pump); });
  ask_position(pump);
  if ((bits_ & apt::kIsHomed) == 0) throw_no_reference();
  is_homed_ = true;
  exact_m_ = reported_m_;
  start_m_ = reported_m_;
  is_recovering_ = false;
}

void AptStage::recover(const Pump& pump) {
  is_recovering_ = true;
  polls_ = false;
  outbox_.clear();
  halt(apt::kAtOnce, pump);
  identify(pump);  // the port may have come back with another one
  enable(pump);
  if (active_) end_move();
  exact_m_ = reported_m_;
  is_homed_ = (bits_ & apt::kIsHomed) != 0;  // after a restart it counts from where it stands
  is_recovering_ = false;
}

std::vector<std::string> AptStage::advice() const {
  std::vector<std::string> advice;
  if (has_no_speed_) {
    advice.push_back(
        "the controller's own speed or acceleration is 0; 1 mm/s and 1 mm/s2 are used. Set both "
        "in the maker's software and store them in the controller");
  }
  if (dynamics().max_speed_m_s < 0.5e-3) {
    advice.push_back("the speed set in the controller, " +
                     text_from_number(dynamics().max_speed_m_s * 1e3, 3) +
                     " mm/s, is the fastest that is used: retracting takes long");
  }
  if (dynamics().acceleration_m_s2 < 1e-3) {
    advice.push_back("the acceleration set in the controller is " +
                     text_from_number(dynamics().acceleration_m_s2 * 1e3, 2) +
                     " mm/s2: stops and ramps are slow; set at least 1");
  }
  return advice;
}

}  // namespace viscard
