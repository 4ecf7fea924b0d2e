// The exchanges of MarlinStage that wait for answers: connecting, settings, recovery.
#include "models/maths/text_of_number.h"
#include "rig/stages/marlin_stage.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace viscard {
namespace {

constexpr double kStart_wall_s = 3.0;    // from the opening of a port to the start of a board
constexpr double kChatter_wall_s = 0.5;  // a pause that ends what it says at its start
constexpr double kBooted_wall_s = 10.0;
constexpr double kHomed_wall_s = 180.0;
constexpr int kConversations = 4;
constexpr double kCoarsest_m = 20e-6;   // of the shortest move
constexpr double kSeen_s = 0.3;         // of the move that shows what reports are
constexpr int kMostSeen = 4;            // such moves, each twice as long as the one before
constexpr double kMostSeen_m = 0.3e-3;  // none is longer

}  // namespace

void MarlinStage::command(const std::string& text, const Pump& pump, double wall_s) {
  awaited_ = text;
  outbox_.push_back(text);
  if (wait_for([&] { return !awaited_; }, pump, wall_s)) return;
  in_flight_.reset();
  throw RigError("the stage on '" + transport_.name() + "' did not answer '" + text + "'");
}

// Boards with a USB converter start when their port is opened, and talk while they do.
void MarlinStage::await_boot(const Pump& pump) {
  const int n_before = n_starts_;
  if (wait_for([&] { return n_starts_ > n_before; }, pump, kStart_wall_s)) await_pause(pump);
}

void MarlinStage::await_pause(const Pump& pump) {
  const double pause_s = clock_.from_wall_s(kChatter_wall_s);
  wait_for([&] { return clock_.now_s() > heard_s_ + pause_s; }, pump, kBooted_wall_s);
}

// A board that has just started, because its port was opened again, answers late. A stop that is
// open may have been written to the port of before, so another one follows at once.
void MarlinStage::halt(const Pump& pump) {
  const int n_before = n_starts_;
  outbox_.clear();
  if (active_) active_->is_stopping = true;
  write_stop();
  wait_for([&] { return !is_stop_open_; }, pump, 1.2 * kMostStopsAtStart * kStopped_wall_s);
  if (n_starts_ > n_before) await_pause(pump);
}

// Reads the settings until two readings agree: one garbled digit would falsify every move.
void MarlinStage::read_settings(const Pump& pump) {
  std::map<std::string, double> before;
  for (int i = 0; i < kConversations; ++i) {
    settings_.clear();
    command("M503", pump, 10.0);
    if (!settings_.empty() && settings_ == before) break;
    before = settings_;
  }
  const StageDynamics found = dynamics();
  if (!(found.steps_per_m > 0.0) || !(found.acceleration_m_s2 > 0.0) ||
      !(found.max_speed_m_s > 0.0)) {
    throw RigError(std::string("the stage did not report steps/mm, acceleration and largest "
                               "speed of axis ") +
                   config_.axis +
                   " (M92, M201, M204 and M203 of M503). Check the axis in the rig "
                   "file");
  }
  if (kFewestSteps / found.steps_per_m <= kCoarsest_m) return;
  throw RigError("M92 " + std::string(1, config_.axis) +
                 text_from_number(found.steps_per_m * 1e-3, 1) +
                 " steps/mm is too coarse: Marlin makes no move of fewer than 6 steps. Use "
                 "microstepping or a finer screw for at least 400");
}

