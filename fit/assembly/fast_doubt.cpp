#include "fit/assembly/fast_doubt.h"

#include "fit/intervals/uncertainty.h"
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

// Such fits at times from shortest_s on to near the fastest term; none if that range is narrower
// than what one term stands for.
std::vector<SpectralState> with_fast_terms(const SpectralModel& model, const SpectralFit& fit,
                                           double shortest_s) {
  constexpr double kPerDecade = 8.0, kApart = 1.5, kOneTerm = 20.0;
  const double from = std::max(std::log(shortest_s), model.ln_tau_min());
  const double record = model.ln_tau_max() - std::log(9.0);  // a third of it
  const double fastest = fit.state.n_terms() > 0 ? fit.state.ln_tau.minCoeff() : record;
  if (fastest - from < std::log(kOneTerm)) return {};
  const double to = fastest - std::log(kApart);
  const auto steps = static_cast<Index>(std::ceil((to - from) / std::log(10.0) * kPerDecade));
  std::vector<SpectralState> states;
  for (const double ln_tau : Eigen::VectorXd::LinSpaced(steps + 1, from, to)) {
    states.push_back(with_fast_term(model, fit, ln_tau));
  }
  return states;
}

// Extends an interval to the part `share` of another about its value.
void extend(Interval& interval, const Interval& other, double value, double share) {
  interval.low = std::min(interval.low, value - share * (value - other.low));
  interval.high = std::max(interval.high, value + share * (other.high - value));
}

void extend_ratio(Interval& interval, const Interval& other, double value, double share) {
  interval.low = std::min(interval.low, value * std::pow(other.low / value, share));
  interval.high = std::max(interval.high, value * std::pow(other.high / value, share));
}

// Extends all intervals of the result to those of a result with one more, faster term.
void extend_all(FitResult& result, const FitResult& other, double share) {
  extend(result.E0_interval_95, other.E0_interval_95, other.E0_Pa, share);
  extend(result.E_inf_interval_95, other.E_inf_interval_95, other.E_inf_Pa, share);
  extend(result.sum_g_95, other.sum_g_95, other.sum_g, share);
  for (std::size_t i = 0; i < result.terms.size(); ++i) {
    FittedTerm& term = result.terms[i];
    const FittedTerm& same = other.terms[i + 1];
    extend(term.modulus_Pa_95, same.modulus_Pa_95, same.modulus_Pa, share);
    extend(term.g_95, same.g_95, same.g, share);
    extend_ratio(term.tau_s_95, same.tau_s_95, same.tau_s, share);
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
  Interval hidden_s{std::numeric_limits<double>::infinity(), 0.0};
  double largest_g = 0.0;
  for (const SpectralState& state : states) {
    const double rise = (state.rss - least_rss) / fit.variance;
    if (rise >= kChiSquare95) continue;
    FitResult other;
    fill_parameters(model, state, covariance_at_held_time(model, fit, state), series_from_state,
                    other);
    if (other.terms.size() != result.terms.size() + 1) continue;
    const double share = std::sqrt(1.0 - rise / kChiSquare95);
    extend_all(result, other, share);
    const FittedTerm& hidden = other.terms.front();
    largest_g = std::max(largest_g, hidden.g + share * (hidden.g_95.high - hidden.g));
    hidden_s.low = std::min(hidden_s.low, std::exp(state.ln_tau[0]));
    hidden_s.high = std::max(hidden_s.high, std::exp(state.ln_tau[0]));
  }
  constexpr double kMuch = 1.5;
  const Interval& widened_E0 = result.E0_interval_95;
  if (!(widened_E0.high - widened_E0.low > kMuch * (E0.high - E0.low))) return;
  result.flags.push_back(
      {"fast-term-hidden", 0,
       "a term of " + text_of(hidden_s.low, 2) + " to " + text_of(hidden_s.high, 2) +
           " s with a share of up to " + text_of(largest_g, 2) +
           " would not show in this test, whose loading is too slow for it; the intervals include "
           "it. A quick partial unloading shows it (protocol ramp-hold, [recovery])"});
}

}  // namespace viscard
