#include "fit/assembly/fast_doubt.h"

#include "fit/intervals/uncertainty.h"
#include "fit/search/full_system.h"
#include "fit/search/separable.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The covariance with the time of the first term held: its row and column are zero.
Eigen::MatrixXd covariance_at_held_time(const SpectralModel& model, const SpectralFit& fit,
                                        const SpectralState& state) {
  const Eigen::MatrixXd jacobian = full_jacobian(model, state);
  const Index held = model.n_common() + state.n_terms();
  std::vector<Index> free;
  for (Index i = 0; i < jacobian.cols(); ++i) {
    if (i != held) free.push_back(i);
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  covariance(free, free) = covariance_from_jacobian(model, jacobian(Eigen::all, free), fit.variance,
                                                    fit.noise, fit.row_scale);
  return covariance;
}

// The fit with one more term, faster than all others, whose time is held.
SpectralState with_fast_term(const SpectralModel& model, const SpectralFit& fit, double ln_tau) {
  constexpr double kNearlyNone = 1e-6;  // of the stiffness, so that a series can hold the term
  SpectralState state = fit.state;
  state.ln_tau.resize(fit.state.n_terms() + 1);
  state.ln_tau << ln_tau, fit.state.ln_tau;
  state = quick_search(model, state, {.max_iterations = 60, .tolerance = 1e-9, .held = 0});
  double& modulus = state.coefficients[model.n_common()];
  modulus = std::max(modulus, kNearlyNone * state.coefficients[0]);
  return state;
}

// Such fits at times from shortest_s on to well below the fastest fitted term.
std::vector<SpectralState> with_fast_terms(const SpectralModel& model, const SpectralFit& fit,
                                           double shortest_s) {
  constexpr double kPerDecade = 8.0, kApart = 4.0;
  const double from = std::max(std::log(shortest_s), model.ln_tau_min());
  const double record = model.ln_tau_max() - std::log(9.0);  // a third of it
  const double fastest = fit.state.n_terms() > 0 ? fit.state.ln_tau.minCoeff() : record;
  const double to = fastest - std::log(kApart);
  if (!(to > from)) return {};
  const auto steps = static_cast<Index>(std::ceil((to - from) / std::log(10.0) * kPerDecade));
  std::vector<SpectralState> states;
  for (const double ln_tau : Eigen::VectorXd::LinSpaced(steps + 1, from, to)) {
    states.push_back(with_fast_term(model, fit, ln_tau));
  }
  return states;
}

void extend(Interval& interval, const Interval& other) {
  interval.low = std::min(interval.low, other.low);
  interval.high = std::max(interval.high, other.high);
}

// Extends all intervals of the result to those of a result with one more, faster term.
void extend_all(FitResult& result, const FitResult& other) {
  extend(result.E0_interval_95, other.E0_interval_95);
  extend(result.E_inf_interval_95, other.E_inf_interval_95);
  extend(result.sum_g_95, other.sum_g_95);
  for (std::size_t i = 0; i < result.terms.size(); ++i) {
    FittedTerm& term = result.terms[i];
    const FittedTerm& same = other.terms[i + 1];
    extend(term.modulus_Pa_95, same.modulus_Pa_95);
    extend(term.g_95, same.g_95);
    extend(term.tau_s_95, same.tau_s_95);
  }
}

// The share and the time of terms that the data do not exclude.
struct HiddenTerms {
  double largest_g = 0.0;
  Interval tau_s{std::numeric_limits<double>::infinity(), 0.0};
};

// Visits values of the modulus of the hidden term within the likelihood region that is left after
// `rise` variances, each with the best values of all other parameters and the region left for
// these. A state of no material is skipped.
void carry_hidden_term(const SpectralModel& model, const SpectralFit& fit,
                       const SeriesFromState& series_from_state, const SpectralState& state,
                       double rise, FitResult& result, HiddenTerms& hidden) {
  constexpr int kSteps = 8;
  const Eigen::MatrixXd covariance = covariance_at_held_time(model, fit, state);
  const Index modulus = model.n_common();
  const double sd = std::sqrt(covariance(modulus, modulus));
  if (!(sd > 0.0) || !std::isfinite(sd)) return;
  const double left = 1.0 - rise / kChiSquare95;
  const Eigen::VectorXd slope = covariance.col(modulus) / sd;
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double part = std::sqrt(left) * step / kSteps;  // of the 95 % interval
    const SpectralState moved = moved_by(state, std::sqrt(kChiSquare95) * part * slope);
    if (!possible_series(model, moved, series_from_state)) continue;
    FitResult other;
    fill_parameters(model, moved, (left - part * part) * (covariance - slope * slope.transpose()),
                    series_from_state, other);
    if (other.terms.size() != result.terms.size() + 1) continue;
    extend_all(result, other);
    hidden.largest_g = std::max(hidden.largest_g, other.terms.front().g);
    extend(hidden.tau_s, {other.terms.front().tau_s, other.terms.front().tau_s});
  }
}

}  // namespace

void carry_fast_doubt(const SpectralModel& model, const SpectralFit& fit,
                      const SeriesFromState& series_from_state, double shortest_s,
                      FitResult& result) {
  if (fit.options.n_terms || model.may_be_negative() || !(shortest_s > 0.0)) return;
  const std::vector<SpectralState> states = with_fast_terms(model, fit, shortest_s);
  double least_rss = fit.state.rss;
  for (const SpectralState& state : states) least_rss = std::min(least_rss, state.rss);
  const Interval E0 = result.E0_interval_95;
  HiddenTerms hidden;
  for (const SpectralState& state : states) {
    const double rise = (state.rss - least_rss) / fit.variance;
    if (rise >= kChiSquare95) continue;
    carry_hidden_term(model, fit, series_from_state, state, rise, result, hidden);
  }
  constexpr double kMuch = 1.5,
                   // Below this share, the uncertainty of geometry and load cell is larger.
      kOfE0 = 0.015;
  const double before = E0.high - E0.low;
  const double after = result.E0_interval_95.high - result.E0_interval_95.low;
  if (!(after > kMuch * before) || !(after - before > kOfE0 * result.E0_Pa)) return;
  result.flags.push_back(
      {"fast-term-hidden", 0,
       "a term of " + text_of(hidden.tau_s.low, 2) + " to " + text_of(hidden.tau_s.high, 2) +
           " s with a share of up to " + text_of(hidden.largest_g, 2) +
           " would not show in this test, whose loading is too slow for it; the intervals include "
           "it. A quick partial unloading shows it (protocol ramp-hold, [recovery])"});
}

}  // namespace viscard
