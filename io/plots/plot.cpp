#include "io/plots/plot.h"

#include "io/plots/plot_axis.h"
#include "io/plots/plot_gnuplot.h"
#include "io/plots/plot_layout.h"
#include "io/plots/plot_points.h"
#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace viscard {
namespace {

constexpr const char* kGridColour = "#e4e7ea";
constexpr const char* kAxisColour = "#6b7280";
constexpr const char* kTextColour = "#1f2933";
constexpr const char* kNoteColour = "#b4bac1";
constexpr double kNoteCharacter_px = 6.0;
constexpr int kPxPerLabelAcross = 70;
constexpr int kPxPerLabelUp = 32;

const char* colour(Ink ink) {
  switch (ink) {
    case Ink::kBlue:
      return "#0072b2";
    case Ink::kVermillion:
      return "#d55e00";
    case Ink::kGreen:
      return "#009e73";
    case Ink::kPurple:
      return "#cc79a7";
    case Ink::kOrange:
      return "#e69f00";
    case Ink::kSky:
      return "#56b4e9";
    case Ink::kBlack:
      return "#222222";
    case Ink::kGrey:
      break;
  }
  return "#8a929b";
}

// A gnuplot string in single quotes: no escapes, no command substitution.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "'";
}

struct PanelAxes {
  AxisRange x, y;
};

std::vector<double> values_along(const PlotPanel& panel, bool is_x) {
  std::vector<double> values;
  const auto add = [&](const std::vector<double>& more) {
    values.insert(values.end(), more.begin(), more.end());
  };
  for (const PlotSeries& series : panel.series) {
    add(is_x ? series.x : series.y);
    add(is_x ? series.x_low : series.y_low);
    add(is_x ? series.x_high : series.y_high);
  }
  return values;
}

PanelAxes axes_of(const PlotPanel& panel) {
  return {axis_range(panel.x, values_along(panel, true)),
          axis_range(panel.y, values_along(panel, false))};
}

using Out = std::back_insert_iterator<std::string>;

void write_axis(Out out, char name, const AxisRange& range, int length_px, bool has_labels) {
  fmt::format_to(out, "{} logscale {}\n", range.is_log ? "set" : "unset", name);
  fmt::format_to(out, "set {}range [{:.12g}:{:.12g}]\n", name, range.min, range.max);
  fmt::format_to(out, "set {}tics out nomirror textcolor rgb '{}' (", name, kTextColour);
  const char* separator = "";
  const int px_per_label = name == 'x' ? kPxPerLabelAcross : kPxPerLabelUp;
  for (const Tick& tick : axis_ticks(range, length_px, px_per_label)) {
    fmt::format_to(out, "{}{} {:.12g} {}", separator, quoted(has_labels ? tick.label : ""),
                   tick.value, tick.label.empty() ? 1 : 0);
    separator = ", ";
  }
  fmt::format_to(out, ")\n");
}

void write_labels(Out out, const Plot& plot, const PlotPanel& panel, const PanelBox& box) {
  const double width = plot.width_px, height = plot.height_px;
  const auto put = [&](const std::string& text, double x, double y, const char* how) {
    fmt::format_to(out, "set label {} at screen {:.6f},{:.6f} {} textcolor rgb '{}'\n",
                   quoted(text), x / width, 1.0 - y / height, how, kTextColour);
  };
  put(panel.y.label, box.left - 56.0, 0.5 * (box.top + box.bottom), "center rotate by 90");
  if (!panel.shares_x_with_below) {
    put(panel.x.label, 0.5 * (box.left + box.right), box.bottom + 36.0, "center");
  }
  if (!panel.title.empty()) {
    put(panel.title, box.left, box.title_top + 6.0, "left font 'sans-serif:Bold,13'");
  }
}

