#include "fit/search/polish.h"

#include "fit/samples/sample_passes.h"
#include "fit/search/separable.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Jacobian and residual of all rows, including those within averages.
struct FullSystem {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual;
};

// One row for each nuisance, zero without a prior.
void add_priors(const SpectralModel& model, const SpectralState& state, FullSystem& all) {
  const Index n = model.n_nuisances(), rows = all.residual.size();
  all.jacobian.conservativeResize(rows + n, Eigen::NoChange);
  all.jacobian.bottomRows(n).setZero();
  all.jacobian.bottomRightCorner(n, n).diagonal() = model.prior_weight();
  all.residual.conservativeResize(rows + n);
  all.residual.tail(n) = -model.prior_residual(state.nuisance);
}

FullSystem full_system(const SpectralModel& model, const SpectralState& state) {
  const Index linear = state.coefficients.size();
  FullSystem all{full_jacobian(model, state), {}};
  all.residual = model.data() - all.jacobian.leftCols(linear) * state.coefficients;
  add_priors(model, state, all);
  const SpectralModel::HiddenRows hidden = model.hidden_rows(state.ln_tau);
  const Index visible = all.residual.size(), more = hidden.data.size();
  if (more == 0) return all;
  all.jacobian.conservativeResize(visible + more, Eigen::NoChange);
  all.residual.conservativeResize(visible + more);
  auto rows = all.jacobian.bottomRows(more);
  rows.setZero();
  rows.leftCols(linear) = hidden.columns.values;
  rows.middleCols(linear, state.n_terms()) =
      hidden.columns.term_slopes *
      state.coefficients.segment(model.n_common(), state.n_terms()).asDiagonal();
  all.residual.tail(more) = hidden.data - hidden.columns.values * state.coefficients;
  return all;
}

// 1 over the length of each column.
Eigen::VectorXd unit_of(const Eigen::MatrixXd& jacobian) {
  return jacobian.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
}

// Normal equations if they are well conditioned, otherwise QR. Normal equations reduce the accuracy
// of the step only, not that of the optimum it converges to.
Eigen::VectorXd gauss_newton_step(const FullSystem& at) {
  constexpr double kHidden = 1e-3;
  const Eigen::VectorXd unit = unit_of(at.jacobian);
  const Cholesky gram(unit.asDiagonal() * gram_of(at.jacobian) * unit.asDiagonal());
  if (gram.is_definite() && gram.smallest_pivot() > kHidden) {
    const Eigen::VectorXd right = transposed_product(at.jacobian, at.residual);
    return gram.solve(Eigen::VectorXd(right.cwiseProduct(unit))).cwiseProduct(unit);
  }
  const Eigen::MatrixXd columns = at.jacobian * unit.asDiagonal();
  return PivotedQr(columns).solve(at.residual).cwiseProduct(unit);
}

bool is_allowed(const SpectralModel& model, const SpectralState& state) {
  const std::vector<bool> is_free = free_columns(model, state.n_terms());
  for (Index j = 0; j < state.coefficients.size(); ++j) {
    if (!is_free[static_cast<std::size_t>(j)] && !(state.coefficients[j] > 0.0)) return false;
  }
  return state.n_terms() == 0 || (state.ln_tau.minCoeff() >= model.ln_tau_min() &&
                                  state.ln_tau.maxCoeff() <= model.ln_tau_max());
}

SpectralState moved_by(const SpectralState& from, const Eigen::VectorXd& change) {
  SpectralState to = from;
  to.coefficients += change.head(from.coefficients.size());
  to.ln_tau += change.segment(from.coefficients.size(), from.n_terms());
  to.nuisance += change.tail(from.nuisance.size());
  return to;
}

}  // namespace

SpectralState polish(const SpectralModel& model, const SpectralState& start) {
  constexpr int kMaxSteps = 60;
  constexpr double kSmallStep = 1e-13, kNearly = 1e-9;
  double last_moved = 1.0;
  const Index linear = start.coefficients.size();
  const Index n_terms = start.n_terms();
  // On a sign bound a Gauss-Newton step has no interior.
  if (!is_allowed(model, start)) return start;
  SpectralState state = start;
  FullSystem now = full_system(model, state);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::VectorXd change = gauss_newton_step(now);
    if (!change.allFinite()) return state;
    SpectralState next = moved_by(state, change);
    if (!is_allowed(model, next)) return state;
    FullSystem then = full_system(model, next);
    // Near the optimum, rounding may increase the sum by a few units in the last place.
    if (!(then.residual.squaredNorm() <= now.residual.squaredNorm() * (1.0 + 1e-9) + 1e-300)) {
      return state;
    }
    next.rss = then.residual.head(model.n_rows() + model.n_nuisances()).squaredNorm();
    state = std::move(next);
    now = std::move(then);
    const double moved = n_terms == 0 ? 0.0 : change.segment(linear, n_terms).cwiseAbs().maxCoeff();
    // Steps that no longer shrink are rounding errors.
    if (moved < kSmallStep || (moved < kNearly && moved > 0.5 * last_moved)) break;
    last_moved = moved;
  }
  return state;
}

namespace {

double rss_of_rows(const SpectralModel& model, const SpectralState& state) {
  return (model.data() - model.fitted(state)).squaredNorm() +
         model.prior_residual(state.nuisance).squaredNorm();
}

}  // namespace

PolishedState polish_samples(const SpectralModel& model, const SpectralState& start) {
  PolishedState best{start, start.rss + model.hidden_rss(start)};
  if (!is_allowed(model, start)) return best;
  std::optional<SpectralModel::SampleSums> now = model.sample_sums(start);
  if (!now) return best;
  best.rss = now->rss;
  // The second derivatives of the averages are near enough: they change the number of steps only.
  const Eigen::MatrixXd jacobian = full_system(model, start).jacobian;
  const Eigen::VectorXd unit = unit_of(jacobian);
  const Eigen::MatrixXd curvature = unit.asDiagonal() * gram_of(jacobian) * unit.asDiagonal();
  const Eigen::MatrixXd inverse = pseudo_inverse(curvature);
  constexpr int kMostSteps = 12;
  constexpr double kGain = 1e-11;  // of the sum of squares
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd descent = now->descent.cwiseProduct(unit);
    const Eigen::VectorXd change = (inverse * descent).cwiseProduct(unit);
    if (!change.allFinite() || !(now->descent.dot(change) > kGain * best.rss)) break;
    SpectralState next = moved_by(best.state, change);
    if (!is_allowed(model, next)) break;
    std::optional<SpectralModel::SampleSums> then = model.sample_sums(next);
    if (!(then->rss < best.rss)) break;
    next.rss = rss_of_rows(model, next);
    best = {std::move(next), then->rss};
    now = std::move(then);
  }
  return best;
}

}  // namespace viscard
