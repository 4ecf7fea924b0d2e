#pragma once

#include "io/flow/capture_to_file.h"
#include "io/flow/live_history.h"
#include "models/experiment/test_phases.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace viscard {

// State of the running capture, or of the last one.
struct LiveState {
  std::size_t number = 0;  // of the run since the program began; 0 without one
  bool is_running = false;
  bool is_stopping = false;  // a person asked for it
  std::string specimen;      // its name in the series
  std::string file;          // name of the capture
  double clock_speed = 1.0;
  RunProgress now;
  std::string phase_text;
  double peak_force_N = 0.0;
  CaptureCounts counts;
  std::optional<RunOutcome> outcome;  // once the run has ended
  std::string trouble;                // why it could not begin or be recorded
  std::string trouble_code;           // as in CommandError
};

// The one capture that can run at a time, on a thread of its own. It needs no watcher: closing the
// page changes nothing.
class LiveRun {
 public:
  LiveRun() = default;
  // Stops a run gently and waits for the lift.
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  // on_end is called by the thread of the run, before is_running() turns false. Precondition: no run is going on.
  void start(const std::string& specimen, CaptureRequest request, std::function<void()> on_end);
  // The stage brakes and the punch is lifted; with at_once the stage is reset first.
  void stop(bool at_once);
  bool is_running() const;
  // Waits until the run has ended.
  void wait();
  LiveState state() const;
  // The same, with the points that LiveHistory::since() returns.
  std::pair<LiveState, LivePoints> state_since(std::size_t from, std::size_t keep_every) const;

 private:
  LiveState state_now() const;

  void work(const CaptureRequest& request, const std::function<void()>& on_end);
  CaptureWatch watch();
  std::string text_of_phase() const;

  std::mutex starting_;
  std::atomic<bool> stop_{false}, stop_at_once_{false};
  std::thread thread_;
  // Guards the rest. The thread that watches the force waits for it, so it is held for microseconds.
  mutable std::mutex mutex_;
  LiveState state_;
  LiveHistory history_;
  std::vector<TestPhase> phases_;
  const CaptureWriter* writer_ = nullptr;
};

}  // namespace viscard
