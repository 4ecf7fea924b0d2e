#include "io/cli/rig/live_view.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace viscard {

using test::contains;

TEST_CASE("a sparkline shows the largest value of each share, from low to high", "[cli]") {
  CHECK(sparkline({}, 10).empty());
  CHECK(sparkline({1.0, 1.0}, 10) == "▁▁");
  CHECK(sparkline({0, 1, 2, 3, 4, 5, 6, 7}, 8) == "▁▂▃▄▅▆▇█");
  std::vector<double> spike(1000, 0.0);
  spike[501] = 1.0;
  CHECK(contains(sparkline(spike, 10), "█"));
}

TEST_CASE("a history stays small for any length of run and keeps its ends", "[cli]") {
  LiveHistory history;
  for (int i = 0; i < 100'000; ++i) history.add(i, std::sin(1e-3 * i));
  CHECK(history.time_s().size() <= LiveHistory::kMost);
  CHECK(history.time_s().size() > LiveHistory::kMost / 4);
  CHECK(history.time_s().front() == 0.0);
  CHECK(history.time_s().back() > 99'000.0);
  for (std::size_t i = 0; i < history.time_s().size(); ++i) {
    REQUIRE(history.force_N()[i] == std::sin(1e-3 * history.time_s()[i]));
  }
}

TEST_CASE("the live line fits its terminal and shows phase, force, depth and time left", "[cli]") {
  LiveHistory history;
  for (int i = 0; i < 50; ++i) history.add(i, 0.01 * i);
  const RunProgress now{
      .time_s = 50, .phase = "hold", .force_N = 0.843, .depth_m = 128.3e-6, .time_left_s = 83.0};
  const std::string line = line_from_live(now, history, 2.4517, 100);
  for (const char* part : {"hold", "0.843 N", "34 % of the cell", "128.3 um", "1:23 left", "█"}) {
    CHECK(contains(line, part));
  }
  CHECK(line_from_live(now, history, 2.4517, 40).size() <= 40);
  CHECK(clock_from_s(7267.0) == "2:01:07");
}

TEST_CASE("the live page reloads until the run is over and escapes its text", "[cli]") {
  LiveHistory history;
  history.add(0.0, 0.0);
  history.add(1.0, 1.0);
  const RunProgress now{.time_s = 1, .phase = "<b>"};
  const std::string page = page_from_live(now, history, 2.0, 0.5, "a & b", false);
  CHECK(contains(page, "http-equiv='refresh'"));
  CHECK(contains(page, "a &amp; b"));
  CHECK(contains(page, "&lt;b&gt;"));
  CHECK(contains(page, "stroke='var(--limit)'"));  // the limit lies within the picture
  CHECK(contains(page, "prefers-color-scheme:dark"));
  CHECK(contains(page, "name='viewport'"));
}

}  // namespace viscard
