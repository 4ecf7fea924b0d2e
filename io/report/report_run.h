#pragma once

#include "io/plots/plot.h"
#include "models/experiment/captured_run.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What a run recorded, as a page shows it: readings as received and the way of the stage, both on
// the host's clock, s since the run began.
struct RunSeries {
  std::vector<double> time_s, volts;         // readings that count; newtons of a force gauge
  std::vector<double> flagged_s, flagged_V;  // saturated or glitches
  std::vector<double> report_s, position_m;  // the stage's own reports
  // Depth of the punch below the point of contact, negative above the surface:
  //   stage position - contact position - force/frame stiffness,
  // at the times of the readings; empty without a contact position. The force counts from the mean
  // reading taken while the stage stood clear of the contact position.
  std::vector<double> depth_m;
  std::vector<PlotNote> phases;
  bool is_force = false;  // the instrument gives a force by itself
};

// motion_start_s: when moves truly began, as a fit found it (FitCurves); the record knows it only
// within the latency of the controller, and the move that began nearest is put there.
RunSeries series_from_run(const CapturedRun& run, std::optional<double> contact_position_m,
                          const std::vector<double>& motion_start_s = {});

// One reading in the unit of the calibration (models/sample_force.h); NaN if there is none.
double volts_of(const LoadSample& sample, const RigConfig& rig);

}  // namespace viscard
