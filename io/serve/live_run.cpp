#include "io/serve/live_run.h"

#include "models/experiment/test_phases.h"

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
  wait();  // joins the thread of the last run
  stop_ = false;
  stop_at_once_ = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_ = LiveState{};
    state_.is_known = state_.is_running = true;
    state_.specimen = specimen;
    state_.file = request.path.filename().string();
    state_.clock_speed = request.setup.rig.clock_speed;
    state_.history = LiveHistory(kMostPoints);
    plan_ = request.setup.plan;
  }
  thread_ = std::thread(
      [this, request = std::move(request), on_end = std::move(on_end)] { work(request, on_end); });
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
  LiveState state = state_;
  state.phase_text = text_of_phase(state.now.phase);
  if (writer_ != nullptr) state.counts = writer_->counts();
  return state;
}

void LiveRun::work(const CaptureRequest& request, const std::function<void()>& on_end) {
  std::optional<RunOutcome> outcome;
  std::string trouble;
  try {
    outcome = capture_to_file(request, watch());
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  on_end();
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.is_running = false;
  state_.outcome = std::move(outcome);
  state_.trouble = std::move(trouble);
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
    state_.history.add(reading.time_s, reading.force_N, reading.depth_m);
    state_.peak_force_N = std::max(state_.peak_force_N, reading.force_N);
  };
  watch.closing = [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (writer_ != nullptr) state_.counts = writer_->counts();
    writer_ = nullptr;
  };
  return watch;
}

std::string LiveRun::text_of_phase(const std::string& phase) const {
  if (phase == "connect") return "Waiting for both devices";
  if (!state_.is_known) return "";
  for (const TestPhase& planned : phases_from_plan(plan_)) {
    if (planned.name == phase) return planned.text;
  }
  return "";
}

}  // namespace viscard
