#include "io/plots/plot_script.h"

#include "io/basics/words.h"
#include "io/plots/plot_names.h"
#include "io/plots/plot_points.h"
#include "io/plots/plot_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr const char* kGridColour = "#e4e7ea";
constexpr const char* kAxisColour = "#6b7280";
constexpr const char* kTextColour = "#1f2933";
constexpr const char* kNoteColour = "#b4bac1";
constexpr double kNoteCharacter_px = 6.0;  // mean width of a character of the 10 px font
// Margins beside the data, in characters. They are the same in every panel, so that the axes of
// panels above each other line up; gnuplot would fit each to its own tick labels.
constexpr std::size_t kLeastLeftMargin = 10;
constexpr std::size_t kBesideNumbers =
    5;  // the label of the axis with its gaps; gnuplot drops what has no room
constexpr std::size_t kRightMargin = 2;
constexpr double kCharacter_px = 8.2;  // gnuplot's character of the 12 px font

constexpr double kLinesBesideData_px = 100.0;  // legend above, labels below the data

using Out = std::back_insert_iterator<std::string>;

const char* colour(Ink ink) {
  constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                      "#e69f00", "#56b4e9", "#222222", "#8a929b"};
  return kColours[static_cast<std::size_t>(ink)];
}

// A gnuplot string in single quotes: no escapes, no command substitution. gnuplot 5.4 ends the string at some
// doubled quotes, so quotes stand in strings of their own.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += "'.\"'\".'";
    } else {
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out + "'";
}

// Position and size of a panel, as fractions of the picture from its lower left corner.
struct PanelPlace {
  double left = 0.0, bottom = 0.0, width = 1.0, height = 1.0;
};

std::vector<PanelPlace> panel_places(const Plot& plot) {
  if (plot.columns < 1 || plot.panels.empty()) {
    throw std::invalid_argument(fmt::format("plot '{}' has no panel; add one", plot.title));
  }
  const auto columns = static_cast<std::size_t>(plot.columns);
  double shares = 0.0, least_share = plot.panels.front().height_share;
  for (std::size_t first = 0; first < plot.panels.size(); first += columns) {
    shares += plot.panels[first].height_share;
    least_share = std::min(least_share, plot.panels[first].height_share);
  }
  const double width = 1.0 / plot.columns;
  if (width * plot.width_px < kLeastPanelWidth_px ||
      !(least_share / shares * plot.height_px >= kLeastPanelHeight_px)) {
    throw std::invalid_argument(fmt::format(
        "plot '{}': {} x {} px is too small for its panels; each needs {:.0f} x {:.0f} px",
        plot.title, plot.width_px, plot.height_px, kLeastPanelWidth_px, kLeastPanelHeight_px));
  }
  std::vector<PanelPlace> places;
  double top = 1.0, height = 0.0;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const std::size_t column = i % columns;
    if (column == 0) {
      height = plot.panels[i].height_share / shares;
      top -= height;
    }
    places.push_back({static_cast<double>(column) * width, top, width, height});
  }
  return places;
}

// A panel's ranges and numbers, and where its data are.
struct PanelLayout {
  PanelPlace place;
  AxisTicks x, y;
  double width_px = 0.0, height_px = 0.0;  // of the data
};

// Their ticks are chosen from the left margin, which is that of the longest number on any y axis.
std::vector<PanelLayout> panel_layouts(const Plot& plot, std::size_t& left_margin) {
  const bool has_powers = has_powers_of_ten(plot);
  std::vector<PanelLayout> layouts;
  left_margin = kLeastLeftMargin;
  for (const PanelPlace& place : panel_places(plot)) {
    const PlotPanel& panel = plot.panels[layouts.size()];
    PanelLayout one{.place = place, .x = {}, .y = {}};
    one.height_px = place.height * plot.height_px - kLinesBesideData_px;
    one.y = ticks_of(panel.y, panel_spans(panel).y, one.height_px, false, has_powers);
    left_margin = std::max(left_margin, one.y.characters + kBesideNumbers);
    layouts.push_back(std::move(one));
  }
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    PanelLayout& one = layouts[i];
    one.width_px = one.place.width * plot.width_px -
                   static_cast<double>(left_margin + kRightMargin) * kCharacter_px;
    one.x =
        ticks_of(plot.panels[i].x, panel_spans(plot.panels[i]).x, one.width_px, true, has_powers);
  }
  return layouts;
}

