// How a RunSession leaves the rig when something went wrong.
#include "rig/run_session.h"

#include <algorithm>
#include <exception>

namespace viscard {
namespace {

constexpr double kStop_wall_s = 10.0;   // longest wait for standstill
constexpr double kUnloadStep_m = 2e-3;  // a lift is one move; this bounds it, contact known or not
constexpr int kAttempts = 4;

}  // namespace

// Away from the specimen, slowly. Says so if the force does not fall, which no second try mends.
std::string RunSession::lift(double retract_to_m, double speed_m_s) {
  const double before_N = force_N_;
  const double from_m = stage_.position_m();
  const double lifted_m = from_m - kUnloadStep_m;
  const double to_m =
      is_place_lost_ ? lifted_m : std::min(from_m, std::max(retract_to_m, lifted_m));
  if (to_m < from_m) {
    stage_.begin_move(to_m, speed_m_s, "retract");
    const double deadline_s = monotonic_s() + kStop_wall_s + (from_m - to_m) / speed_m_s;
    while (stage_.is_moving() && monotonic_s() < deadline_s) pump();
  }
  if (is_cell_connected_ && !is_cell_lost_ && before_N > 0.1 * guard_.soft_limit_N()) {
    const double wait_s = clock_.now_s() + 10.0 * load_cell_.period_s() + clock_.from_wall_s(0.1);
    while (clock_.now_s() < wait_s) pump();
    if (force_N_ > 0.9 * before_N) {
      return "THE FORCE DOES NOT FALL after lifting the punch: lift it by hand";
    }
  }
  return "";
}

std::string RunSession::make_safe(double retract_to_m, double speed_m_s) {
  is_armed_ = false;
  const Pump pump = [this] { this->pump(); };
  // More tries after a reset: a stage in alarm refuses the first, and a limit switch that opens
  // again on the way alarms once more.
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      if (attempt == 0 && stage_.is_moving() && !needs_recovery_) {
        is_stopping_ = true;
        stage_.stop_soft();
        const double deadline_s = monotonic_s() + kStop_wall_s;
        while (stage_.is_moving() && !needs_recovery_ && monotonic_s() < deadline_s) this->pump();
      }
      is_stopping_ = false;
      if (attempt > 0 || needs_recovery_) stage_.recover(pump);
      needs_recovery_ = false;
      return lift(retract_to_m, speed_m_s);
    } catch (const PortHungUp& error) {
      return std::string(error.what()) +
             ". THE STAGE CANNOT BE STOPPED FROM HERE: use its emergency stop and lift the punch "
             "by hand";
    } catch (const std::exception& error) {
      if (attempt + 1 == kAttempts) return error.what();
    }
  }
  return "";
}

}  // namespace viscard
