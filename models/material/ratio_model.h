#pragma once

#include "models/material/material.h"
#include "models/material/scatter.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

// How a material changes with its mixing ratio r (parts of base to one of curing agent). A
// specimen s is described by theta = (ln E0, ln g_1 .. ln g_N, ln tau_1 .. ln tau_N) and
//   theta_s = X(r_s) beta + u_s,   u_s ~ N(0, spread^2)                      (eq. 28)
// with each row of X a polynomial in a variable of the ratio, or one value for each measured ratio.
enum class RatioVariable {
  kLogRatio,          // ln r: E0 is a power of the ratio
  kRatio,             // r
  kCrosslinkerShare,  // 1/(1 + r)
};

constexpr int kPerRatio = -1;  // a value of its own at each measured ratio

// How the parameters depend on the mixing ratio.
struct RatioForm {
  RatioVariable variable = RatioVariable::kLogRatio;
  int E0_degree = 1;              // of ln E0 in the variable, or kPerRatio
  int g_degree = 0;               // of every ln g_i
  int tau_degree = 0;             // of every ln tau_i
  std::vector<std::string> same;  // "g_1", "tau_2": one value each, regardless of the degrees above
};
bool operator==(const RatioForm& a, const RatioForm& b);

// The variable at a ratio: ln r, r or 1/(1 + r).
double variable_of(RatioVariable variable, double ratio);

// True if the form also holds for ratios that were not measured.
bool is_law(const RatioForm& form);
// "independent", "shared-times", "shared-spectrum", "law", or "mixed" for any other form.
std::string form_name(const RatioForm& form);
// "ln E0 linear in ln(ratio), spectrum and times the same at all ratios".
std::string form_in_words(const RatioForm& form);

// One form fitted to all specimens (fit/fit_mixing_ratio.h).
struct RatioModel {
  RatioForm form;
  int n_terms = 0;               // the largest number, if there are own_terms
  std::vector<int> own_terms;    // at each ratio; empty: n_terms at all ratios
  std::vector<double> ratios;    // measured, ascending, each once
  Eigen::VectorXd coefficients;  // beta: the columns of theta's first row, then of the next ...
  Eigen::MatrixXd covariance;    // of beta
  // Between-specimen standard deviations of ln E0, of each ln g_i and of each ln tau_i.
  double spread_ln_E0 = 0.0, spread_ln_g = 0.0, spread_ln_tau = 0.0;
  // The same between touches on one specimen; 0 without repeats.
  double touch_ln_E0 = 0.0, touch_ln_g = 0.0, touch_ln_tau = 0.0;
  int n_specimens = 0;
  double log_likelihood = 0.0;  // maximum likelihood
  double bic = 0.0;
  int n_parameters = 0;  // beta and three spreads
};

// Polynomials of (variable - middle)/half, -1 to 1 over the measured range, are well conditioned.
struct ScaledVariable {
  double middle = 0.0;  // in the unit of the variable
  double half = 1.0;    // likewise
};
ScaledVariable scale_of(const RatioModel& model);

// Number of entries of beta that belong to row `parameter` of theta.
int n_columns(const RatioModel& model, int parameter);
// True if there are more specimens than coefficients of this parameter; otherwise the scatter
// between specimens is unknown.
bool has_known_spread(const RatioModel& model, int parameter);
// X(ratio), 1 + 2N rows with the number N of terms at the ratio. With own_terms, a ratio that was
// not measured has only the row of ln E0. Throws std::invalid_argument if the form holds for
// measured ratios only and this ratio was not measured.
Eigen::MatrixXd design_at(const RatioModel& model, double ratio);

// E0 over a range of ratios, for plots: mean and 95 % band of a new specimen.
struct RatioBand {
  std::vector<double> ratio, E0_Pa, E0_low_Pa, E0_high_Pa;
};

// A joint fit: the forms compared, the best one, and the best law for unmeasured ratios.
struct RatioComparison {
  RatioForm form;
  int n_parameters = 0;
  // Natural logarithm of the largest likelihood; Bayesian information criterion.
  double log_likelihood = 0.0, bic = 0.0;
};
struct RatioSpecimen {  // one record
  std::string name;
  double mixing_ratio = 0.0;
  double E0_Pa = 0.0;
  double ln_E0_se = 0.0;  // of its own fit
  int specimen = 0;       // from 1; records with the same number are touches on one specimen
  int touch = 1;
};
// Result of a joint fit over mixing ratios.
struct RatioFit {
  RatioModel best, law;                // of all forms by BIC, and of those that are laws
  std::vector<RatioComparison> forms;  // ascending BIC
  std::vector<RatioSpecimen> specimens;
  std::vector<Scatter> scatter;  // of ln E0 and sum g between touches, specimens and ratios
  std::vector<MaterialFlag> flags;
  // Common to all materials: nu, density, temperature, window, systematic part, raw files.
  Material common;
};

// The material at a ratio: the mean of the specimens. Intervals and covariance are those of a new
// specimen (uncertainty of the estimate and spread between specimens, Student's t); if the spread
// is unknown, those of the measured specimen, flagged "spread-unknown". A measured ratio uses the
// best form, any other ratio the best law. Outside the measured range it throws
// std::invalid_argument unless may_extrapolate; the material then carries the flag
// "extrapolated-ratio".
Material material_at_ratio(const RatioFit& fit, double ratio, bool may_extrapolate = false);
RatioBand ratio_band(const RatioFit& fit, int count = 60);
// "E0 = 18.8 MPa x ratio^-0.99 (exponent +- 0.04); between specimens E0 scatters by 8 % ...", each
// number with the digits that its standard error allows.
std::string law_in_words(const RatioFit& fit);

}  // namespace viscard
