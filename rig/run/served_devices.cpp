#include "rig/run/served_devices.h"

#include "models/maths/text_of_number.h"
#include "rig/run/run_control.h"

#include <algorithm>
#include <vector>

namespace viscard {
namespace {

constexpr double kNap_wall_s = 0.005;
constexpr double kSilence_wall_s = 0.1;
// On an emulated clock that runs fast, every stall of the machine counts as seconds of rig time.
constexpr double kSilenceEmulated_wall_s = 1.0;
// At rest no force can rise in the meantime, but a hold without readings is useless.
constexpr double kDeadAtRest_wall_s = 1.5;
constexpr double kDeadEmulated_wall_s = 3.0;
constexpr double kDeadPeriods = 20.0;  // of a slow instrument

}  // namespace

ServedDevices::ServedDevices(Stage& stage, LoadCell& load_cell, Thermometer* thermometer,
                             const RigClock& clock)
    : stage_(stage),
      load_cell_(load_cell),
      thermometer_(thermometer),
      clock_(clock),
      silence_(clock.speed() > 1.0 ? kSilenceEmulated_wall_s : kSilence_wall_s) {}

void ServedDevices::connect(const Pump& pump) {
  load_cell_.connect(pump);
  is_cell_connected_ = true;
  stage_.connect(pump);
  is_stage_connected_ = true;
}

void ServedDevices::serve(bool is_guarded) {
  wait();
  serve_cell(is_guarded);
  serve_stage();
  if (thermometer_ != nullptr) thermometer_->service();
  const double arrival_s = load_cell_.last_arrival_s();
  silence_.pass(clock_.awake_s(), arrival_s != last_arrival_s_, stage_.is_moving());
  last_arrival_s_ = arrival_s;
}

void ServedDevices::wait() {
  std::vector<const Transport*> transports;
  if (!is_stage_lost_) transports.push_back(&stage_.transport());
  if (!is_cell_lost_) transports.push_back(&load_cell_.transport());
  if (thermometer_ != nullptr && thermometer_->transport() != nullptr) {
    transports.push_back(thermometer_->transport());
  }
  // Rig time may run faster than the wall clock, so the wait is shorter then.
  wait_readable(transports, clock_, kNap_wall_s / std::clamp(clock_.speed() / 10.0, 1.0, 10.0));
}

void ServedDevices::serve_cell(bool is_guarded) {
  if (is_cell_lost_) return;
  try {
    load_cell_.service();
  } catch (const LimitReached&) {  // the stage has been stopped already
    throw;
  } catch (const RigError& error) {
    is_cell_restarted_ =
        is_cell_restarted_ || dynamic_cast<const DeviceRestarted*>(&error) != nullptr;
    is_cell_lost_ = dynamic_cast<const PortHungUp*>(&error) != nullptr;
    if (!is_guarded) return;
    if (stage_.is_moving()) stop_hard();
    throw;
  }
}

void ServedDevices::serve_stage() {
  if (is_stage_lost_) return;
  try {
    stage_.service();
  } catch (const StageAlarm&) {
    needs_recovery_ = true;
    throw;
  } catch (const DeviceRestarted&) {
    needs_recovery_ = true;
    is_position_lost_ = true;
    throw;
  }
}

void ServedDevices::reopen_stage(double wall_s, const Pump& pump) {
  constexpr double kBetween_wall_s = 0.1;
  const std::string before = stage_.identity();
  is_stage_lost_ = true;
  is_stopping_ = false;
  const double deadline_s = clock_.awake_s() + wall_s;
  while (!stage_.transport().reopen()) {
    if (clock_.awake_s() > deadline_s) {
      throw PortHungUp("'" + stage_.transport().name() + "' is gone and did not come back within " +
                       text_from_number(wall_s, 0) + " s");
    }
    const double next_s = clock_.awake_s() + kBetween_wall_s;
    while (clock_.awake_s() < next_s) pump();
  }
  is_stage_lost_ = false;
  needs_recovery_ = true;
  is_position_lost_ = true;
  recover(pump);
  if (stage_.identity() != before) {
    throw RigError("'" + stage_.transport().name() + "' came back with another device: '" +
                   stage_.identity() + "' instead of '" + before + "'. Lift the punch by hand");
  }
}

void ServedDevices::stop_hard() {
  needs_recovery_ = true;
  stage_.stop_hard();
}

void ServedDevices::begin_gentle_stop() {
  is_stopping_ = true;
  stage_.stop_soft();
}

void ServedDevices::recover(const Pump& pump) {
  stage_.recover(pump);
  needs_recovery_ = false;
}

std::optional<ServedDevices::Silence> ServedDevices::silence() const {
  if (!is_cell_connected_) return std::nullopt;
  const double period_s = load_cell_.period_s() / clock_.speed();
  const double at_rest_s = std::max(
      kDeadPeriods * period_s, clock_.speed() > 1.0 ? kDeadEmulated_wall_s : kDeadAtRest_wall_s);
  const double limit_s = stage_.is_moving() ? silence_.limit_s(period_s) : at_rest_s;
  if (silence_.silent_s() < limit_s) return std::nullopt;
  return Silence{silence_.silent_s(), limit_s};
}

void SilenceWatch::pass(double wall_s, bool has_arrived, bool is_moving) {
  constexpr double kLongestPass_s = 0.010;
  const double pass_s = last_pass_s_ < 0.0 ? 0.0 : wall_s - last_pass_s_;
  last_pass_s_ = wall_s;
  silent_s_ += std::clamp(pass_s, 0.0, kLongestPass_s);
  if (!has_arrived) return;
  if (!is_moving) longest_at_rest_s_ = std::max(longest_at_rest_s_, silent_s_);
  silent_s_ = 0.0;
}

double SilenceWatch::limit_s(double period_s) const {
  constexpr double kSilentPeriods = 3.0, kLargestAllowance_s = 0.25;
  const double largest_s = std::max(kLargestAllowance_s, floor_s_);
  return std::max(kSilentPeriods * period_s,
                  std::clamp(2.0 * longest_at_rest_s_, floor_s_, largest_s));
}

}  // namespace viscard
