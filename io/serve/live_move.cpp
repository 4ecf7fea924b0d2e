#include "io/serve/live_move.h"

#include "models/maths/failure_text.h"

#include <utility>

namespace viscard {

LiveMove::~LiveMove() {
  stop(false);
  if (worker_.joinable()) worker_.join();
  if (watcher_.joinable()) watcher_.join();
}

void LiveMove::start(const RigConfig& rig, bool is_emulated, const StageOrder& order,
                     std::function<void()> on_end) {
  const std::lock_guard<std::mutex> one_start(starting_);
  if (worker_.joinable()) worker_.join();
  if (watcher_.joinable()) watcher_.join();
  stop_ = false;
  stop_at_once_ = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t number = state_.number + 1;
    state_ = MoveState{};
    state_.number = number;
    state_.is_moving = true;
    is_unwatched_ = false;
    asked_ = std::chrono::steady_clock::now();
  }
  try {
    watcher_ = std::thread([this] { watch(); });
    worker_ = std::thread([this, rig, is_emulated, order, on_end = std::move(on_end)] {
      work(rig, is_emulated, order, on_end);
    });
  } catch (...) {  // no further thread
    const std::lock_guard<std::mutex> lock(mutex_);
    state_.is_moving = false;
    throw;
  }
}

void LiveMove::stop(bool at_once) {
  if (at_once) stop_at_once_ = true;
  stop_ = true;
}

MoveState LiveMove::state() {
  const std::lock_guard<std::mutex> lock(mutex_);
  asked_ = std::chrono::steady_clock::now();
  return state_;
}

void LiveMove::work(const RigConfig& rig, bool is_emulated, const StageOrder& order,
                    const std::function<void()>& on_end) {
  RunControl control;
  control.stop = &stop_;
  control.stop_at_once = &stop_at_once_;
  control.progress = [this](const RunProgress& now) {
    if (now.phase != kMovePhase) return;  // the force before the move is not known yet
    const std::lock_guard<std::mutex> lock(mutex_);
    state_.force_N = now.force_N;
  };
  std::optional<StageMoved> moved;
  std::string trouble;
  try {
    moved = move_rig_stage(rig, is_emulated, order, control, &position_m_);
  } catch (const std::exception& error) {
    trouble = failure_text(error, "this move");
  }
  on_end();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_unwatched_)
    trouble = "the page has not answered for half a second, so the stage was stopped. " + trouble;
  state_.is_moving = false;
  state_.moved = moved;
  state_.position_m = position_m_;
  state_.trouble = std::move(trouble);
}

void LiveMove::watch() {
  constexpr std::chrono::milliseconds kLook{50};
  for (;; std::this_thread::sleep_for(kLook)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!state_.is_moving) return;
    if (std::chrono::steady_clock::now() - asked_ < kHeartbeat) continue;
    is_unwatched_ = is_unwatched_ || !stop_;
    stop_ = true;
  }
}

}  // namespace viscard
