#pragma once

#include "io/plots/plot.h"
#include "io/report/report.h"
#include "io/report/report_estimates.h"
#include "models/experiment/captured_run.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Colour and legend entry of each specimen. Repeated specimens of a mixing ratio have one colour
// and one entry, "10 : 1 (3 specimens)".
struct SpecimenStyle {
  Ink ink = Ink::kBlue;
  int pattern = 0;    // of lines and dots, so that they differ without colour too
  std::string label;  // empty if another specimen of this ratio has the entry
};
std::vector<SpecimenStyle> styles_of(const std::vector<SpecimenEstimates>& estimates);

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

// The figures of the page. Each function returns nothing if its data are missing.

// E(t) of all specimens, absolute and relative to E0, with 95 % bands and the truth if it is known.
std::optional<Plot> relaxation_plot(const ReportInput& input,
                                    const std::vector<SpecimenEstimates>& estimates);

// E0 over mixing ratio with the interval of the fit and the wider one that includes the systematic
// part, and the law of a joint fit. Needs two different ratios.
std::optional<Plot> ratio_plot(const ReportInput& input,
                               const std::vector<SpecimenEstimates>& estimates);

// g_i over tau_i, each with its interval.
std::optional<Plot> spectrum_plot(const ReportInput& input,
                                  const std::vector<SpecimenEstimates>& estimates);

// Relaxation and creep of the pillar over their first value, by solver and exact, and their error.
std::optional<Plot> pillar_plot(const ReportInput& input,
                                const std::vector<SpecimenEstimates>& estimates);

// Output of the load cell and depth (or stage position) of one run over time.
std::optional<Plot> run_plot(const RunSeries& series);

// Data with fit against log time since each motion, and residuals over their standard deviation
// against log time and in time order.
// is_master: times and frequencies are reduced by the shift factors.
std::optional<Plot> fit_plot(const FitResult& fit, bool is_master = false);

// Storage and loss modulus, loss factor and residuals over frequency. Nothing without both moduli.
std::optional<Plot> oscillation_plot(const FitResult& fit, bool is_master);

// Shift factors over temperature: taken with their band, free, and the law.
std::optional<Plot> shift_plot(const ShiftReport& shift);

// Adds the band that should contain 95 % of the residuals, and makes the axis symmetric about zero.
void show_two_sigma(PlotPanel& panel);

// Profile likelihoods: rise of the sum of squares over E_inf and over each relaxation time, one
// panel each. Nothing if the fit has none.
std::optional<Plot> profile_plot(const FitResult& fit);

// The continuous spectrum with its band, and where the times of the series lie. Nothing if the fit has none.
std::optional<PlotPanel> spectrum_panel(const FitResult& fit);

}  // namespace viscard