// What the reports show of a slow move from rest: before half of its time has passed the stage is
// not at its end. At the end of its travel it does not move. It stands when this returns.
MarlinStage::Reports MarlinStage::reports_of_move(long long to, double speed_m_s,
                                                  const Pump& pump) {
  constexpr int kEarly = 4;
  constexpr double kFirstBlock_s = 0.25;  // a single move begins later by this
  struct Seen {
    double time_s;
    long long count;
  };
  std::vector<Seen> early;
  const long long from = count_;
  const auto way_s = [&](long long end) {
    return static_cast<double>(std::llabs(end - from)) / (speed_m_s * steps_per_m());
  };
  // Standing outside of a soft limit, it would be sent to that limit, perhaps into the specimen.
  const StageMove path{clock_.now_s(), metres(from), metres(to), speed_m_s,
                       dynamics().acceleration_m_s2};
  std::size_t n_watched = n_reports_;
  int n_astray = 0;
  const auto watch = [&] {
    if (n_reports_ == std::exchange(n_watched, n_reports_)) return;
    watch_path(path, 2.0 / steps_per_m(), n_astray);
  };
  const double begun_s = clock_.now_s();  // not before
  command(move_to(to, speed_m_s * 60e3), pump);
  while (early.size() < kEarly && clock_.now_s() < begun_s + 0.5 * way_s(to)) {
    const std::size_t n_before = n_reports_;
    command(kAsk, pump);
    watch();
    if (n_reports_ > n_before) early.push_back({clock_.now_s(), count_});
  }
  const double over_s = begun_s + 1.5 * way_s(to) + kFirstBlock_s + 2.0 * rest_latency_s_;
  while (clock_.now_s() < over_s) {
    pump();
    watch();
  }
  await_report(pump, 5.0, "Check its cable");
  const long long end = count_;
  if (way_s(end) < 0.5 * way_s(to)) return Reports::kNotMoved;
  int n_there = 0, n_before_it = 0;
  for (const Seen& seen : early) {
    if (seen.time_s > begun_s + 0.5 * way_s(end)) break;
    ++(std::llabs(seen.count - end) <= 1 ? n_there : n_before_it);
  }
  // A single report may have a garbled digit.
  if (n_there >= n_before_it + 2) return Reports::kPlanned;
  return n_before_it >= n_there + 2 ? Reports::kTrue : Reports::kLate;
}

// Builds without M114_REALTIME report the end of what they were sent: the force would seem not to
// follow, and the punch would be on its way when it is taken to stand. So the stage is moved away
// from the specimen by up to 0.3 mm and back before anything else. It is never moved beyond its
// start, because how far it would press is not known yet, unless it has just been homed: it may then
// stand at the end of its travel, and the force is watched.
void MarlinStage::require_true_reports(const Pump& pump) {
  const double speed_m_s = dynamics().min_speed_m_s;
  const long long from = count_, most = std::llround(kMostSeen_m * steps_per_m());
  last_message_.clear();
  double time_s = std::clamp(8.0 * rest_latency_s_, kSeen_s, 8.0 * kSeen_s);
  Reports reports = Reports::kLate;
  for (int i = 0; i < kMostSeen && reports == Reports::kLate; ++i, time_s *= 2.0) {
    const long long way =
        std::clamp(std::llround(time_s * speed_m_s * steps_per_m()), 2LL * kFewestSteps, most);
    const long long forth = toward_ > 0.0 ? way : -way;
    reports = reports_of_move(from - forth, speed_m_s, pump);
    reports_of_move(from, speed_m_s, pump);
    if (reports == Reports::kNotMoved && config_.home) {
      const long long little = forth > 0 ? most / 3 : -most / 3;
      reports = reports_of_move(from + little, speed_m_s, pump);  // and stays there: the next
      if (reports == Reports::kTrue) return;  // command has a way from its end then
      reports_of_move(from, speed_m_s, pump);
    }
    if (reports != Reports::kNotMoved) continue;
    throw RigError("the stage does not move away from the specimen by " +
                   micrometres(static_cast<double>(way) / steps_per_m(), 3) + " (" +
                   words_of_board() +
                   "). Home it if the board asks for that; if its travel ends where it stands, "
                   "move it toward the specimen by hand or lower that end (M211), then start the "
                   "run again");
  }
  if (reports == Reports::kTrue) return;
  throw RigError("the firmware (" + firmware_ +
                 ") does not report where the stage is while it moves, " +
                 (reports == Reports::kPlanned ? "but where its moves will end"
                                               : "or too late (M114_LEGACY, Marlin 1.1)") +
                 ". Build it with M114_REALTIME (Configuration_adv.h of Marlin 2.0.6 or later)");
}

// Something may be in the way of a board that restarts meanwhile, so it is not homed again.
void MarlinStage::home(const Pump& pump) {
  const int n_before = n_starts_;
  const std::string text = std::string("G28 ") + config_.axis;
  awaited_ = text;
  outbox_.push_back(text);
  const auto is_over = [&] { return !awaited_ || n_starts_ != n_before; };
  const bool is_answered = wait_for(is_over, pump, kHomed_wall_s);
  if (n_starts_ != n_before) {
    throw DeviceRestarted(
        "the stage's controller restarted while it homed. Check its supply and what is in its way, "
        "then start the run again");
  }
  if (is_answered) return;
  in_flight_.reset();
  throw RigError("the stage on '" + transport_.name() + "' did not answer '" + text + "'");
}