void write_notes(Out out, const PlotPanel& panel, const AxisRange& x, double width_px) {
  const auto px = [&](double value) {
    return std::clamp(axis_fraction(x, value), 0.0, 1.0) * width_px;
  };
  for (std::size_t i = 0; i < panel.notes.size(); ++i) {
    const PlotNote& note = panel.notes[i];
    const double left_px = px(note.x);
    const double right_px = i + 1 < panel.notes.size() ? px(panel.notes[i + 1].x) : width_px;
    if (left_px > 0.0 && left_px < width_px) {
      fmt::format_to(
          out,
          "set arrow from first {0:.12g}, graph 0 to first {0:.12g}, graph 1 nohead back "
          "lc rgb '{1}' lw 0.8 dashtype (4,3)\n",
          note.x, kNoteColour);
    }
    const double needed_px =
        kNoteCharacter_px * static_cast<double>(length_in_characters(note.text));
    if (note.text.empty() || right_px - left_px < needed_px + 4.0) continue;
    fmt::format_to(out,
                   "set label {} at graph {:.6f}, graph 1 center offset character 0,0.55 "
                   "font 'sans-serif,10' textcolor rgb '{}'\n",
                   quoted(note.text), 0.5 * (left_px + right_px) / width_px, kAxisColour);
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

std::string style_of(const PlotSeries& series) {
  const char* rgb = colour(series.ink);
  const int dot = series.is_hollow ? 6 : 7;
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
                     series.is_dashed ? " dashtype (7,4)" : "");
}

void write_key(Out out, const Plot& plot, const PanelBox& box) {
  fmt::format_to(out,
                 "set key at screen {:.6f},{:.6f} left top Left reverse horizontal maxcols {} "
                 "samplen 1.6 spacing 1 width -1 textcolor rgb '{}'\n",
                 (box.left - 6.0) / plot.width_px, 1.0 - (box.key_top - 5.0) / plot.height_px,
                 box.key_columns, kTextColour);
}

void write_panel(Out out, const Plot& plot, const PlotPanel& panel, const PanelBox& box) {
  const PanelAxes axes = axes_of(panel);
  const int width = static_cast<int>(box.right - box.left);
  const int height = static_cast<int>(box.bottom - box.top);
  fmt::format_to(out, "unset label\nunset arrow\n");
  fmt::format_to(out, "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n",
                 box.left / plot.width_px, box.right / plot.width_px);
  fmt::format_to(out, "set tmargin at screen {:.6f}\nset bmargin at screen {:.6f}\n",
                 1.0 - box.top / plot.height_px, 1.0 - box.bottom / plot.height_px);
  write_axis(out, 'x', axes.x, width, !panel.shares_x_with_below);
  write_axis(out, 'y', axes.y, height, true);
  write_labels(out, plot, panel, box);
  write_notes(out, panel, axes.x, width);
  write_key(out, plot, box);
  std::string command = "plot ";
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const PlotSeries& series = panel.series[i];
    const std::vector<PlotPoint> points = visible_points(series, axes.x, axes.y, width, height);
    if (points.empty()) continue;
    write_data(out, i, series, points);
    fmt::format_to(std::back_inserter(command), "{}$d{} {} {}", command.size() > 5 ? ", " : "", i,
                   style_of(series),
                   series.label.empty() ? "notitle" : "title " + quoted(series.label));
  }
  fmt::format_to(out, "{}\n", command);
}

void validate(const Plot& plot, const std::string& id) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  };
  if (id.empty() || !std::all_of(id.begin(), id.end(), is_plain)) {
    throw std::invalid_argument("plot: '" + id + "' is no id; use letters, digits and '-'");
  }
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotSeries& series : panel.series) validate(series);
    if (!has_something_to_draw(panel)) {
      throw std::invalid_argument("plot '" + plot.title + "': nothing to draw in a panel over " +
                                  panel.x.label);
    }
  }
}

}  // namespace

Ink ink_of_series(std::size_t index) {
  constexpr Ink kOrder[] = {Ink::kBlue,   Ink::kVermillion, Ink::kGreen,
                            Ink::kPurple, Ink::kOrange,     Ink::kSky};
  return kOrder[index % std::size(kOrder)];
}

bool has_something_to_draw(const PlotPanel& panel) {
  const PanelAxes axes = axes_of(panel);
  return std::any_of(panel.series.begin(), panel.series.end(), [&](const PlotSeries& series) {
    return !visible_points(series, axes.x, axes.y, 1000, 1000).empty();
  });
}

std::string svg_from_plot(const Plot& plot, const std::string& id) {
  validate(plot, id);
  const std::vector<PanelBox> boxes = panel_boxes(plot);
  std::string script;
  const Out out = std::back_inserter(script);
  fmt::format_to(
      out,
      "set terminal svg size {},{} dynamic noenhanced font 'sans-serif,12' name 'figure'\n"
      "set encoding utf8\nset multiplot\nset errorbars small\nset pointintervalbox 0\n"
      "set border 3 lc rgb '{}' lw 1\nset tics scale 0.5,0.3\n"
      "set grid xtics ytics back lc rgb '{}' lw 1 dashtype solid\n",
      plot.width_px, plot.height_px, kAxisColour, kGridColour);
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    write_panel(out, plot, plot.panels[i], boxes[i]);
  }
  fmt::format_to(out, "unset multiplot\n");
  return figure_from_gnuplot_svg(run_gnuplot(script), id, plot.title, plot.description,
                                 plot.width_px, plot.height_px);
}

}  // namespace viscard
