#pragma once

#include "fit/intervals/slow_noise.h"
#include "fit/intervals/uncertainty.h"
#include "fit/samples/fit_data.h"
#include "fit/search/order_choice.h"
#include "fit/search/order_path.h"

#include <vector>

namespace viscard {

// A spectrum fitted to a model: the path of orders, the choice, noise and covariance.
struct SpectralFit {
  FitOptions options;
  std::vector<SpectralState> path;
  OrderScores scores;
  SpectralState state;    // of the chosen order, polished
  double rss = 0.0;       // weighted, over all samples
  double variance = 1.0;  // of one weighted sample
  Autoregression noise;
  SlowNoise slow;
  Eigen::VectorXd row_scale;        // as in LevelNoise
  Eigen::MatrixXd covariance;       // of all parameters of the state
  std::vector<MaterialFlag> notes;  // about the constraints that were applied
};

// Replaces the state of the fit by the best one that satisfies the constraints: least squares in
// all parameters within bounds (trust region of Ceres), started from the free optimum and the fixed
// times. The covariance is that of the free parameters; a parameter that ends on a bound counts as
// fixed. Nuisances and the common columns other than the first (E_inf) stay free. Throws
// std::invalid_argument if the constraints allow no material: E_inf < 0, terms out of order, a time
// that the record cannot show. Adds the note constraints-strained if the constraints fit the data
// visibly worse than the free fit, or contradicts-data if that makes the result untrustworthy.
void constrain(const SpectralModel& model, const FitOptions& options, SpectralFit& fit);

// Widens the intervals of E0 and E_inf for the uncertainty of the order. They then include the
// values, with their errors, of every order whose BIC is within 6 of the chosen one's (evidence
// less than "strong", Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773). If the slowest time is
// above a tenth of the record, the interval of E_inf extends down to the lowest value that the
// likelihood allows with one more term at the end of the range, because such a record cannot
// exclude it. Adds the flag order-uncertain if other orders widen an interval by more than half.
void carry_order_doubt(const SpectralModel& model, const SpectralFit& fit,
                       const SeriesFromState& series_from_state, FitResult& result);

// Relative standard uncertainty of the load cell's gain at first contact, from the record itself.
// The gain changes by creep_N_m_s/stiffness per second under load, and may have done so since the
// first reading, when it equalled the calibrated gain. The rate is increased by its own standard
// error. Sign and time course before contact are unknown, so rate times time is used as a standard
// deviation (JCGM 100:2008, 4.3). 0 if the model has no creep.
double gain_drift_relative_u(const SpectralModel& model, const SpectralFit& fit,
                             const IndentationData& data);

// Adds what one standard deviation of the drift changes (gain_drift_part() of bench_doubt.h) in quadrature to errors,
// covariance and intervals, and sets gain_drift_relative, the part of E0.
void add_gain_drift(const SystematicPart& part, FitResult& result);

}  // namespace viscard
