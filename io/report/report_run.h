#pragma once

#include "io/plots/plot.h"
#include "models/experiment/captured_run.h"

#include <optional>
#include <vector>

namespace viscard {

// A run as the page shows it: the readings as received and the positions of the stage, both over
// the host's clock in s since the run began.
struct RunSeries {
  std::vector<double> time_s, volts;  // valid readings; in N if the instrument is a force gauge
  std::vector<double> flagged_s, flagged_V;  // saturated readings and glitches
  std::vector<double> report_s, position_m;  // reported by the stage
  // Depth of the punch below the point of contact, negative above the surface:
  //   stage position - contact position - force/frame stiffness,
  // at the times of the readings; empty without a contact position. The zero of the force is the
  // mean reading while the punch was clear of the specimen.
  std::vector<double> depth_m;
  std::vector<PlotNote> phases;
  bool is_force = false;  // the instrument is a force gauge
};

// motion_start_s: the fitted starts of the moves (FitCurves). The recorded starts are uncertain by
// the latency of the controller, so the nearest move is shifted to each fitted start.
RunSeries series_from_run(const CapturedRun& run, std::optional<double> contact_position_m,
                          const std::vector<double>& motion_start_s = {});

// Returns a reading in the unit of the calibration (models/experiment), or NaN if there is none.
double volts_of(const LoadSample& sample, const RigConfig& rig);

}  // namespace viscard
