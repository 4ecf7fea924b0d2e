#pragma once

#include "fit/samples/fit_data.h"
#include "models/experiment/captured_run.h"

#include <functional>

namespace viscard {

// Volts to newtons, device clock to one time base, stage moves and windows: what fit_indentation()
// needs, from one captured run. Readings that are saturated or glitches are left out and counted.
// Time base: the run's host clock, to which the amplifier's own clock is tied by the line that
// touches the receive times from below (a message can be late, never early); without such a clock
// the readings are taken as evenly spaced. Throws std::runtime_error, saying what is missing, if
// there is no ramp move, no calibration or no reading in contact.
IndentationData indentation_from_capture(const CapturedRun& run);

// Line under a cloud of points, for clocks related by messages whose delay is never negative: the
// slope from the least delayed message of the first and of the last third, the offset so that no
// point lies below. x ascending.
struct ClockLine {
  double offset_s = 0.0;
  double slope = 1.0;
  double at(double x) const { return offset_s + slope * x; }
};
ClockLine line_from_below(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace viscard