void MarlinStage::converse(bool is_first, const Pump& pump) {
  command("M110 N0", pump);
  const auto is_known = [&] {
    return firmware_.find("Marlin") != std::string::npos ||
           firmware_.find("Prusa") != std::string::npos;
  };
  for (int i = 0; i < kConversations && !is_known(); ++i) {  // a letter may be garbled
    firmware_.clear();
    command("M115", pump);
    wait_for([&] { return !firmware_.empty(); }, pump, kChatter_wall_s);
  }
  if (firmware_.empty()) throw RigError("the stage did not name its firmware");
  if (!is_known()) {
    throw RigError("the stage on '" + transport_.name() + "' runs '" + shown_bytes(firmware_) +
                   "', which is not Marlin: its stops and reports are not known");
  }
  if (is_first) halt(pump);  // recover() has done it
  command("G21", pump);
  command("G90", pump);
  command("M17", pump);     // motors that are switched on later may jump to another step
  command("M18 S0", pump);  // else they let go after two minutes, and the hold is lost
  read_settings(pump);
  was_moved_ = is_first && config_.home;
  if (was_moved_) stopped_by_error([&] { home(pump); });
  command("M420 S0", pump);  // levelling would change the height on the way
  // M114 has two decimals, so G1 counts from where the stage stands, on a whole step.
  command(std::string("G92 ") + config_.axis + "0", pump);
  await_report(pump, 5.0, "Check the axis in the rig file");
  origin_count_ = count_;
  if (!is_first || presses_nothing_) return;
  was_moved_ = true;
  stopped_by_error([&] { require_true_reports(pump); });
}

// A board that starts late begins the exchange again.
void MarlinStage::converse_again(bool is_first, const Pump& pump) {
  for (int i = 0;; ++i) {
    const int n_before = n_starts_;
    polls_ = false;
    outbox_.clear();
    try {
      converse(is_first, pump);
      if (n_before == n_starts_) return;
    } catch (const PortHungUp&) {
      throw;
    } catch (const RigError&) {
      // Not after it was moved: that may have been stopped by a person, or by the force.
      if (n_before == n_starts_ || i >= kConversations || (is_first && was_moved_)) throw;
      await_pause(pump);
    }
  }
}

void MarlinStage::connect(const Pump& pump) {
  await_boot(pump);
  try {
    converse_again(true, pump);
  } catch (const PortHungUp&) {
    throw;
  } catch (const RigError&) {
    if (!firmware_.empty()) throw;
    throw_no_answer("Marlin controller",
                    transport_.question() +
                        " Boards built for 250000 baud need another BAUDRATE, such as 115200",
                    "Is this the stage's port, and is it switched on?");
  }
  exact_m_ = reported_m_;
  start_m_ = reported_m_;
  is_recovering_ = false;
}

void MarlinStage::recover(const Pump& pump) {
  is_recovering_ = true;
  halt(pump);
  converse_again(false, pump);
  if (active_) end_move();
  exact_m_ = reported_m_;
  is_recovering_ = false;
}

std::vector<std::string> MarlinStage::advice() const {
  std::vector<std::string> advice;
  const StageDynamics found = dynamics();
  if (!has_emergency_parser_) {
    advice.push_back(
        "the firmware has no EMERGENCY_PARSER: a stop waits for the line before it; "
        "build it with that option");
  }
  if (found.steps_per_m < 1600e3) {
    advice.push_back(
        "M92 " + std::string(1, config_.axis) + text_from_number(found.steps_per_m * 1e-3, 0) +
        " steps/mm: the shortest move is " + micrometres(kFewestSteps / found.steps_per_m, 2) +
        ", the slowest " + text_from_number(found.min_speed_m_s * 1e3, 3) +
        " mm/s; use microstepping for at least 1600");
  }
  if (found.acceleration_m_s2 < 0.1) {
    advice.push_back("M201 or M204 T limits the acceleration to " +
                     text_from_number(found.acceleration_m_s2 * 1e3, 0) +
                     " mm/s2: ramps are slow; set at least 100");
  }
  return advice;
}

}  // namespace viscard
