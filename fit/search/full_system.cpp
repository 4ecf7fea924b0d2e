#include "fit/search/full_system.h"

#include "fit/search/separable.h"

namespace viscard {
namespace {

using Index = Eigen::Index;

// One row for each nuisance, zero without a prior.
void add_priors(const SpectralModel& model, const SpectralState& state, FullSystem& all) {
  const Index n = model.n_nuisances(), rows = all.residual.size();
  all.jacobian.conservativeResize(rows + n, Eigen::NoChange);
  all.jacobian.bottomRows(n).setZero();
  all.jacobian.bottomRightCorner(n, n).diagonal() = model.prior_weight();
  all.residual.conservativeResize(rows + n);
  all.residual.tail(n) = -model.prior_residual(state.nuisance);
}

}  // namespace

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

Eigen::VectorXd unit_of(const Eigen::MatrixXd& jacobian) {
  return jacobian.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
}

SpectralState moved_by(const SpectralState& from, const Eigen::VectorXd& change) {
  SpectralState to = from;
  to.coefficients += change.head(from.coefficients.size());
  to.ln_tau += change.segment(from.coefficients.size(), from.n_terms());
  to.nuisance += change.tail(from.nuisance.size());
  return to;
}

}  // namespace viscard
