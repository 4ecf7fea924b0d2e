#pragma once

#include "models/material/prony_series.h"
#include "models/maths/interval.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

// One parameter of a law; the name has the unit: "tau_s", "c_Pa_s_alpha".
struct LawParameter {
  std::string name;
  // Value and standard error, in the unit that the name states.
  double value = 0.0, se = 0.0;
  Interval interval_95;  // of times and quasi-moduli symmetric in the logarithm
};

// A law of few parameters fitted to the same data as a Prony series (fit/laws/README.md).
struct FittedLaw {
  std::string name;  // "kww", "springpot", "fractional-maxwell" ...
  std::vector<LawParameter> parameters;
  int n_parameters = 0;         // with offset, drift and nuisances
  double rss = 0.0;             // as OrderRow::rss
  double bic = 0.0;             // as OrderRow::bic
  double bic_difference = 0.0;  // minus that of the chosen series; negative: the law is better
  bool is_at_bound = false;     // an exponent or a time ended at the end of its range

  // The law as a Prony series for solvers and cards: E(t), or J(t) of a creep test, within
  // series_error (relative) for t_min_s <= t <= t_max_s, and the complex modulus (or compliance) at
  // the angular frequencies 1/t.
  PronySeries series;
  double series_error = 0.0;  // relative
  double t_min_s = 0.0, t_max_s = 0.0;
  // Of E_inf, the E_i and the ln tau_i of the series.
  Eigen::MatrixXd series_covariance;
};

}  // namespace viscard
