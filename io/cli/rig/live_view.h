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
  std::function<std::size_t()> n_safe;  // records that a kill cannot lose; announced when given
};

// Shows a run to the person at the rig: one line at the foot of the terminal, and a page. update()
// only takes a note and never waits: a terminal that was stopped (Ctrl-S) or a slow disk must not
// hold up the thread that watches the force. A thread of its own draws. What goes wrong with a
// picture is never the run's trouble: a page that cannot be written is given up.
class LiveView {
 public:
  LiveView(Streams& streams, LiveViewOptions options);
  // Draws the page once more, wipes the line.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  void update(const RunProgress& now);
  // Of the whole run so far, for a summary.
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

  mutable std::mutex mutex_;  // of the next four
  std::condition_variable wake_;
  RunProgress now_;
  LiveHistory history_;
  bool is_new_ = false;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace viscard
