#pragma once

#include "fit/intervals/fitted_law.h"
#include "fit/search/order_row.h"
#include "models/material/material.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// kSeveral: several tests of one material together.
enum class FitKind { kIndentation, kRelaxation, kCreep, kDma, kSeveral };

// One term of the fitted series; ascending tau. Without punch geometry "modulus" is a stiffness in
// N/m (FitResult::is_stiffness).
struct FittedTerm : TermUncertainty {
  FittedTerm() = default;
  // Modulus, share (g) and time (s), because {modulus, g, tau} would otherwise set the first members of
  // the uncertainty.
  FittedTerm(double modulus, double share, double time)
      : modulus_Pa(modulus), g(share), tau_s(time) {}
  double modulus_Pa = 0.0;
  double g = 0.0;
  double tau_s = 0.0;
};

// Noise of one sample about the fit.
struct NoiseEstimate {
  double sigma = 0.0;      // standard deviation of one sample, in the unit of the fitted column
  double inflation = 1.0;  // variance factor for autocorrelation and misfit
};

// A smooth curve that the model leaves in the residual (fit/intervals/lack_of_fit.h).
struct LackOfFit {
  double structure = 0.0;  // root mean square of the curve, in the unit of the fitted column
  double noise = 0.0;      // standard deviation of one sample about the curve
  double relative = 0.0;   // structure over the data
  // largest local value; 0: nowhere above chance
  double worst = 0.0, worst_relative = 0.0;
  double worst_from_s = 0.0, worst_to_s = 0.0;
  double rise = 0.0;  // of the smooth curve through the data, over its largest value
  bool is_significant = false;
  bool is_far_above_noise = false;  // and above 0.5 % of the data
};

// A drift of the instrument that was fitted to a table: value = ... + per_s t.
struct FittedDrift {
  double per_s = 0.0, se_per_s = 0.0;  // unit of the fitted column per second
};

// The fitted modulus at the first sample, the earliest that was measured. E0 is extrapolated from it.
struct FirstModulus {
  double time_s = 0.0;
  double modulus_Pa = 0.0, se_Pa = 0.0;
  Interval interval_95;
};

// The fitted storage modulus at the highest frequency of an oscillation. E0 is extrapolated from it.
struct HighestStorage {
  double frequency_Hz = 0.0;  // of a master curve: reduced
  double modulus_Pa = 0.0, se_Pa = 0.0;
  Interval interval_95;
};

// Modulus from two points of the loading curve, P = E d h/(1 - nu^2). It ignores relaxation during
// the ramp, and the layer's thickness unless the contact includes it. A cross-check with a known
// bias, reported beside the fit.
struct TwoPointModulus {
  double modulus_Pa = 0.0;
  double se_Pa = 0.0;
  double half_space_modulus_Pa = 0.0;  // without layer correction: "apparent"
  std::string bias;                    // one sentence
};

// What a comparison with another model of the same data needs.
struct FitEvidence {
  double rss = 0.0;        // weighted
  double n_samples = 0.0;  // rows of the fit; storage and loss count as two
  double inflation = 1.0;  // variance factor, as in NoiseEstimate
  int n_parameters = 0;
};

// Data and fit for plots, at the same (possibly averaged) times.
struct FitCurves {
  std::vector<double> time_s;    // frequency_Hz for kDma
  std::vector<double> measured;  // unit of the fitted column
  std::vector<double> fitted;    // the fit at the same times, same unit
  std::vector<double> sigma;     // standard deviation of each binned value
  // The loss modulus of each row beside the storage modulus; empty for other kinds.
  std::vector<double> loss_measured, loss_fitted, loss_sigma;
  std::string unit;  // "N", "Pa", "1/Pa"
  // Times at which a new motion begins (contact, unloading ...); a logarithmic time axis restarts
  // there. Empty: at 0 only. All time_s lie after the first of them.
  std::vector<double> motion_start_s;

  // A value at a time (or frequency), of_fit that of the fit there, deviation its standard deviation, all
  // in the unit of the column.
  void add(double at, double value, double of_fit, double deviation) {
    time_s.push_back(at);
    measured.push_back(value);
    fitted.push_back(of_fit);
    sigma.push_back(deviation);
  }
  // The loss modulus beside the storage modulus that add() took last: value, of_fit and deviation as
  // there.
  void add_loss(double value, double of_fit, double deviation) {
    loss_measured.push_back(value);
    loss_fitted.push_back(of_fit);
    loss_sigma.push_back(deviation);
  }
};

// Rows of the input that are not fitted, for one reason (fit/intervals/left_out.h).
struct LeftOutRows {
  std::string reason;
  std::size_t count = 0;
};

// How much worse the fit becomes if one parameter is held at a value and all others are fitted
// again: rise of the sum of squares over the variance of the noise (3.84 ends the interval).
struct ProfileCurve {
  std::string parameter;      // "E_inf", "ln_tau_1" ...
  std::vector<double> value;  // ascending; Pa, or ln s
  std::vector<double> rise;   // at each value; a pure number
  Interval interval_95;
};

// The relaxation spectrum H(tau) = dE/d ln tau without a number of terms (fit/assembly/continuous_spectrum.h).
struct SpectrumRow {
  double tau_s = 0.0;
  double H_Pa = 0.0;  // mean over half a decade around tau
  Interval H_95;
};
// What the data say of it.
struct ContinuousSpectrum {
  double from_s = 0.0, to_s = 0.0;  // the times that it covers
  std::vector<SpectrumRow> rows;    // ascending tau
  Interval E0_95, E_inf_95;         // what all spectra over these times allow
};

