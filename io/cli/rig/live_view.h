#pragma once

#include "io/capture/capture_file.h"
#include "io/cli/words/streams.h"
#include "rig/run/run_control.h"

#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace viscard {

// Force against time during a run, thinned out to at most kMost points however long the run is.
class LiveHistory {
 public:
  static constexpr std::size_t kMost = 2000;

  void add(double time_s, double force_N);
  const std::vector<double>& time_s() const { return time_s_; }
  const std::vector<double>& force_N() const { return force_N_; }

 private:
  std::vector<double> time_s_, force_N_;
  std::size_t keep_every_ = 1;
  std::size_t n_seen_ = 0;
};

// Draws each value as one of eight blocks, scaled from the smallest to the largest value. If there
// are more values than width, each block shows the largest value of its share.
std::string sparkline(const std::vector<double>& values, std::size_t width);

// "hold     0.843 N  34 % of the cell  128.3 um  [sparkline]  1:23 left", shortened to fit columns.
std::string line_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           std::size_t columns);

// "1:23" or "2:01:07".
std::string clock_from_s(double seconds);

// An HTML page that reloads itself every second until the run is over.
std::string page_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           double limit_N, const std::string& title, bool is_over);

struct LiveViewOptions {
  double capacity_N = 1.0;
  double limit_N = 1.0;
  double clock_speed = 1.0;
  std::string title;
  std::optional<std::filesystem::path> page;  // rewritten every second
  std::function<CaptureCounts()> counts;      // of the writer; reported if not empty
};

// Shows a run to the person at the rig, as one line at the bottom of the terminal and as a page. A
// thread of its own draws. update() only stores the values and never waits, because a stopped
// terminal (Ctrl-S) or a slow disk must not delay the thread that watches the force. A page that
// cannot be written is given up and does not disturb the run.
class LiveView {
 public:
  LiveView(Streams& streams, LiveViewOptions options);
  // Draws the page once more and removes the line.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  void update(const RunProgress& now);
  // The history of the run so far.
  LiveHistory history() const;

 private:
  void work();
  void draw_line(const RunProgress& now, const LiveHistory& history);
  void draw_page(const RunProgress& now, const LiveHistory& history, bool is_over);
  void announce();

  Streams& streams_;
  LiveViewOptions options_;
  bool is_line_drawn_ = false;
  bool is_page_lost_ = false;
  CaptureCounts announced_;

  mutable std::mutex mutex_;  // guards the next five
  std::condition_variable wake_;
  RunProgress now_;
  LiveHistory history_;
  bool is_new_ = false;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace viscard
