#include "io/plots/plot.h"
#include "io/plots/plot_points.h"
#include "io/plots/plot_script.h"
#include "io/plots/plot_svg.h"
#include "io/plots/plot_ticks.h"
#include "tests/io/plots/markup.h"

#include <catch2/catch.hpp>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>

using namespace viscard;
using namespace viscard::test;

namespace {

Plot small_plot() {
  PlotPanel panel;
  panel.x.label = "time (s)";
  panel.y.label = "force (N)";
  panel.series = {{.label = "fit", .x = {1.0, 2.0, 3.0}, .y = {1.0, 4.0, 9.0}}};
  return {.title = "Small", .description = "A parabola.", .panels = {panel}};
}

std::string path_before() {
  const char* path = std::getenv("PATH");
  return path == nullptr ? "" : path;
}

// Puts an environment variable back when the test ends.
class WithPath {
 public:
  explicit WithPath(const std::string& path) : before_(path_before()) {
    ::setenv("PATH", path.c_str(), 1);
  }
  ~WithPath() { ::setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// The area of the data, px from the upper left corner of the picture.
struct Frame {
  double left = 0.0, bottom = 0.0, width = 0.0, height = 0.0;
};

// From the path that draws both axes: down on the left, then right along the bottom.
Frame frame_of(const std::string& svg) {
  const std::string grey = "stroke='rgb(107, 114, 128)'";
  for (std::size_t at = svg.find(grey); at != std::string::npos; at = svg.find(grey, at + 1)) {
    double x[3] = {}, y[3] = {};
    const std::size_t path = svg.find("d='M", at);
    if (path == std::string::npos) break;
    const int n = std::sscanf(svg.c_str() + path, "d='M%lf,%lf L%lf,%lf L%lf,%lf", &x[0], &y[0],
                              &x[1], &y[1], &x[2], &y[2]);
    if (n == 6 && x[0] == x[1] && y[1] == y[2]) return {x[0], y[1], x[2] - x[0], y[1] - y[0]};
  }
  FAIL("the picture has no axes");
  return {};
}

// Where a text begins or has its middle, px from the left.
double left_of(const std::string& svg, const std::string& text) {
  const std::size_t at = svg.find(">" + text + "<");
  REQUIRE(at != std::string::npos);
  double x = 0.0;
  REQUIRE(std::sscanf(svg.c_str() + svg.rfind("translate(", at), "translate(%lf", &x) == 1);
  return x;
}

}  // namespace

TEST_CASE("a plot is well-formed SVG with a title and a description", "[io][report]") {
  const std::string svg = svg_from_plot(small_plot(), "fig-1");
  CHECK(first_fault(svg) == "");
  CHECK(svg.rfind("<svg ", 0) == 0);
  CHECK(svg.find("<title id=\"fig-1-title\">Small</title>") != std::string::npos);
  CHECK(svg.find("<desc id=\"fig-1-desc\">A parabola.</desc>") != std::string::npos);
  CHECK(svg.find("aria-labelledby=\"fig-1-title fig-1-desc\"") != std::string::npos);
  for (const char* text : {"time (s)", "force (N)", "fit"}) {
    CHECK(svg.find(std::string(">") + text + "<") != std::string::npos);
  }
}

TEST_CASE("a line passes through its points at the scale of the axes", "[io][report]") {
  Plot plot = small_plot();
  plot.width_px = 500;
  plot.height_px = 300;
  plot.panels[0].x.min = plot.panels[0].y.min = 0.0;
  plot.panels[0].x.max = 4.0;
  plot.panels[0].y.max = 10.0;
  plot.panels[0].series[0].label = "";  // no sample of the line in a legend
  const std::string svg = svg_from_plot(plot, "f");
  const Frame frame = frame_of(svg);
  const std::size_t path = svg.find("d='M", svg.find("stroke='rgb(  0, 114, 178)'"));
  REQUIRE(path != std::string::npos);
  double x[3] = {}, y[3] = {};
  REQUIRE(std::sscanf(svg.c_str() + path, "d='M%lf,%lf L%lf,%lf L%lf,%lf", &x[0], &y[0], &x[1],
                      &y[1], &x[2], &y[2]) == 6);
  for (int i = 0; i < 3; ++i) {
    const double value = i + 1.0;
    // gnuplot rounds to 0.01 px
    CHECK(x[i] == Approx(frame.left + frame.width * value / 4.0).margin(0.02));
    CHECK(y[i] == Approx(frame.bottom - frame.height * value * value / 10.0).margin(0.02));
  }
}

TEST_CASE("the name of a phase stands at its line on a logarithmic axis too", "[io][report]") {
  Plot plot = small_plot();
  PlotPanel& panel = plot.panels[0];
  panel.x.is_log = true;
  panel.series[0].x = {0.01, 1.0, 100.0};
  panel.notes = {{0.05, "first"}, {1.0, "second"}, {20.0, "third"}};
  const std::string svg = svg_from_plot(plot, "n");
  const Frame frame = frame_of(svg);
  const AxisSpan span = panel_spans(panel).x;
  for (const PlotNote& note : panel.notes) {
    CAPTURE(note.text);
    // Half the width of a letter: what gnuplot may leave beside a text.
    CHECK(left_of(svg, note.text) ==
          Approx(frame.left + frame.width * fraction_of(span, note.x)).margin(3.0));
  }
}

TEST_CASE("the label of an axis has room beside long numbers", "[io][report]") {
  Plot plot = small_plot();
  plot.panels[0].y.label = "strain";
  plot.panels[0].series[0].y = {-1e-4, 3e-4, 6e-4};
  const std::string svg = svg_from_plot(plot, "n");
  CHECK(left_of(svg, "strain") > 12.0);  // the height of its letters, which are turned
}

TEST_CASE("numbers below a narrow panel stand apart", "[io][report]") {
  const double low = GENERATE(0.0, 1.83846, -250000.0);
  const double length = GENERATE(2.6e-4, 0.3, 7.0, 8e4);
  const double length_px = GENERATE(60.0, 160.0, 900.0);
  const AxisTicks ticks = ticks_of({}, {low, low + length, false}, length_px, true, false);
  CAPTURE(low, length, length_px, ticks.step, ticks.characters);
  CHECK(ticks.shown.low <= low + 1e-6 * length);  // rounding only
  CHECK(ticks.shown.high >= low + (1.0 - 1e-6) * length);
  const double apart_px = length_px * ticks.step / (ticks.shown.high - ticks.shown.low);
  const double least_px = 6.7 * static_cast<double>(ticks.characters);  // digits of the font
  CHECK((apart_px >= least_px || apart_px >= 0.5 * length_px));         // two numbers at least
}

TEST_CASE("an axis of numbers that doubles hardly tell apart has numbers too", "[io][report]") {
  const double low = GENERATE(1e17, -1e300);
  const AxisTicks ticks =
      ticks_of({}, {low, std::nextafter(low, INFINITY), false}, 400.0, true, false);
  CHECK(ticks.characters > 3);
  CHECK(ticks.step > 0.0);
}

TEST_CASE("all logarithmic axes of a picture write their numbers alike", "[io][report]") {
  Plot plot = small_plot();
  PlotPanel& panel = plot.panels[0];
  panel.x.is_log = panel.y.is_log = true;
  panel.series[0].x = {0.01, 0.1, 10.0};
  panel.series[0].y = {1.0, 10.0, 100.0};
  CHECK(svg_from_plot(plot, "n").find(">0.01<") != std::string::npos);
  CHECK(number_on_axes(plot, 1e-3) == "0.001");
  plot.panels.push_back(panel);
  plot.panels[1].series[0].y = {1e-5, 1e-3, 1.0};
  plot.height_px = 600;
  CHECK(svg_from_plot(plot, "n").find(">0.01<") == std::string::npos);
  CHECK(number_on_axes(plot, 1e-3) == "10⁻³");
  CHECK(number_on_axes(plot, 2e-3) == "2×10⁻³");
  CHECK(number_on_axes(plot, 1e3) == "10³");
}

TEST_CASE("two figures on one page share no id and refer only to their own", "[io][report]") {
  const std::string page = svg_from_plot(small_plot(), "a") + svg_from_plot(small_plot(), "b");
  const std::vector<std::string> ids = ids_of(page);
  REQUIRE(ids.size() > 4);
  CHECK(std::set<std::string>(ids.begin(), ids.end()).size() == ids.size());
  for (const std::string& id : ids) CHECK((id.rfind("a-", 0) == 0 || id.rfind("b-", 0) == 0));
  CHECK(page.find("href='#gp") == std::string::npos);
  CHECK(page.find("url(#") == std::string::npos);
}

TEST_CASE("names of any spelling stay text in a plot", "[io][report]") {
  const std::string nasty = GENERATE(as<std::string>(), "", "'", "''", "a''b", "\"'", "'\"") +
                            "</text><script>alert('1')</script> & \"q\" _a^b {x} @ ~ `date` \\n'";
  Plot plot = small_plot();
  plot.title = plot.description = nasty;
  plot.panels[0].title = plot.panels[0].x.label = plot.panels[0].series[0].label = nasty;
  plot.panels[0].notes = {{1.5, nasty.substr(0, 20)}};
  const std::string svg = svg_from_plot(plot, "n");
  CHECK(first_fault(svg) == "");
  CHECK(svg.find("<script") == std::string::npos);
  CHECK(count_of(text_of(svg), nasty) == 5);
}

TEST_CASE("dots carry their names where there is room, and none covers another", "[io][report]") {
  Plot plot = small_plot();
  PlotSeries dots{.mark = Mark::kPoints, .label = "", .x = {1.0, 2.0}, .y = {2.0, 6.0}};
  dots.names = {"alone", "apart & free"};
  // Thirty dots in one place have room for a few names only.
  PlotSeries crowd{.mark = Mark::kPoints, .label = ""};
  for (int i = 0; i < 30; ++i) {
    crowd.x.push_back(3.0);
    crowd.y.push_back(4.0 + 1e-3 * i);
    crowd.names.push_back("crowd " + std::to_string(i));
  }
  plot.panels.front().series.push_back(dots);
  plot.panels.front().series.push_back(crowd);
  const std::string svg = svg_from_plot(plot, "p");
  CHECK(count_of(svg, ">alone<") == 1);
  CHECK(count_of(svg, ">apart &amp; free<") == 1);
  CHECK(count_of(svg, ">crowd ") >= 1);
  CHECK(count_of(svg, ">crowd ") <= 4);  // at most one on each side of the place
  crowd.names.pop_back();
  plot.panels.front().series.back() = crowd;
  CHECK_THROWS_AS(svg_from_plot(plot, "p"), std::invalid_argument);
}

TEST_CASE("values that are not finite never reach the picture", "[io][report]") {
  Plot plot = small_plot();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PlotSeries& series = plot.panels[0].series[0];
  series.x = {1.0, nan, 2.0, 3.0, INFINITY};
  series.y = {1.0, 2.0, nan, 4.0, 5.0};
  const std::string svg = svg_from_plot(plot, "n");
  CHECK(first_fault(svg) == "");
  for (const char* bad : {"nan", "NaN", "inf", "Inf"}) CHECK(svg.find(bad) == std::string::npos);
}

TEST_CASE("all marks, several panels and a logarithmic axis make one picture", "[io][report]") {
  Plot plot = small_plot();
  PlotPanel panel = plot.panels[0];
  panel.x.is_log = panel.y.is_log = true;
  const std::vector<double> x{0.1, 1.0, 10.0}, low{0.5, 1.5, 2.5}, y{1.0, 2.0, 3.0},
      high{2.0, 3.0, 4.0};
  panel.series = {
      {.mark = Mark::kBand, .label = "band", .x = x, .y_low = low, .y_high = high},
      {.mark = Mark::kPoints, .label = "dots", .x = x, .y = y, .is_hollow = true},
      {.mark = Mark::kErrorBars, .label = "bars", .x = x, .y = y, .y_low = low, .y_high = high},
      {.mark = Mark::kLine, .label = "dashes", .x = x, .y = y, .is_dashed = true}};
  plot.panels = {panel, plot.panels[0], panel};
  plot.columns = 2;
  plot.height_px = 600;
  const std::string svg = svg_from_plot(plot, "m");
  CHECK(first_fault(svg) == "");
  CHECK(count_of(svg, "<polygon") >= 2);
  CHECK(svg.find("stroke-dasharray") != std::string::npos);
}

TEST_CASE("a plot of nothing, of no size or without a proper id is refused", "[io][report]") {
  Plot plot = small_plot();
  CHECK_THROWS_AS(svg_from_plot(plot, "a b"), std::invalid_argument);
  CHECK_THROWS_AS(svg_from_plot(plot, ""), std::invalid_argument);
  plot.height_px = 50;
  CHECK_THROWS_WITH(svg_from_plot(plot, "a"), Catch::Contains("too small"));
  plot = small_plot();
  plot.panels[0].x.is_log = true;
  plot.panels[0].series[0].x = {-1.0, 0.0, -3.0};
  CHECK_THROWS_WITH(svg_from_plot(plot, "a"), Catch::Contains("nothing to draw"));
}

TEST_CASE("a picture that the limit on the size of files cuts off is named so", "[io][plots]") {
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handled = std::signal(SIGXFSZ, SIG_IGN);  // as the program does
  const rlimit small{4096, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string text;
  try {
    svg_from_plot(small_plot(), "a");
  } catch (const std::runtime_error& error) {
    text = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handled);
  CHECK(text.find("ulimit -f") != std::string::npos);
}

TEST_CASE("without gnuplot the message says how to get it", "[io][report]") {
  const WithPath nowhere("/nonexistent");
  CHECK_THROWS_WITH(svg_from_plot(small_plot(), "a"),
                    Catch::Contains("apt-get install gnuplot-nox"));
}

TEST_CASE("an error of gnuplot comes back as one line with its reason", "[io][report]") {
  CHECK_THROWS_WITH(
      run_gnuplot("set terminal svg\nplot nothing_of_that_name\n"),
      Catch::Contains("undefined variable: nothing_of_that_name") && !Catch::Contains("\n"));
}

TEST_CASE("a script and an output larger than any pipe are handled", "[io][report]") {
  std::string script = "set terminal svg\n$d << EOD\n";
  for (int i = 0; i < 60000; ++i) script += std::to_string(i) + " " + std::to_string(i % 97) + "\n";
  script += "EOD\nplot $d with lines\n";
  const std::string svg = run_gnuplot(script);
  CHECK(script.size() > 400000);
  CHECK(svg.size() > 400000);
  CHECK(svg.find("</svg>") != std::string::npos);
}

TEST_CASE("any bytes become safe markup", "[io][report]") {
  CHECK(escaped_markup("a<b>&\"'") == "a&lt;b&gt;&amp;&quot;&#39;");
  CHECK(escaped_markup("E₀ = 1·10⁶ 𝛼") == "E₀ = 1·10⁶ 𝛼");
  CHECK(escaped_markup(std::string("x\0y\x1b", 4)) == "x y ");
  CHECK(escaped_markup("\xff\xc0\xaf\xed\xa0\x80") ==
        "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  CHECK(escaped_markup("cut \xe2\x82") == "cut \xEF\xBF\xBD\xEF\xBF\xBD");
}