// The second axis carries the names of phases. It gets scale and range of the first one itself: gnuplot
// would take natural logarithms on one and decimal ones on the other.
void write_axis(Out out, char name, const PlotAxis& axis, const AxisTicks& ticks, bool has_labels) {
  for (const char* const number : {"", "2"}) {
    fmt::format_to(out, "{0} logscale {1}{2}\nset {1}{2}range [{3:.12g}:{4:.12g}]\n",
                   axis.is_log ? "set" : "unset", name, number, ticks.shown.low, ticks.shown.high);
  }
  fmt::format_to(out, "set {}tics {}\n", name,
                 axis.is_log ? "autofreq" : fmt::format("{:.12g}", ticks.step));
  fmt::format_to(out, "set format {} '{}'\n", name, has_labels ? ticks.format : "");
  fmt::format_to(out, "set {}label {} noenhanced textcolor rgb '{}'\n", name,
                 quoted(has_labels ? axis.label : ""), kTextColour);
}

// gnuplot would print names of short phases over each other, so those without room are left out.
void write_notes(Out out, const PlotPanel& panel, const AxisSpan& x, double width_px) {
  std::string names;
  for (std::size_t i = 0; i < panel.notes.size(); ++i) {
    const PlotNote& note = panel.notes[i];
    const auto px = [&](double value) {
      return std::clamp(fraction_of(x, value), 0.0, 1.0) * width_px;
    };
    const double left_px = px(note.x);
    const double right_px = i + 1 < panel.notes.size() ? px(panel.notes[i + 1].x) : width_px;
    if (left_px > 0.0 && left_px < width_px) {
      fmt::format_to(out,
                     "set arrow from first {0:.12g}, graph 0 to first {0:.12g}, graph 1 nohead "
                     "back lc rgb '{1}' lw 0.8 dashtype (4,3)\n",
                     note.x, kNoteColour);
    }
    const double needed_px =
        kNoteCharacter_px * static_cast<double>(length_in_characters(note.text));
    if (note.text.empty() || right_px - left_px < needed_px + 4.0) continue;
    names += fmt::format("{}{} {:.12g}", names.empty() ? "" : ", ", quoted(note.text),
                         std::max(note.x, x.low));
  }
  if (names.empty()) return;
  fmt::format_to(out,
                 "set x2tics left scale 0 offset 0,-0.4 noenhanced font 'sans-serif,10' textcolor "
                 "rgb '{}' ({})\n",
                 kAxisColour, names);
}

// The same ink as the dots, beside them.
void write_names(Out out, const PlotPanel& panel, const PanelSpans& spans, double width_px,
                 double height_px) {
  for (const PlacedName& name : placed_names(panel, spans, width_px, height_px)) {
    fmt::format_to(out,
                   "set label {} at first {:.12g}, first {:.12g} left offset graph {:.5f}, graph "
                   "{:.5f} noenhanced font 'sans-serif,9' textcolor rgb '{}'\n",
                   quoted(name.text), name.x, name.y, name.right_px / width_px,
                   name.up_px / height_px, colour(name.ink));
  }
}

void write_data(Out out, std::size_t index, const PlotSeries& series,
                const std::vector<PlotPoint>& points) {
  fmt::format_to(out, "$d{} << EOD\n", index);
  for (const PlotPoint& p : points) {
    if (p.breaks_before) fmt::format_to(out, "\n");
    fmt::format_to(out, "{:.9g} {:.9g}", p.x, series.mark == Mark::kBand ? p.y_low : p.y);
    if (series.mark == Mark::kBand) fmt::format_to(out, " {:.9g}", p.y_high);
    if (series.mark == Mark::kErrorBars) {
      fmt::format_to(out, " {:.9g} {:.9g} {:.9g} {:.9g}", p.x_low, p.x_high, p.y_low, p.y_high);
    }
    fmt::format_to(out, "\n");
  }
  fmt::format_to(out, "EOD\n");
}

constexpr std::size_t kPatterns = 6;

std::size_t pattern_of(const PlotSeries& series) {
  return static_cast<std::size_t>(std::max(0, series.pattern)) % kPatterns;
}

const char* dashes_of(const PlotSeries& series) {
  constexpr const char* kDashes[kPatterns] = {"",
                                              " dashtype (9,3)",
                                              " dashtype (2,3)",
                                              " dashtype (9,3,2,3)",
                                              " dashtype (4,2)",
                                              " dashtype (9,3,2,3,2,3)"};
  return series.is_dashed ? " dashtype (7,4)" : kDashes[pattern_of(series)];
}

// gnuplot's number of a symbol: round, square, triangle, diamond, triangle downwards, pentagon.
int symbol_of(const PlotSeries& series) {
  constexpr int kHollow[kPatterns] = {6, 4, 8, 12, 10, 14};
  return kHollow[pattern_of(series)] + (series.is_hollow ? 0 : 1);
}

