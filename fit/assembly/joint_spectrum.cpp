#include "fit/assembly/joint_spectrum.h"

#include "fit/assembly/assemble_result.h"
#include "fit/search/polish.h"
#include "fit/search/separable.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

double inflation_of(const std::vector<NoiseGroup>& groups) {
  double samples = 0.0, independent = 0.0;
  for (const NoiseGroup& group : groups) {
    samples += group.n_samples;
    independent += group.n_samples / group.noise.inflation();
  }
  return samples / independent;
}

double largest_move(const SpectralState& a, const SpectralState& b) {
  if (a.n_terms() != b.n_terms()) return 1.0;
  const double scale = std::max(1e-300, b.coefficients.cwiseAbs().maxCoeff());
  double most = (a.coefficients - b.coefficients).cwiseAbs().maxCoeff() / scale;
  if (a.n_terms() > 0) most = std::max(most, (a.ln_tau - b.ln_tau).cwiseAbs().maxCoeff());
  return most;
}

// The sum of squares without linearisation: at its own reference the linear model is exact.
double refer_to_itself(JointModel& model, SpectralState& state) {
  model.refer_to(model.series_of(state));
  state.rss = (model.data() - model.fitted(state)).squaredNorm();
  return state.rss;
}

SpectralState best_near(const SpectralModel& model, const SpectralState& start) {
  const SpectralState near = quick_search(model, start, {.tolerance = 1e-10});
  return polish(model, refine(model, near));
}

// The optimum of an order: Gauss-Newton steps about the last answer while they still improve it.
SpectralState settled(JointModel& model, SpectralState state) {
  constexpr int kMostSteps = 20;
  constexpr double kSame = 1e-7;
  state = best_near(model, state);
  if (!model.has_creep()) return state;
  SpectralState best = state;
  double least = refer_to_itself(model, best);
  for (int step = 0; step < kMostSteps; ++step) {
    SpectralState next = best_near(model, best);
    const double move = largest_move(next, best);
    const double rss = refer_to_itself(model, next);
    if (!(rss <= least * (1.0 + 1e-9))) {  // the step was too large: keep the last answer
      refer_to_itself(model, best);
      best.is_converged = best.is_converged && move < 1e-3;
      return best;
    }
    best = std::move(next);
    least = rss;
    if (move < kSame) return best;
  }
  best.is_converged = false;
  return best;
}

}  // namespace

SpectralFit fit_joint_spectrum(JointModel& model, const std::vector<NoiseGroup>& groups,
                               const std::vector<int>& blocks, const PronySeries& start,
                               const FitOptions& options) {
  constexpr int kRounds = 3;
  SpectralFit fit;
  fit.options = options;
  model.refer_to(start);
  Eigen::Index last_order = -1;
  for (int round = 0; round < kRounds; ++round) {
    search_orders(model, blocks, inflation_of(groups), fit);
    fit.state = settled(model, fit.path[fit.scores.chosen]);
    const bool is_same = fit.state.n_terms() == last_order;
    // The orders were compared with creep linearised about this answer.
    if (!model.has_creep() || is_same) break;
    last_order = fit.state.n_terms();
  }
  fit.rss = full_rss(model, fit.state);
  fit.variance = 1.0;
  fit.covariance = grouped_covariance(model, fit.state, groups);
  return fit;
}

}  // namespace viscard
