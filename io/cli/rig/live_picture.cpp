#include "io/cli/rig/live_view.h"
#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {
namespace {

constexpr std::size_t kSparkWidth = 24;
constexpr int kWidth_px = 960, kHeight_px = 420, kMargin_px = 56;

constexpr const char* kStyle =
    ":root{color-scheme:light dark;--ink:#222;--soft:#666;--page:#fff;--wash:#fafafa;--line:#ddd;"
    "--force:#0072b2;--limit:#d55e00}"
    "body{font:16px/1.5 system-ui,sans-serif;margin:2rem auto;padding:0 1rem;max-width:62rem;"
    "color:var(--ink);background:var(--page)}"
    "svg{width:100%;height:auto;background:var(--wash)}svg text{fill:var(--ink)}"
    "dl{display:flex;flex-wrap:wrap;gap:.5rem 2.5rem;margin:0 0 1rem}"
    "dt{color:var(--soft);font-size:.8rem}"
    "dd{margin:0;font-size:1.5rem;font-variant-numeric:tabular-nums}"
    "@media(prefers-color-scheme:dark){:root{--ink:#e3e7eb;--soft:#a2acb6;--page:#141414;"
    "--wash:#1c2126;--line:#3a424b;--force:#56b4e9;--limit:#ff9d62}}"
    // Letters of the drawing keep a size that can be read; the drawing scrolls.
    "@media(max-width:40rem){h1{font-size:1.3rem;overflow-wrap:anywhere}dd{font-size:1.2rem}"
    ".plot{overflow-x:auto}.plot svg{width:44rem}}";

struct Scale {
  double low = 0.0, high = 1.0;
  double from_px = 0.0, to_px = 1.0;
  double px(double value) const {
    return from_px + (value - low) / (high - low) * (to_px - from_px);
  }
};

// A step of 1, 2 or 5 times a power of ten, of which the range has about five.
double tick_step(double range) {
  const double raw = range / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double share = raw / power;
  return power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
}

std::string ticks(const Scale& x, const Scale& y) {
  std::string svg;
  const double dx = tick_step(x.high - x.low), dy = tick_step(y.high - y.low);
  for (double t = std::ceil(x.low / dx) * dx; t <= x.high; t += dx) {
    svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{:g}</text>", x.px(t),
                       kHeight_px - kMargin_px + 20, t);
  }
  for (double f = std::ceil(y.low / dy) * dy; f <= y.high; f += dy) {
    const double shown = std::abs(f) < 1e-9 * dy ? 0.0 : f;
    svg += fmt::format(
        "<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='var(--line)'/>"
        "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5:g}</text>",
        kMargin_px, kWidth_px - 10, y.px(f), kMargin_px - 8, y.px(f) + 5, shown);
  }
  return svg;
}

std::string curve(const LiveHistory& history, double limit_N) {
  const auto& t = history.time_s();
  const auto& f = history.force_N();
  if (t.size() < 2 || !(t.back() > t.front())) return "<p>Waiting for readings.</p>";
  const auto [least, most] = std::minmax_element(f.begin(), f.end());
  const double margin = std::max(1e-3, 0.05 * (*most - *least));
  const Scale x{t.front(), t.back(), 1.0 * kMargin_px, kWidth_px - 10.0};
  const Scale y{*least - margin, *most + margin, 1.0 * kHeight_px - kMargin_px, 10.0};
  std::string svg = fmt::format(
      "<div class='plot'><svg viewBox='0 0 {} {}' role='img' aria-label='force against time' "
      "font-size='14'>",
      kWidth_px, kHeight_px);
  svg += ticks(x, y);
  if (limit_N < y.high) {
    svg += fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='var(--limit)'/>",
                       kMargin_px, kWidth_px - 10, y.px(limit_N));
  }
  svg += "<polyline fill='none' stroke='var(--force)' stroke-width='1.5' points='";
  for (std::size_t i = 0; i < t.size(); ++i) {
    svg += fmt::format("{:.1f},{:.1f} ", x.px(t[i]), y.px(f[i]));
  }
  return svg + fmt::format(
                   "'/><text x='{}' y='{}' text-anchor='middle'>time (s)</text>"
                   "<text x='12' y='{}' transform='rotate(-90 12 {})' "
                   "text-anchor='middle'>force (N)</text></svg></div>",
                   kWidth_px / 2, kHeight_px - 12, kHeight_px / 2, kHeight_px / 2);
}

}  // namespace

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
  std::string page =
      "<!doctype html><html lang='en'><head><meta charset='utf-8'>"
      "<meta name='viewport' content='width=device-width, initial-scale=1'>";
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