// One of several tests that were fitted together.
struct FittedTest {
  std::string name;  // "relaxation", or "relaxation 2" if there are several
  FitKind kind = FitKind::kRelaxation;
  bool is_stiffness = false;
  std::size_t n_samples = 0;
  std::string fitted_unit;  // of its column, if the reader of the file knows it
  NoiseEstimate noise;      // in the unit of its fitted column (kDma: relative)
  double rss = 0.0;         // over all samples, in that unit
  double from_s = 0.0, to_s = 0.0;
  // Its values over those of the material: free for a stiffness, uncertain where the geometry is.
  bool has_scale = false;
  double scale = 1.0;  // a pure number
  Interval scale_95;
  // Its own fit, without the other tests.
  int own_terms = 0;
  double own_E0_Pa = 0.0, own_E_inf_Pa = 0.0;
  Interval own_E0_95, own_E_inf_95;
  double own_rss = 0.0;  // as rss (kDma: relative)
  // How far it lies from the prediction of the other tests (fit/assembly/test_agreement.h): a
  // factor on all its values, the largest departure in its window, and the probability of so large
  // a departure by chance.
  double difference = 0.0, worst = 0.0;
  Interval difference_95;
  double p_value = 1.0;    // that probability
  int freedom = 0;         // degrees of freedom of the comparison; 0: the other tests allow none
  bool disagrees = false;  // by more than chance and 0.5 %
  FitCurves curves;
};

struct KeptRows;

// The result of a fit. Moduli are in Pa, or stiffnesses in N/m if is_stiffness.
struct FitResult {
  FitKind kind = FitKind::kIndentation;
  bool is_stiffness = false;
  double E0_Pa = 0.0, E_inf_Pa = 0.0;
  double E0_se_Pa = 0.0, E_inf_se_Pa = 0.0;
  Interval E0_interval_95, E_inf_interval_95;
  double sum_g = 0.0;  // 1 - E_inf/E0, the share of the modulus that relaxes
  Interval sum_g_95;
  std::vector<FittedTerm> terms;
  double rss = 0.0;
  std::size_t n_samples = 0;
  FitEvidence evidence;
  bool may_flow = false;  // the data do not exclude E_inf = 0, so a liquid should be tried too
  // If both were tried: negative if the liquid was chosen.
  std::optional<double> bic_liquid_minus_solid;
  std::size_t n_averages = 0;  // rows of the fit: averages in log time, or single samples
  std::vector<OrderRow> orders;
  std::vector<MaterialFlag> flags;
  NoiseEstimate noise;
  std::vector<std::string> covariance_parameters;  // e.g. "E_inf_Pa", "E_1_Pa", ..., "ln_tau_1"
  Eigen::MatrixXd covariance;
  double systematic_relative = 0.0;  // of E0, by geometry, calibration and frame together
  std::vector<SystematicPart> systematic_parts;  // its causes
  // Relative standard uncertainty, common to all moduli, of the load cell's gain: its possible
  // drift before contact according to the record itself. The errors and intervals above include it.
  double gain_drift_relative = 0.0;
  double fit_from_s = 0.0, fit_to_s = 0.0;
  // Duration of the fastest loading; the modulus before that time is extrapolated.
  double fastest_s = 0.0;
  std::optional<FirstModulus> first;      // nothing: not a record in time, or a captured run
  std::optional<HighestStorage> highest;  // nothing: not an oscillation
  std::optional<TwoPointModulus> two_point;
  std::optional<double> contact_position_m;
  // True speed of the stage over the commanded one, for captures. The errors above include its own.
  std::optional<double> stage_speed;
  double stage_speed_se = 0.0;  // standard error, a pure number too
  // Viscosity of a dashpot in parallel to the series, for kDma: relaxation far faster than the
  // measured frequencies. E0 and the terms do not contain it.
  std::optional<double> dashpot_Pa_s;
  double dashpot_se_Pa_s = 0.0;
  std::size_t n_spikes = 0;    // samples left out as spikes
  std::size_t n_left_out = 0;  // rows that are not fitted, for all reasons together
  std::vector<LeftOutRows> left_out;
  std::size_t n_contacts = 0;  // times that contact was made, in a table of force and depth
  std::optional<LackOfFit> lack_of_fit;  // nothing: not tested for lack of fit
  std::optional<FittedDrift> drift;      // of a table, if it was fitted
  bool is_converged = true;              // of the chosen order
  // False: not converged, saturated, gap in the ramp ... (the flags name the cause).
  bool is_trustworthy = true;
  std::vector<ProfileCurve> profiles;  // if FitOptions::with_profiles
  // If FitOptions::with_spectrum, where the series is one of relaxation with times of its own.
  std::optional<ContinuousSpectrum> spectrum;
  int n_bootstrap = 0;  // resamples for the intervals; 0: from the covariance
  FitCurves curves;
  std::vector<FittedTest> tests;         // of kSeveral
  std::shared_ptr<const KeptRows> kept;  // if FitOptions::keep_rows
  std::vector<FittedLaw> laws;  // if FitOptions::with_laws, for kinds of test that have them
};

// Adds a relative standard uncertainty to both sides of a value's interval, in quadrature.
Interval combined_95(const Interval& interval, double value, double relative_u);

// 95 % intervals that include the systematic parts, in quadrature.
struct ModulusIntervals {
  Interval E0_Pa, E_inf_Pa;
};
ModulusIntervals combined_intervals(const FitResult& fit);
// The same for one term, from 0; the standard errors are those of the fit.
TermUncertainty combined_intervals(const FitResult& fit, std::size_t term);

// The fitted terms and E_inf as a series.
PronySeries fitted_series(const FitResult& fit);

// The material that a fit describes, without provenance. Throws std::invalid_argument if the fit is
// of stiffnesses (no geometry was given).
Material material_from_fit(const FitResult& fit, double nu, double rho_kg_m3);

}  // namespace viscard
