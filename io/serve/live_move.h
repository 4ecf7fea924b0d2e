#pragma once

#include "io/flow/rig_actions.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace viscard {

// State of a move by hand, or of the last one.
struct MoveState {
  std::size_t number = 0;  // of the move since the program began; 0 without one
  bool is_moving = false;
  double force_N = 0.0;              // newest, from the force before the move
  std::optional<StageMoved> moved;   // once the move has ended
  std::optional<double> position_m;  // where the stage stands then, if that is known
  std::string trouble;               // why it could not begin, or was ended
};

// The one move by hand that can go on at a time, on a thread of its own. It goes on only while somebody watches it:
// the stage stops when nobody has asked for the state for half a second.
class LiveMove {
 public:
  static constexpr std::chrono::milliseconds kHeartbeat{500};

  LiveMove() = default;
  // Stops a move and waits for its end.
  ~LiveMove();
  LiveMove(const LiveMove&) = delete;
  LiveMove& operator=(const LiveMove&) = delete;

  // on_end is called by the thread of the move, before is_moving turns false. Precondition: no move is going on.
  void start(const RigConfig& rig, bool is_emulated, const StageOrder& order,
             std::function<void()> on_end);
  // Without at_once the stage brakes.
  void stop(bool at_once);
  // For somebody who watches.
  MoveState state();

 private:
  void work(const RigConfig& rig, bool is_emulated, const StageOrder& order,
            const std::function<void()>& on_end);
  void watch();

  std::mutex starting_;
  std::atomic<bool> stop_{false}, stop_at_once_{false};
  std::thread worker_, watcher_;
  std::optional<double> position_m_;  // where the stage stands; of the worker
  std::mutex mutex_;                  // guards the rest
  MoveState state_;
  bool is_unwatched_ = false;
  std::chrono::steady_clock::time_point asked_;
};

}  // namespace viscard
