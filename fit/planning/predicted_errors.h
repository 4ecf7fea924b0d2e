#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/planning/planned_run.h"
#include "models/material/material.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace viscard {

// A quantity that a test is to determine, and how well.
struct WantedQuantity {
  std::string name;        // "E0", "E_inf", "sum_g", "E_i", "g_i" or "tau_i" of term i
  double tolerance = 0.0;  // relative half-width of its 95 % interval
  // Of any other quantity: its value, which must be positive, from the series. It may be called from
  // several threads.
  std::function<double(const PronySeries&)> value = {};
};

// Throws std::invalid_argument that lists the names, or that the series has no such term.
double value_of(const WantedQuantity& wanted, const PronySeries& series);

// Relative standard errors of a quantity by their causes. Noise also stands for what is fitted beside
// the moduli: starts of moves, contact, speed of the stage, zero and creep of the cell. Only its part
// and that of the touches fall with the number of touches.
struct ErrorCauses {
  double noise = 0.0;
  double gain_drift = 0.0;   // of the load cell's gain since its calibration was checked
  double frame = 0.0;        // stiffness of the frame
  double calibration = 0.0;  // of the load cell
  double geometry = 0.0;     // punch, layer, Poisson ratio

  double total() const;
  double half_width_95() const { return kNormal95 * total(); }
  double without_systematic_95() const { return kNormal95 * std::hypot(noise, gain_drift); }
  ErrorCauses of_touches(int n) const;  // of the mean of n runs on one specimen
};

// The expected result of one run of a test on a specimen of the guessed material: the result that
// its fit would have, with the errors from the Fisher information of the fit's own model
// (StageModel, with its nuisances and their priors) at the guess. The order is assumed to be known.
struct PredictedFit {
  FitResult result;      // parameters, covariance, systematic_relative, gain_drift_relative
  double total_s = 0.0;  // at the rig
  double peak_force_N = 0.0;
  PronySeries series;                            // of the guess, Pa
  Eigen::MatrixXd covariance;                    // of (E_inf, E_i, ln tau_i) from the noise alone
  std::vector<SystematicPart> systematic_parts;  // of the series
  SystematicPart gain_drift;  // change of the series by the possible gain drift before contact
};

// Throws what planned_run() throws, and std::invalid_argument if the rig's noise is not known or the
// guess has no modulus.
PredictedFit predicted_fit(const TestPlan& plan, const Bench& bench, const Material& guess);

// Changes of a series (Pa) by the systematic uncertainties of the bench on which it was fitted; those of the
// load cell at the largest force of the test.
std::vector<SystematicPart> systematic_parts_on(const Bench& bench, double largest_force_N,
                                                const PronySeries& series);

ErrorCauses errors_of(const WantedQuantity& wanted, const PredictedFit& fit);

}  // namespace viscard
