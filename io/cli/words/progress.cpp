#include "io/cli/words/progress.h"

#include "io/cli/words/printable_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

namespace viscard {

Progress::Progress(Streams& streams, std::string title)
    : streams_(streams),
      title_(std::move(title)),
      started_(std::chrono::steady_clock::now()),
      last_drawn_(started_ - std::chrono::seconds(1)) {}

Progress::~Progress() {
  clear();
}

void Progress::show(double fraction, const std::string& note) {
  if (!streams_.err_is_terminal) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_drawn_ < std::chrono::milliseconds(100)) return;
  last_drawn_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  constexpr int kWidth = 24;
  const int filled = static_cast<int>(std::lround(fraction * kWidth));
  const double spent_s = std::chrono::duration<double>(now - started_).count();
  const std::string left =
      fraction > 0.02 ? fmt::format(" {:.0f} s left", spent_s * (1.0 - fraction) / fraction) : "";
  streams_.err << AsItIs{kEraseLine}
               << fmt::format("{} [{}{}] {:3.0f} %{}  {}", title_,
                              std::string(static_cast<std::size_t>(filled), '#'),
                              std::string(static_cast<std::size_t>(kWidth - filled), '.'),
                              100.0 * fraction, left, note)
               << std::flush;
  is_drawn_ = true;
}

void Progress::announce(double fraction, const std::string& note) {
  last_drawn_ = started_ - std::chrono::seconds(1);
  show(fraction, note);
}

void Progress::clear() {
  if (!is_drawn_) return;
  streams_.err << AsItIs{kEraseLine} << std::flush;
  is_drawn_ = false;
}

}  // namespace viscard
