#include "fit/search/polish.h"

#include "fit/search/full_system.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

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

}  // namespace viscard
