#include "io/cli/rig/live_view.h"

#include "io/basics/atomic_file.h"
#include "io/cli/words/printable_stream.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <ostream>
#include <utility>

namespace viscard {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kDraw{100};
constexpr std::chrono::seconds kPage{1};

std::size_t terminal_columns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return 79;
  return size.ws_col - 1u;
}

}  // namespace

LiveView::LiveView(Streams& streams, LiveViewOptions options)
    : streams_(streams), options_(std::move(options)), thread_([this] { work(); }) {}

LiveView::~LiveView() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (is_line_drawn_) streams_.err << AsItIs{kEraseLine} << std::flush;
}

void LiveView::update(const RunProgress& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  now_ = now;
  now_.time_left_s /= options_.clock_speed;  // shown as wall time
  history_.add(now.time_s, now.force_N);
  is_new_ = true;
}

LiveHistory LiveView::history() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return history_;
}

void LiveView::work() {
  auto page_due = Clock::now();
  bool is_over = false;
  while (!is_over) {
    RunProgress now;
    LiveHistory history;
    bool is_new = false;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      is_over = wake_.wait_for(lock, kDraw, [&] { return is_ending_; });
      is_new = std::exchange(is_new_, false);
      now = now_;
      history = history_;
    }
    if (is_new && streams_.err_is_terminal && !is_over) draw_line(now, history);
    if (options_.counts) announce();
    if (options_.page && (is_over || Clock::now() >= page_due)) {
      draw_page(now, history, is_over);
      page_due = Clock::now() + kPage;
    }
  }
}

void LiveView::draw_line(const RunProgress& now, const LiveHistory& history) {
  streams_.err << AsItIs{kEraseLine}
               << line_from_live(now, history, options_.capacity_N, terminal_columns())
               << std::flush;
  is_line_drawn_ = true;
}

void LiveView::draw_page(const RunProgress& now, const LiveHistory& history, bool is_over) {
  if (is_page_lost_) return;
  try {
    write_file(*options_.page,
               page_from_live(now, history, options_.capacity_N, options_.limit_N, options_.title,
                              is_over),
               true);
  } catch (const std::exception&) {
    is_page_lost_ = true;
  }
}

void LiveView::announce() {
  const CaptureCounts counts = options_.counts();
  if (counts.committed == announced_.committed && counts.synced == announced_.synced) return;
  announced_ = counts;
  streams_.err << fmt::format("{} records are safe from a crash, {} from a power cut\n",
                              counts.committed, counts.synced)
               << std::flush;
}

}  // namespace viscard
