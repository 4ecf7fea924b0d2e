#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/search/separable.h"
#include "models/material/fit_defects.h"

#include <string>

namespace viscard {

// What the test could show at all, for judging each term.
struct TestWindow {
  double sampling_s = 0.0;          // shortest interval between samples; 0: unknown
  double ramp_s = 0.0;              // duration of loading; 0: a step
  double from_s = 0.0, to_s = 0.0;  // since loading began
};

// Adds the identifiability flags of FitResult (fit/README.md, sect. 6): tau-below-sampling,
// tau-below-ramp, tau-beyond-window, modulus-may-be-zero, terms-correlated, on-bound,
// confused-with-drift, not-converged. Only the last makes a result untrustworthy.
void add_identifiability_flags(const SpectralModel& model, const SpectralState& state,
                               const Eigen::MatrixXd& covariance, const TestWindow& window,
                               FitResult& result);

// What holds of every kind of fit: E0 whose interval reaches zero is no result (E0-unknown), and
// notes that are defects count.
void judge(FitResult& result);

// Says how many samples were left out as spikes, if any.
void add_spikes(FitResult& result, std::size_t count);

// One of the flags that make the whole result untrustworthy (models/fit_defects.h).
inline constexpr const char* kContradictsData = "contradicts-data";

// A flag of that kind.
void add_defect(FitResult& result, const std::string& name, const std::string& text);

// The model does not describe the record: what it leaves is many times the noise seen out of
// contact, and no longer small beside the force (misfit, a defect). sigma: of what is left, of one
// sample; quiet_sigma: out of contact, from n_quiet samples; peak: largest force. In one unit.
void flag_misfit(double sigma, double quiet_sigma, std::size_t n_quiet, double peak,
                 FitResult& result);

}  // namespace viscard
