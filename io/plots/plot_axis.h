#pragma once

#include "io/plots/plot.h"

#include <string>
#include <vector>

namespace viscard {

// Where an axis begins and ends, min < max; both positive on a logarithmic one.
struct AxisRange {
  double min = 0.0;
  double max = 1.0;
  bool is_log = false;
};

// From what the axis demands, and from the values for the rest, with a margin of 4 % of the length.
// Values that the axis cannot show are passed over; with none left the range is [0, 1] or [1, 10].
AxisRange axis_range(const PlotAxis& axis, const std::vector<double>& values);

// 0 at min, 1 at max; not finite where the axis cannot show the value.
double axis_fraction(const AxisRange& range, double value);

struct Tick {
  double value = 0.0;
  std::string label;  // UTF-8; empty for a tick between labelled ones
};

// Round values: steps of 1, 2 or 5 times a power of ten, or decades with their parts in between,
// at most one label per `px_per_label` pixels of a `length_px` long axis.
std::vector<Tick> axis_ticks(const AxisRange& range, int length_px, int px_per_label);

// "0.002", "1500", "3×10⁻⁷"; with a true minus sign. digits: significant ones at most.
std::string readable_number(double value, int digits);

}  // namespace viscard
