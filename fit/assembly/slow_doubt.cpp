#include "fit/assembly/slow_doubt.h"

#include "fit/curves/model_variant.h"
#include "fit/intervals/uncertainty.h"
#include "fit/intervals/viscosity.h"
#include "fit/samples/noise_model.h"
#include "fit/search/separable.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

SpectralState with_slower_term(const SpectralState& from, double ln_tau) {
  SpectralState slower = from;
  slower.ln_tau.conservativeResize(slower.n_terms() + 1);
  slower.ln_tau[slower.ln_tau.size() - 1] = ln_tau;
  return slower;
}

// Variance of a weighted sample about the fit, with the memory of the noise.
double slow_variance(const SpectralModel& model, const SpectralState& state) {
  const double spare = model.n_samples() - static_cast<double>(model.n_parameters(state));
  const double inflation = autoregression(model.residual_series(state)).inflation();
  return state.rss / std::max(1.0, spare) * std::max(1.0, inflation);
}

bool has_flag_of(const FitResult& result, const char* name) {
  return std::any_of(result.flags.begin(), result.flags.end(),
                     [&](const MaterialFlag& flag) { return flag.name == name; });
}

void lower_equilibrium(double low, FitResult& result) {
  result.E_inf_interval_95.low = std::min(result.E_inf_interval_95.low, low);
  if (!(result.E0_Pa > 0.0)) return;
  result.sum_g_95.high = std::max(result.sum_g_95.high, 1.0 - std::max(0.0, low) / result.E0_Pa);
}

void report_unexplained_loss(FitResult& result) {
  lower_equilibrium(0.0, result);
  constexpr const char* kName = "slower-relaxation";
  if (has_flag_of(result, kName)) return;
  result.flags.push_back(
      {kName, 0,
       "at the lowest frequencies the loss modulus is larger than the terms explain, as relaxation "
       "slower than these frequencies makes it: E_inf is an upper bound, and its interval reaches "
       "down to 0. Lower frequencies would show the relaxation"});
}

void flag_hidden_term(const Interval& before, double tau_s, FitResult& result) {
  constexpr double kMuch = 1.5, kOfEquilibrium = 0.05;
  const Interval& after = result.E_inf_interval_95;
  const double was = before.high - before.low, is = after.high - after.low;
  if (!(is > kMuch * was) || !(is - was > kOfEquilibrium * result.E_inf_Pa)) return;
  const double share = (result.E_inf_Pa - std::max(0.0, after.low)) / result.E_inf_Pa;
  result.flags.push_back(
      {"slow-term-hidden", 0,
       "relaxation slower than the lowest frequency would not show: a term of " +
           text_of(tau_s, 3) + " s (two decades below that frequency) with up to " +
           text_of(100.0 * share, 2) +
           " % of E_inf adds a loss modulus within the noise. The interval of E_inf includes it. "
           "Lower frequencies, or a relaxation test, would show it"});
}

}  // namespace

// The root of the rise is interpolated linearly.
double lowest_equilibrium(const SpectralModel& model, const SpectralState& start,
                          const EquilibriumProfile& profile) {
  const RefineOptions options{.max_iterations = 30,
                              .tolerance = 1e-6,
                              .unseen_variances = 1e-2,
                              .held = profile.holds_time ? start.n_terms() - 1 : -1};
  const double best = start.coefficients[0];
  const double weight = 1e4 * std::sqrt(profile.variance) / profile.step;
  double last = best, last_root = 0.0;
  for (double distance = profile.step; distance > 0.0; distance *= 2.0) {
    const double value = std::max(0.0, best - distance);
    const PinnedEquilibrium lowered(model, value, weight);
    const SpectralState refitted = quick_search(lowered, start, options);
    const double rise = (refitted.rss - profile.least_rss) / profile.variance;
    const double root = std::sqrt(std::max(0.0, rise));
    if (rise >= kChiSquare95) {
      const double share = (std::sqrt(kChiSquare95) - last_root) / (root - last_root);
      return last + share * (value - last);
    }
    if (value == 0.0) return 0.0;
    last = value;
    last_root = root;
  }
  return best;
}

void carry_slow_doubt(const SpectralModel& model, const SpectralFit& fit, double lowest_angular_1_s,
                      FitResult& result) {
  if (fit.options.n_terms || !fit.options.constraints.empty() || model.may_be_negative()) return;
  if (is_liquid(result) || !(result.E_inf_Pa > 0.0) || !(result.E_inf_se_Pa > 0.0)) return;
  constexpr double kReach = 100.0, kFar = 1e3;  // over the lowest angular frequency
  constexpr double kChiSquare99 = 6.635;        // one degree of freedom
  if (fit.scores.wants_slower) {
    report_unexplained_loss(result);
    return;
  }
  const double variance = fit.variance * fit.noise.inflation();
  const auto with_term_at = [&](double tau_s) {
    const SpectralState start = with_slower_term(fit.state, std::log(tau_s));
    return quick_search(model, start,
                        {.max_iterations = 60, .tolerance = 1e-9, .held = start.n_terms() - 1});
  };
  const double tau_s = kReach / lowest_angular_1_s;
  const SpectralState with_term = with_term_at(tau_s);
  for (const SpectralState& slower : {with_term, with_term_at(kFar / lowest_angular_1_s)}) {
    const double gain = fit.state.rss - slower.rss;
    if (!(gain > kChiSquare99 * slow_variance(model, slower))) continue;
    report_unexplained_loss(result);
    return;
  }
  const Interval before = result.E_inf_interval_95;
  lower_equilibrium(lowest_equilibrium(model, with_term,
                                       {.least_rss = std::min(fit.state.rss, with_term.rss),
                                        .variance = variance,
                                        .step = result.E_inf_se_Pa,
                                        .holds_time = true}),
                    result);
  flag_hidden_term(before, tau_s, result);
}

}  // namespace viscard