std::string style_of(const PlotSeries& series) {
  const char* rgb = colour(series.ink);
  const int dot = symbol_of(series);
  switch (series.mark) {
    case Mark::kBand:
      return fmt::format(
          "using 1:2:3 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder", rgb);
    case Mark::kErrorBars:
      return fmt::format("using 1:2:3:4:5:6 with xyerrorbars lc rgb '{}' lw {:.3g} pt {} ps {:.3g}",
                         rgb, 1.4 * series.size, dot, 0.6 * series.size);
    case Mark::kPoints:
      return fmt::format("using 1:2 with points lc rgb '{}' lw {:.3g} pt {} ps {:.3g}", rgb,
                         series.is_hollow ? 1.3 : 1.0, dot, 0.34 * series.size);
    case Mark::kLine:
      break;
  }
  return fmt::format("using 1:2 with lines lc rgb '{}' lw {:.3g}{}", rgb, 1.7 * series.size,
                     dashes_of(series));
}

// gnuplot puts a title below the legend and in the middle; as the legend's own title it stands
// above it, where the panel begins.
void write_titles(Out out, const PlotPanel& panel) {
  const bool has_legend = std::any_of(panel.series.begin(), panel.series.end(),
                                      [](const PlotSeries& s) { return !s.label.empty(); });
  constexpr const char* kFont = "font 'sans-serif:Bold,13'";
  fmt::format_to(out, "set title {} noenhanced {} textcolor rgb '{}'\n",
                 quoted(has_legend ? "" : panel.title), kFont, kTextColour);
  if (has_legend && !panel.title.empty()) {
    fmt::format_to(out, "set key title {} left noenhanced {}\n", quoted(panel.title), kFont);
  } else {
    fmt::format_to(out, "set key notitle\n");
  }
}

void write_curves(Out out, const PlotPanel& panel, const PanelSpans& spans, int width_px,
                  int height_px) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const PlotSeries& series = panel.series[i];
    const std::vector<PlotPoint> points =
        visible_points(series, spans.x, spans.y, width_px, height_px);
    if (points.empty()) continue;
    write_data(out, i, series, points);
    fmt::format_to(std::back_inserter(command), "{}$d{} {} {}", command.size() > 5 ? ", " : "", i,
                   style_of(series),
                   series.label.empty() ? "notitle" : "title " + quoted(series.label));
  }
  fmt::format_to(out, "{}\n", command);
}

void write_panel(Out out, const Plot& plot, const PlotPanel& panel, const PanelLayout& layout) {
  const PanelPlace& place = layout.place;
  const PanelSpans spans{layout.x.shown, layout.y.shown};
  fmt::format_to(out, "unset arrow\nunset label\nunset x2tics\n");
  fmt::format_to(out, "set origin {:.6f},{:.6f}\nset size {:.6f},{:.6f}\n", place.left,
                 place.bottom, place.width, place.height);
  fmt::format_to(out, "set bmargin {}\n", panel.shares_x_with_below ? 1 : -1);
  write_axis(out, 'x', panel.x, layout.x, !panel.shares_x_with_below);
  write_axis(out, 'y', panel.y, layout.y, true);
  write_titles(out, panel);
  write_notes(out, panel, spans.x, layout.width_px);
  write_names(out, panel, spans, layout.width_px, layout.height_px);
  write_curves(out, panel, spans, static_cast<int>(layout.width_px), plot.height_px);
}

}  // namespace

std::string gnuplot_script(const Plot& plot) {
  std::size_t left_margin = 0;
  const std::vector<PanelLayout> layouts = panel_layouts(plot, left_margin);
  std::string script;
  const Out out = std::back_inserter(script);
  // Enhanced text is for powers of ten at the ticks only: every name is printed as it is.
  fmt::format_to(out,
                 "set terminal svg size {},{} dynamic enhanced font 'sans-serif,12' name 'figure'\n"
                 "set encoding utf8\nset minussign\nset errorbars small\nset pointintervalbox 0\n"
                 "set border 3 lc rgb '{}' lw 1\n"
                 "set tics scale 0.5,0.3 out nomirror textcolor rgb '{}'\n"
                 "set grid xtics ytics back lc rgb '{}' lw 1 dashtype solid\n"
                 "set lmargin {}\nset rmargin {}\n",
                 plot.width_px, plot.height_px, kAxisColour, kTextColour, kGridColour, left_margin,
                 kRightMargin);
  fmt::format_to(out,
                 "set key tmargin left Left reverse horizontal samplen 2.6 noenhanced textcolor "
                 "rgb '{}'\nset multiplot\n",
                 kTextColour);
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    write_panel(out, plot, plot.panels[i], layouts[i]);
  }
  fmt::format_to(out, "unset multiplot\n");
  return script;
}

}  // namespace viscard
