#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A picture as data: panels of series on linear or logarithmic axes. The values are in the unit
// that the label of their axis names; nothing is scaled on the way to the picture.

// Colours that readers with a colour-vision deficiency can tell apart.
// Source: Okabe & Ito, Color Universal Design (2008).
enum class Ink { kBlue, kVermillion, kGreen, kPurple, kOrange, kSky, kBlack, kGrey };

// The ink of the series number `index`; the seventh series gets the colour of the first.
constexpr Ink ink_of_series(std::size_t index) {
  constexpr Ink kOrder[] = {Ink::kBlue,   Ink::kVermillion, Ink::kGreen,
                            Ink::kPurple, Ink::kOrange,     Ink::kSky};
  return kOrder[index % 6];
}

// How a series is drawn.
enum class Mark {
  kLine,       // y over x; a value that is not finite breaks the line
  kPoints,     // one dot each
  kBand,       // filled between y_low and y_high, without outline
  kErrorBars,  // a dot with bars y_low..y_high and, when given, x_low..x_high
};

// Points, a line or a band, in the units of the axes.
struct PlotSeries {
  Mark mark = Mark::kLine;
  std::string label;  // empty: not in the legend
  std::vector<double> x, y;
  std::vector<double> y_low, y_high;  // kBand (y unused) and kErrorBars
  std::vector<double> x_low, x_high;  // kErrorBars
  // Of dots, one each; empty text: none. A name without room beside its dot is left out, those of
  // earlier dots and series first served.
  std::vector<std::string> names;
  Ink ink = Ink::kBlue;
  bool is_dashed = false;  // wide dashes, for limits and truths
  // Of dashes or of the shape of dots, so that series differ without colour too: 0 is a solid line
  // and round dots. The number after the last begins anew.
  int pattern = 0;
  bool is_hollow = false;  // points and error bars: an open ring
  double size = 1.0;       // factor on the line width or on the diameter of the dot
};

// One axis of a panel.
struct PlotAxis {
  std::string label;  // with its unit, "force (N)"
  bool is_log = false;
  // An end that is not given is the round number at or beyond the last value.
  std::optional<double> min, max;
};

// A thin vertical line where a phase begins. Its name stands above the panel, to the right of the
// line; it is left out if it does not fit before the next line.
struct PlotNote {
  double x = 0.0;
  std::string text;
};

// Series on common axes.
struct PlotPanel {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotNote> notes;
  double height_share = 1.0;         // relative to the other rows; the first panel of a row decides
  bool shares_x_with_below = false;  // no tick labels and no axis label at the bottom
};

// Panels beside or below each other.
struct Plot {
  std::string title;              // for screen readers, and as tooltip
  std::string description;        // one or two sentences for screen readers
  std::vector<PlotPanel> panels;  // row by row
  int columns = 1;
  int width_px = 1040;
  int height_px = 360;
};

// Draws the picture with gnuplot and returns a complete <svg> element without XML declaration, to
// be put into a page or a file. Every id in it begins with `id` (letters, digits, '-'), so that
// several figures can share a page. Series with more points than pixels are reduced first: a line
// to the extremes within each pixel column, dots to one per cell of the picture. The same plot
// gives the same bytes. Throws std::invalid_argument if the id has other characters, the columns of
// a series differ in length, a panel has no value that its axes can show, or the panels do not fit
// into the picture; std::runtime_error if gnuplot is not installed or fails, with its message.
std::string svg_from_plot(const Plot& plot, const std::string& id);

// True if some series of the panel has a point that its axes can show.
bool has_something_to_draw(const PlotPanel& panel);

// True if the logarithmic axes of the picture show 10³ rather than 1000: all of them, if one goes beyond 0.001 or 20 000.
bool has_powers_of_ten(const Plot& plot);

// `value`, a number of a legend in the unit of the axes, written as on the logarithmic axes of its picture: "0.001", or "10⁻³" and "2×10⁻³".
std::string number_on_axes(const Plot& plot, double value);

}  // namespace viscard
