#include "io/cli/rig/live_view.h"
#include "io/plots/plot.h"
#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr std::size_t kSparkWidth = 24;

constexpr const char* kStyle =
    "body{font:16px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:62rem;color:#222}"
    "svg{width:100%;height:auto;background:#fafafa}"
    "dl{display:flex;gap:2.5rem;margin:0 0 1rem}dt{color:#666;font-size:.8rem}"
    "dd{margin:0;font-size:1.5rem;font-variant-numeric:tabular-nums}";

// The limit is drawn once the force comes close to it.
std::string curve(const LiveHistory& history, double limit_N) {
  const auto& t = history.time_s();
  const auto& f = history.force_N();
  if (t.size() < 2 || !(t.back() > t.front())) return "<p>Waiting for readings.</p>";
  PlotPanel panel{.x = {.label = "time (s)"}, .y = {.label = "force (N)"}};
  panel.series.push_back({.x = t, .y = f});
  if (limit_N < 1.05 * *std::max_element(f.begin(), f.end())) {
    panel.series.push_back({.label = "limit",
                            .x = {t.front(), t.back()},
                            .y = {limit_N, limit_N},
                            .ink = Ink::kVermillion});
  }
  try {
    return svg_from_plot({.title = "Force against time", .panels = {panel}, .height_px = 420},
                         "live");
  } catch (const std::runtime_error& error) {  // a run does not need gnuplot
    return "<p>" + escaped_markup(error.what()) + "</p>";
  }
}

}  // namespace

void LiveHistory::add(double time_s, double force_N) {
  if (n_seen_++ % keep_every_ != 0) return;
  time_s_.push_back(time_s);
  force_N_.push_back(force_N);
  if (time_s_.size() < kMost) return;
  for (std::size_t i = 0; i < kMost / 2; ++i) {
    time_s_[i] = time_s_[2 * i];
    force_N_[i] = force_N_[2 * i];
  }
  time_s_.resize(kMost / 2);
  force_N_.resize(kMost / 2);
  keep_every_ *= 2;
}

std::string sparkline(const std::vector<double>& values, std::size_t width) {
  static constexpr std::array<const char*, 8> kBlocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  if (values.empty() || width == 0) return "";
  const std::size_t n = std::min(width, values.size());
  std::vector<double> shares(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(i * values.size() / n);
    const auto to = values.begin() + static_cast<std::ptrdiff_t>((i + 1) * values.size() / n);
    shares[i] = *std::max_element(from, to);
  }
  const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
  const double range = *most - *least;
  std::string line;
  for (const double value : shares) {
    const double share = range > 0.0 ? (value - *least) / range : 0.0;
    line += kBlocks[static_cast<std::size_t>(std::lround(7.0 * share))];
  }
  return line;
}

std::string clock_from_s(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::max(0.0, seconds)));
  if (whole >= 3600) {
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string line_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           std::size_t columns) {
  const std::string words =
      fmt::format("{:<9} {:7.3f} N {:4.0f} % of the cell {:7.1f} um", now.phase, now.force_N,
                  100.0 * now.force_N / capacity_N, now.depth_m * 1e6);
  const std::string left = clock_from_s(now.time_left_s) + " left";
  if (words.size() + left.size() + 2 > columns) return words.substr(0, columns);
  const std::size_t room = columns - words.size() - left.size() - 2;
  if (room < 6) return words + "  " + left;
  return words + "  " + sparkline(history.force_N(), std::min(kSparkWidth, room - 2)) + "  " + left;
}

std::string page_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           double limit_N, const std::string& title, bool is_over) {
  const std::string name = escaped_markup(title);
  std::string page = "<!doctype html><html lang='en'><head><meta charset='utf-8'>";
  if (!is_over) page += "<meta http-equiv='refresh' content='1'>";
  page += fmt::format("<title>{}</title><style>{}</style></head><body><h1>{}</h1><dl>", name,
                      kStyle, name);
  const auto fact = [&](const char* what, const std::string& value) {
    page += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", what, value);
  };
  fact("phase", is_over ? "over" : escaped_markup(now.phase));
  fact("force", fmt::format("{:.3f} N", now.force_N));
  fact("of the cell", fmt::format("{:.0f} %", 100.0 * now.force_N / capacity_N));
  fact("depth", fmt::format("{:.1f} um", now.depth_m * 1e6));
  fact("left", is_over ? "0:00" : clock_from_s(now.time_left_s));
  return page + "</dl>" + curve(history, limit_N) + "</body></html>\n";
}

}  // namespace viscard
