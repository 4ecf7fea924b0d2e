#include "io/serve/live_run.h"

#include "io/flow/command_error.h"
#include "models/maths/failure_text.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kMostPoints = 20'000;  // of the live curves

}  // namespace

LiveRun::~LiveRun() {
  stop(false);
  wait();
}

void LiveRun::start(const std::string& specimen, CaptureRequest request,
                    std::function<void()> on_end) {
  // A run may end, and the next start() come, before the thread has its name here.
  const std::lock_guard<std::mutex> one_start(starting_);
  wait();  // joins the thread of the last run
  stop_ = false;
  stop_at_once_ = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t number = state_.number + 1;
    state_ = LiveState{};
    state_.number = number;
    state_.is_running = true;
    state_.specimen = specimen;
    state_.file = request.path.filename().string();
    state_.clock_speed = request.setup.rig.clock_speed;
    history_ = LiveHistory(kMostPoints);
    phases_ = phases_from_plan(request.setup.plan);
  }
  try {
    thread_ = std::thread([this, request = std::move(request), on_end = std::move(on_end)] {
      work(request, on_end);
    });
  } catch (...) {  // no further thread
    const std::lock_guard<std::mutex> lock(mutex_);
    state_.is_running = false;
    throw;
  }
}

void LiveRun::stop(bool at_once) {
  if (at_once) stop_at_once_ = true;
  stop_ = true;
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.is_stopping = state_.is_running;
}

bool LiveRun::is_running() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_.is_running;
}

void LiveRun::wait() {
  if (thread_.joinable()) thread_.join();
}

LiveState LiveRun::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_now();
}

std::pair<LiveState, LivePoints> LiveRun::state_since(std::size_t from,
                                                      std::size_t keep_every) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {state_now(), history_.since(from, keep_every)};
}

// Precondition: the mutex is held.
LiveState LiveRun::state_now() const {
  LiveState state = state_;
  state.phase_text = text_of_phase();
  if (writer_ != nullptr) state.counts = writer_->counts();
  return state;
}

void LiveRun::work(const CaptureRequest& request, const std::function<void()>& on_end) {
  std::optional<RunOutcome> outcome;
  std::string trouble, code;
  try {
    outcome = capture_to_file(request, watch());
  } catch (const std::exception& error) {
    trouble = failure_text(error, "this run");
    code = command_error(error).code;
  }
  on_end();
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.is_running = false;
  state_.outcome = std::move(outcome);
  state_.trouble = std::move(trouble);
  state_.trouble_code = std::move(code);
}

// Called by the thread that watches the force: these only store.
CaptureWatch LiveRun::watch() {
  CaptureWatch watch;
  watch.stop = &stop_;
  watch.stop_at_once = &stop_at_once_;
  watch.opened = [this](const RigConfig&, const CaptureWriter& writer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    writer_ = &writer;
  };
  watch.progress = [this](const RunProgress& now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_.now = now;
  };
  watch.reading = [this](const RunReading& reading) {
    const std::lock_guard<std::mutex> lock(mutex_);
    history_.add(reading.time_s, reading.force_N, reading.depth_m);
    state_.peak_force_N = std::max(state_.peak_force_N, reading.force_N);
  };
  watch.closing = [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (writer_ != nullptr) state_.counts = writer_->counts();
    writer_ = nullptr;
  };
  return watch;
}

std::string LiveRun::text_of_phase() const {
  if (state_.now.phase == "connect") return "Waiting for both devices";
  if (state_.now.phase == kHomePhase) return "Homing the stage, to compare its count";
  for (const TestPhase& planned : phases_) {
    if (planned.name == state_.now.phase) return planned.text;
  }
  return "";
}

}  // namespace viscard
