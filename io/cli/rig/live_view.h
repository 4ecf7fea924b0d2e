#pragma once

#include "io/cli/rig/live_picture.h"
#include "io/cli/words/streams.h"

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace viscard {

struct LiveViewOptions {
  double capacity_N = 1.0;
  double limit_N = 1.0;
  double clock_speed = 1.0;
  std::string title;
  std::optional<std::filesystem::path> page;  // rewritten every second
  std::function<std::size_t()> n_safe;        // records that survive a kill; reported if not empty
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
  std::size_t n_announced_ = 0;

  mutable std::mutex mutex_;  // guards the next five
  std::condition_variable wake_;
  RunProgress now_;
  LiveHistory history_;
  bool is_new_ = false;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace viscard
