#include "fit/assembly/parametrisation.h"

#include "fit/search/dense_least_squares.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Residuals as a function of all parameters, scaled so that the solver's thresholds suit any unit.
class FullCost final : public ceres::CostFunction {
 public:
  explicit FullCost(const Parametrisation& form)
      : form_(form), scale_(1e6 / std::max(form.model().data().norm(), 1e-280)) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(form.size()));
    set_num_residuals(static_cast<int>(form.model().n_rows()));
  }
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> theta(parameters[0], form_.size());
    const SpectralModel& model = form_.model();
    const SpectralState state = form_.state_of(theta);
    const Eigen::MatrixXd values = model.columns(state.ln_tau, state.nuisance, false).values;
    Eigen::Map<Eigen::VectorXd> out(residuals, model.n_rows());
    out = scale_ * (values * state.coefficients - model.data());
    if (!out.allFinite()) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        jacobians[0], model.n_rows(), form_.size()) =
        scale_ * full_jacobian(model, state) * form_.slopes(theta);
    return true;
  }

 private:
  const Parametrisation& form_;
  const double scale_;
};

}  // namespace

Parametrisation::Parametrisation(const SpectralModel& model, Index n_terms, bool by_shares)
    : model_(model), n_terms_(n_terms), by_shares_(by_shares) {}

Index Parametrisation::position(const ParameterName& name) const {
  if (name.term == 0) return 0;
  const Index of_times = name.stem == ParameterStem::kTime ? n_terms_ : 0;
  return model_.n_common() + of_times + name.term - 1;
}

Index Parametrisation::size() const {
  return model_.n_common() + 2 * n_terms_ + model_.n_nuisances();
}

Eigen::VectorXd Parametrisation::theta_of(const SpectralState& state) const {
  Eigen::VectorXd theta(size());
  theta << state.coefficients, state.ln_tau, state.nuisance;
  if (by_shares_) {
    const Index n = model_.n_common();
    const double E0 = state.coefficients[0] + theta.segment(n, n_terms_).sum();
    theta.segment(n, n_terms_) /= E0;
    theta[0] = E0;
  }
  return theta;
}

SpectralState Parametrisation::state_of(const Eigen::VectorXd& theta) const {
  SpectralState state;
  const Index n = model_.n_common();
  state.coefficients = theta.head(n + n_terms_);
  if (by_shares_) {
    const double E0 = theta[0];
    state.coefficients.segment(n, n_terms_) *= E0;
    state.coefficients[0] = E0 - state.coefficients.segment(n, n_terms_).sum();
  }
  state.ln_tau = theta.segment(n + n_terms_, n_terms_);
  state.nuisance = theta.tail(model_.n_nuisances());
  return state;
}

Eigen::MatrixXd Parametrisation::slopes(const Eigen::VectorXd& theta) const {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Identity(size(), size());
  if (!by_shares_) return slopes;
  const Index n = model_.n_common();
  const double E0 = theta[0];
  slopes(0, 0) = 1.0 - theta.segment(n, n_terms_).sum();
  for (Index i = n; i < n + n_terms_; ++i) {
    slopes(i, 0) = theta[i];
    slopes(i, i) = E0;
    slopes(0, i) = -E0;
  }
  return slopes;
}

Eigen::VectorXd Parametrisation::lower() const {
  Eigen::VectorXd low = Eigen::VectorXd::Constant(size(), -kInfinity);
  const Index n = model_.n_common();
  if (!model_.may_be_negative()) {
    low.segment(n, n_terms_).setZero();
    low[0] = 0.0;
  }
  low.segment(n + n_terms_, n_terms_).setConstant(model_.ln_tau_min());
  low.tail(model_.n_nuisances()) = model_.of_nuisances(&Nuisance::low);
  return low;
}

Eigen::VectorXd Parametrisation::upper() const {
  Eigen::VectorXd high = Eigen::VectorXd::Constant(size(), kInfinity);
  const Index n = model_.n_common();
  high.segment(n + n_terms_, n_terms_).setConstant(model_.ln_tau_max());
  high.tail(model_.n_nuisances()) = model_.of_nuisances(&Nuisance::high);
  return high;
}

SpectralState solve_in_box(const Parametrisation& form, const Eigen::VectorXd& low,
                           const Eigen::VectorXd& high, const SpectralState& start) {
  Eigen::VectorXd theta = form.theta_of(start).cwiseMax(low).cwiseMin(high);
  ceres::Problem problem;
  problem.AddParameterBlock(theta.data(), static_cast<int>(theta.size()));
  std::vector<int> fixed;
  for (Index i = 0; i < theta.size(); ++i) {
    const int at = static_cast<int>(i);
    if (low[i] == high[i]) {
      fixed.push_back(at);
      continue;
    }
    if (std::isfinite(low[i])) problem.SetParameterLowerBound(theta.data(), at, low[i]);
    if (std::isfinite(high[i])) problem.SetParameterUpperBound(theta.data(), at, high[i]);
  }
  if (static_cast<Index>(fixed.size()) < theta.size() && !fixed.empty()) {
    problem.SetManifold(theta.data(),
                        new ceres::SubsetManifold(static_cast<int>(theta.size()), fixed));
  }
  problem.AddResidualBlock(new FullCost(form), nullptr, theta.data());
  const SearchSummary summary = solve_dense(problem, {.parameter_tolerance = 1e-13});
  SpectralState state = form.state_of(theta);
  const SpectralModel& model = form.model();
  state.rss = (model.fitted(state) - model.data()).squaredNorm();
  state.is_converged = summary.is_usable;
  return state;
}

}  // namespace viscard
