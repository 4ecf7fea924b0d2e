#pragma once

#include "fit/samples/fit_data.h"
#include "models/experiment/captured_run.h"

#include <optional>
#include <vector>

namespace viscard {

// Input of fit_indentation() from one captured run: forces from volts, all times on one time base,
// stage moves and windows. Saturated readings and glitches are left out and counted. The time base
// is the run's host clock. The amplifier's clock is related to it by the line that touches the
// receive times from below (a message can be late, never early); without that clock the readings
// are taken as evenly spaced. Throws std::runtime_error that names what is missing, if there is no
// ramp move, no calibration or no reading in contact.
IndentationData indentation_from_capture(const CapturedRun& run);

// Time of every load sample on that time base, also of those that the fit leaves out. After a restart
// of the amplifier's clock, and without two usable readings, it is the receive time.
std::vector<double> sample_times_s(const CapturedRun& run);

// Force of a sample that is neither saturated nor a glitch, before any tare.
std::optional<double> usable_force_N(const LoadSample& sample, const RigConfig& rig);

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
