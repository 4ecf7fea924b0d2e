#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A picture as data: panels of series on linear or logarithmic axes, turned into SVG by gnuplot in
// one calm style. Values are in whatever unit the axis label names; the picture scales nothing.

// Colours that stay apart for readers with a colour-vision deficiency.
// Source: Okabe & Ito, Color Universal Design (2008).
enum class Ink { kBlue, kVermillion, kGreen, kPurple, kOrange, kSky, kBlack, kGrey };
Ink ink_of_series(std::size_t index);  // one colour after the other, again from the start after six

enum class Mark {
  kLine,       // y over x; a value that is not finite breaks the line
  kPoints,     // one dot each
  kBand,       // filled between y_low and y_high, without outline
  kErrorBars,  // a dot with bars y_low..y_high and, when given, x_low..x_high
};

struct PlotSeries {
  Mark mark = Mark::kLine;
  std::string label;  // empty: not in the legend
  std::vector<double> x, y;
  std::vector<double> y_low, y_high;  // kBand (y unused) and kErrorBars
  std::vector<double> x_low, x_high;  // kErrorBars
  Ink ink = Ink::kBlue;
  bool is_dashed = false;
  bool is_hollow = false;  // points and error bars: an open ring
  double size = 1.0;       // of line width or dot
};

struct PlotAxis {
  std::string label;  // with its unit, "force (N)"
  bool is_log = false;
  std::optional<double> min, max;  // from the data, with a margin, unless given
};

// A thin vertical line where a phase begins; its name stands above the panel, between this line and
// the next, unless there is no room for it.
struct PlotNote {
  double x = 0.0;
  std::string text;
};

struct PlotPanel {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotNote> notes;
  double height_share = 1.0;         // of the rows of one column; the first panel of a row decides
  bool shares_x_with_below = false;  // no tick labels and no axis label at the bottom
};

struct Plot {
  std::string title;              // for readers who cannot see it, and as tooltip
  std::string description;        // what it shows, one or two sentences, likewise
  std::vector<PlotPanel> panels;  // row by row
  int columns = 1;
  int width_px = 1040;
  int height_px = 360;
};

// A complete <svg> element without XML declaration, to stand in a page or in a file. Every id in it
// begins with `id` (letters, digits, '-'), so that several figures can share a page. Series of more
// points than pixels are thinned first: lines to the extremes within each pixel column, dots to one
// per cell of the picture.
// Throws std::invalid_argument on an id or series that makes no sense or a panel without a finite
// value; std::runtime_error if gnuplot is not installed or fails, with its message.
std::string svg_from_plot(const Plot& plot, const std::string& id);

// True when some series of the panel has a point that can be drawn on its axes.
bool has_something_to_draw(const PlotPanel& panel);

}  // namespace viscard
