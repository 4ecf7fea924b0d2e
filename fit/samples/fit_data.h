#pragma once

#include "models/contact/punch_contact.h"
#include "models/experiment/run_record.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What is fitted, by kind of test. Columns of equal length, SI, in any order of time; rows whose
// values are not finite are left out and counted. sigma may be empty (equal, unknown noise).

// Relaxation modulus (or stress) after a step at t = 0: value(t) = E_inf + sum E_i exp(-t/tau_i).
// With `strain` the value is a stress and follows the measured strain history instead.
struct RelaxationData {
  std::vector<double> time_s;
  std::vector<double> value;   // Pa, or any unit: the moduli come out in it
  std::vector<double> strain;  // empty: ideal step
};

// Flat-punch indentation, F(t) = c int E(t-s) d(depth)/ds ds + offset + drift t   (fit/README.md,
// eq. 2) with c = force_per_modulus_and_depth_m(contact). Without a contact c = 1: stiffnesses in
// N/m. Depth is either measured (depth_m) or follows from stage moves and the frame's compliance.
struct IndentationData {
  std::vector<double> time_s;
  std::vector<double> force_N;  // positive when pressed; its zero is fitted
  std::vector<double> depth_m;  // into the specimen; negative values: not in contact yet

  // From a capture: moves on the time base of time_s, except that the start of each is only known
  // to lie in [start_time_s - early_s, start_time_s + late_s]. ramp first, then those while in
  // contact.
  std::vector<StageMove> moves;
  double start_early_s = 0.0;
  double start_late_s = 0.0;
  double first_reading_s = 0.0;  // of the whole run, when the gain was last that of the calibration
  double contact_from_s = 0.0;   // samples from here ...
  double contact_to_s = 0.0;     // ... to here belong to ramp and holds; others are out of contact
  double frame_stiffness_N_m = 0.0;  // 0: rigid
  double frame_stiffness_relative_u = 0.0;
  double force_relative_u = 0.0;  // of the calibration

  std::optional<PunchContact> contact;
  std::size_t n_saturated = 0;  // left out already
  std::size_t n_glitch = 0;
};

// Creep compliance J(t) in 1/Pa after a stress step at t = 0.
struct CreepData {
  std::vector<double> time_s;
  std::vector<double> compliance_1_Pa;
};

// Storage and loss modulus; fitted together, each with relative weights.
struct DmaData {
  std::vector<double> frequency_Hz;
  std::vector<double> storage_Pa;
  std::vector<double> loss_Pa;
};

// A parameter held fixed (low == high) or within bounds; names and rules: fit/constraints.h.
struct ParameterConstraint {
  std::string name;
  double low = 0.0, high = 0.0;
};

struct FitOptions {
  std::optional<int> n_terms;  // this order instead of a choice
  // Need n_terms; for relaxation, storage and loss, and tables of indentation.
  std::vector<ParameterConstraint> constraints;
  int max_terms = 40;
  bool is_liquid = false;       // E_inf = 0
  bool allow_negative = false;  // moduli of single terms
  bool white_noise = false;     // no inflation for autocorrelation; sigma^2 = rss/(n - p)
  bool full_data = false;       // every sample for itself instead of averages in log time
  bool with_drift = true;   // indentation: force drift linear in time, where the data can tell it
  bool with_curves = true;  // fill FitResult::curves
  // Profile likelihoods: their intervals replace those of E_inf and the times.
  bool with_profiles = false;
  int n_bootstrap = 0;  // resamples for all intervals (0: from the covariance)
};

}  // namespace viscard
