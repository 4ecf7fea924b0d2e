#pragma once

#include "fit/samples/fit_data.h"
#include "models/experiment/captured_run.h"

namespace viscard {

// Input of fit_indentation() from one captured run: forces from volts, all times on one time base,
// stage moves and windows. Saturated readings and glitches are left out and counted. The time base
// is the run's host clock. The amplifier's clock is related to it by the line that touches the
// receive times from below (a message can be late, never early); without that clock the readings
// are taken as evenly spaced. Throws std::runtime_error that names what is missing, if there is no
// ramp move, no calibration or no reading in contact.
IndentationData indentation_from_capture(const CapturedRun& run);

// Lower support line of points, for clocks related by messages whose delay is never negative: the
// slope comes from the least delayed messages of the first and of the last third, and the offset is
// the largest with no point below the line. x ascending.
struct ClockLine {
  double offset_s = 0.0;
  double slope = 1.0;
  double at(double x) const { return offset_s + slope * x; }
};
ClockLine line_from_below(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace viscard
