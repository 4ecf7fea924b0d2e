#pragma once

#include "models/contact/punch_contact.h"
#include "models/experiment/run_record.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The clock line is early by the smallest delay of a message and may be tilted by the spread of
// delays. Both are unknown but short: readings this close to a motion out of contact are left out.
constexpr double kStartEarly_s = 0.02;
// Recovery of the surface and the end of the motion leave some force for this long after contact.
constexpr double kFreeAgain_s = 0.5;

// Input of a fit, one struct per kind of test. Columns have equal length, SI units and any order of
// time. Rows with values that are not finite are left out and counted.

// Relaxation modulus (or stress) after a step at t = 0: value(t) = E_inf + sum E_i exp(-t/tau_i).
// With `strain` the value is a stress and follows the measured strain history instead.
struct RelaxationData {
  std::vector<double> time_s;
  std::vector<double> value;   // Pa, or any other unit; the moduli have the same unit
  std::vector<double> strain;  // empty: ideal step
  std::string unit = "Pa";     // of value, for the words of flags
  bool is_zero_known = false;  // the load was at t = 0 for certain: the times are not questioned
  double zero_unsure_s = 0.0;  // t = 0 was assumed, and may be wrong by this
  std::size_t n_missing = 0;   // rows of the table between these that are left out already
};

// Rows of a table of force and depth.
struct ForceDepthRows {
  std::vector<double> time_s, force_N, depth_m;
};

// Flat-punch indentation, F(t) = c int E(t-s) d(depth)/ds ds + offset + drift t (fit/README.md, eq.
// 2) with c = force_per_modulus_and_depth_m(contact). Without a contact c = 1 and the results are
// stiffnesses in N/m. Depth is measured (depth_m) or follows from moves and frame compliance.
struct IndentationData {
  std::vector<double> time_s;
  std::vector<double> force_N;  // positive in compression; its zero is fitted
  std::vector<double> depth_m;  // into the specimen; negative before contact
  bool is_zero_known = false;   // as in RelaxationData; of a table that begins under load

  // From a capture: moves on the time base of time_s. Each starts within [start_time_s -
  // start_early_s, start_time_s + start_late_s]. The ramp comes first, then the moves in contact.
  std::vector<StageMove> moves;
  double start_early_s = 0.0;
  double start_late_s = 0.0;
  double first_reading_s = 0.0;      // of the whole run; the gain is still the calibrated one
  double contact_from_s = 0.0;       // samples from here ...
  double contact_to_s = 0.0;         // ... to here belong to ramp and holds; others: no contact
  double frame_stiffness_N_m = 0.0;  // 0: rigid
  double frame_stiffness_relative_u = 0.0;
  double depth_relative_u = 0.0;  // of the travel that the stage counts
  double force_relative_u = 0.0;  // of the calibration at the largest force, relative and standard
  double largest_force_N = 0.0;   // of a capture, above that out of contact
  std::string force_doubt;        // why the calibration is a doubt for that force, or ""

  std::optional<PunchContact> contact;
  std::size_t n_missing = 0;    // as in RelaxationData
  std::size_t n_saturated = 0;  // already left out
  std::size_t n_glitch = 0;

  // What the specimen remembers although it is not fitted: an earlier touch.
  std::vector<StageMove> approach;  // of a capture: all moves before the ramp
  std::string approach_doubt;       // why these may not be all of them, or ""
  ForceDepthRows before;            // of a table: the rows before these
};

// Creep compliance J(t) in 1/Pa after a stress step at t = 0. With `stress_Pa` the strain follows the measured
// stress instead: creep with recovery, pulses, any sequence of stresses.
struct CreepData {
  std::vector<double> time_s;
  std::vector<double> compliance_1_Pa;  // or the strain
  bool is_zero_known = false;           // as in RelaxationData
  double zero_unsure_s = 0.0;
  std::vector<double> stress_Pa = {};  // empty: ideal step
  std::size_t n_missing = 0;           // as in RelaxationData
};

// Storage and loss modulus, fitted together with relative weights; loss_Pa empty: the storage modulus alone.
struct DmaData {
  std::vector<double> frequency_Hz;
  std::vector<double> storage_Pa;
  std::vector<double> loss_Pa;
};

// First value of the shift of one isotherm of a master curve.
struct StartShift {
  double temperature_C = 0.0;
  double log10_a = 0.0;  // log10 a_T; 0 at the reference temperature
};

// Rows at several temperatures: relaxation modulus over time, or storage and loss moduli over
// frequency. Rows whose temperatures lie within 1 K of each other form one segment.
struct MasterData {
  std::vector<double> temperature_C;
  std::vector<double> argument;    // s, or Hz if loss_Pa is given
  std::vector<double> modulus_Pa;  // relaxation or storage modulus
  std::vector<double> loss_Pa;
  std::optional<double> T_ref_C;  // temperature of a segment; none: the middle one
  // Of some isotherms or all, from which the fit starts; empty: the rows alone give the start.
  std::vector<StartShift> start_shifts;
};

// A parameter held fixed (low == high) or kept within bounds. Names and rules:
// fit/assembly/constraints.h.
struct ParameterConstraint {
  std::string name;
  // Bounds, in the unit of the parameter.
  double low = 0.0, high = 0.0;
};

// A drift of the instrument in a table, linear in time.
enum class TableDrift {
  kIfCalledFor,  // tried if the residuals of a fit without it have structure
  kFitted,
  kNone
};

// Factors on the moduli of the isotherms of a master curve.
enum class VerticalShift { kAuto, kOff, kOn };

// What a user can choose about a fit; the defaults leave every choice to the data.
struct FitOptions {
  std::optional<int> n_terms;  // this order instead of a chosen one
  // They need n_terms. Available for relaxation, storage and loss, and tables of indentation.
  std::vector<ParameterConstraint> constraints;
  int max_terms = 40;
  bool is_liquid = false;       // E_inf = 0
  bool is_solid = false;        // do not try whether a liquid describes the data better
  bool allow_negative = false;  // of single terms: moduli may be negative
  bool white_noise = false;     // no inflation for autocorrelation; sigma^2 = rss/(n - p)
  bool full_data = false;       // fit every sample instead of averages in log time
  bool with_drift = true;       // captures: fit a linear force drift, if the data allow
  TableDrift drift = TableDrift::kIfCalledFor;  // tables of relaxation and indentation
  bool with_curves = true;                      // fill FitResult::curves
  // Profile likelihoods replace the intervals of E_inf and of the times.
  bool with_profiles = false;
  bool with_spectrum = false;                           // fill FitResult::spectrum
  bool keep_rows = false;                               // fill FitResult::kept
  bool with_laws = false;                               // fill FitResult::laws
  VerticalShift vertical_shift = VerticalShift::kAuto;  // kAuto: if BIC prefers them clearly
  int n_bootstrap = 0;  // resamples for all intervals (0: intervals from the covariance)
  // Called on the thread of the fit with the share of the resamples that are done. May be empty.
  std::function<void(double fraction)> resampled;
};

}  // namespace viscard
